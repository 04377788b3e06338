"""Random programs whose negation runs in circles: SWI-Prolog's well-founded tabling, three ways of ours, brute force."""

from __future__ import annotations

import random
import re
from pathlib import Path

from programs import atoms_of, model, undefined_of
from swi import answers
from tally import Tally

from casper.kb.base import KnowledgeBase
from casper.kb.terms.clauses import Indicator, Literal
from casper.kb.terms.terms import Compound, Variable
from casper.kb.terms.unification import substitute
from casper.kb.top_down.search import Search

DERIVED = {"p": 0, "q": 1, "r": 1, "s": 2, "t": 1}
GIVEN = {"b": 1, "e": 2}
CONSTANTS = ["a", "b", "c", "1", "2"]


def _random_atom(rng: random.Random, name: str, terms: list[str]) -> str:
    arity = {**DERIVED, **GIVEN}[name]
    return f"{name}({', '.join(rng.choice(terms) for _ in range(arity))})" if arity else name


def random_program(rng: random.Random) -> list[str]:
    """Facts and rules in which recursion and negation run anywhere, everything range-restricted."""
    clauses = []
    for name in GIVEN:
        clauses += [f"{_random_atom(rng, name, CONSTANTS)}." for _ in range(rng.randrange(1, 6))]
    for name in DERIVED:
        for _ in range(rng.randrange(3)):
            variables = ["X", "Y", "Z"][: rng.randrange(1, 4)]
            body = [
                _random_atom(rng, rng.choice([*GIVEN, *GIVEN, *DERIVED]), [*variables, *variables, "a"])
                for _ in range(rng.randrange(1, 3))
            ]
            known = [v for v in variables if any(v in atom for atom in body)]
            body += [f"\\+ {_random_atom(rng, rng.choice([*DERIVED]), [*known, *known, 'a'])}" for _ in range(rng.randrange(3))]
            clauses.append(f"{_random_atom(rng, name, [*known, *known, 'a'])} :- {', '.join(body)}.")
    return list(dict.fromkeys(clauses))


def base_of(clauses: list[str]) -> KnowledgeBase:
    """The knowledge base of a program."""
    return KnowledgeBase.from_text("\n".join([*(f":- dynamic({n}/{a})." for n, a in {**DERIVED, **GIVEN}.items()), *clauses]))


def compare(count: int, seed: int, folder: Path) -> Tally:
    """Ask of every atom whether it holds, is undefined, or neither.

    The answers of SWI-Prolog have to be those of the stored relations, of the search that uses no stored relation, and
    of the alternating fixpoint over all instances, by brute force. SWI-Prolog 9 leaves a few atoms undefined that
    the well-founded model settles; there the three have to agree on it, and SWI-Prolog must not contradict them.
    """
    rng = random.Random(seed)
    programs = [random_program(rng) for _ in range(count)]
    asked = [[re.sub(r"\\\+ (\w+(\([^()]*\))?)", r"tnot(\1)", clause) for clause in program] for program in programs]
    tally = Tally(asked=count)
    for program, (true, undefined, failed) in zip(programs, answers(asked, DERIVED, GIVEN, folder), strict=True):
        base = base_of(program)
        stored = {i: base.stored(i) for i in DERIVED.items()}
        certain, possible = model(list(base.clauses))
        meant = {a for a in certain if a.indicator in stored}, {a for a in possible - certain if a.indicator in stored}
        mine = (atoms_of(stored), undefined_of(stored))
        compatible = true <= meant[0] and undefined >= meant[1] and true | undefined >= meant[0] | meant[1]
        if failed or mine != meant or searched(base) != meant or not compatible:
            tally.disagreements.append("\n".join(program))
        tally.equal += meant == (true, undefined)
        tally.undefined += bool(meant[1])
    return tally


def searched(base: KnowledgeBase) -> tuple[set[Compound], set[Compound]]:
    """What holds and what is undefined of the predicates of the rules, found top-down from the clauses alone."""
    clauses = {i: base.clauses_of(i) for i in [*DERIVED.items(), *GIVEN.items()]}
    true: set[Compound] = set()
    open_: set[Compound] = set()
    for indicator in DERIVED.items():
        pattern = _everything(indicator)
        for bindings, doubt in Search({}, clauses).outcomes([Literal(pattern)]):
            assert bindings is not None  # an evaluation that failed: there is none here
            (open_ if doubt else true).add(substitute(pattern, bindings))
    return true, open_ - true


def _everything(indicator: Indicator) -> Compound:
    return Compound((indicator[0], *(Variable(f"V{at}") for at in range(indicator[1]))))
