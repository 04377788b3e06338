"""What may stand where: the values that an argument can sensibly take, read off the clauses of a base.

An argument of a rule's head takes the values that its one-place conditions allow (``food(T)``); one that a clause names
takes that; an argument of a fact takes the values of its column. Where nothing is said it may be any constant.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice, product

from casper.kb.base import KnowledgeBase
from casper.kb.errors import CasperError
from casper.kb.terms.clauses import SYSTEM, Clause, Indicator
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, Variable, as_term
from casper.kb.terms.unification import is_ground

MOST_STATEMENTS = 20_000


def columns_of(kb: KnowledgeBase, indicator: Indicator) -> list[list[Term]]:
    """The values of each argument, in the order in which the base brings them."""
    everything = constants_of(kb)
    found: list[dict[Term, None]] = [{} for _ in range(indicator[1])]
    for clause in kb.clauses_of(indicator):
        for at, arg in enumerate(clause.head.args):
            found[at].update(dict.fromkeys(_allowed(kb, clause, arg, everything)))
    return [list(column) or everything for column in found]


def constants_of(kb: KnowledgeBase) -> list[Term]:
    """Every ground argument of a fact, in the order of the text."""
    facts = (clause for clause in kb.clauses if not clause.body)
    return list(dict.fromkeys(arg for clause in facts for arg in clause.head.args if is_ground(arg)))


def base_facts(kb: KnowledgeBase) -> dict[Indicator, list[tuple[Term, ...]]]:
    """The rows of the predicates that facts alone define, and those of declared ones without any."""
    rules = {clause.head.indicator for clause in kb.clauses if clause.body}
    rows: dict[Indicator, list[tuple[Term, ...]]] = {}
    for clause in kb.clauses:
        if not clause.body and clause.head.indicator not in rules and clause.head.indicator not in SYSTEM:
            rows.setdefault(clause.head.indicator, []).append(clause.head.args)
    return rows


def well_typed(kb: KnowledgeBase, indicator: Indicator, most: int = MOST_STATEMENTS) -> list[Compound]:
    """Statements of a predicate over the values that its arguments may have, the first so many."""
    return [Compound((indicator[0], *row)) for row in islice(product(*columns_of(kb, indicator)), most)]


def checked(indicators: Sequence[Indicator], known: Sequence[Indicator]) -> list[Indicator]:
    """The indicators, all of them known.

    Raises:
        CasperError: one is not, or there is none.
    """
    for indicator in indicators:
        if indicator not in known:
            shown = ", ".join(f"{name}/{arity}" for name, arity in known)
            raise CasperError(f"there are no statements {indicator[0]}/{indicator[1]}; there are {shown or 'none'}")
    if not indicators:
        raise CasperError("there is nothing to draw from: no predicate of that kind")
    return list(indicators)


def text_of(term: Term) -> str:
    """A term as the language writes it."""
    return term_text(as_term(term))


def _allowed(kb: KnowledgeBase, clause: Clause, arg: Term, everything: Sequence[Term]) -> Iterator[Term]:
    if is_ground(arg):
        yield arg
    elif isinstance(arg, Variable):
        kinds = [
            {row[0]: None for row in kb.rows(*literal.atom.indicator)}
            for literal in clause.body
            if not literal.negated and literal.atom.indicator[1] == 1 and literal.atom.args == (arg,)
            and kb.defines(*literal.atom.indicator)
        ]  # fmt: skip
        equal = (literal.atom for literal in clause.body if literal.atom.functor == "=" and not literal.negated)
        same = [atom[2] for atom in equal if atom[1] == arg]
        if same and is_ground(same[0]):
            yield same[0]
        elif kinds:
            yield from (value for value in min(kinds, key=len) if all(value in kind for kind in kinds))
        else:
            yield from everything
