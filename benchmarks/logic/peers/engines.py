"""One interface to the engines that derive everything a program means: load, derive, count, time.

A `Program` is facts as tuples and rules as text in the syntax that Prolog, clingo and casper share; every
engine gets the same. An engine that is not installed gives a `Skipped`, which the report prints.
"""

import importlib.util
import statistics
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import chain
from typing import Any, TypeAlias

from casper.kb.base import KnowledgeBase
from casper.kb.terms.clauses import Clause
from casper.kb.terms.terms import Compound

from ..figures import OURS, Figure, Rows, Sizes, Skipped, fingerprint, timed
from . import prolog

Indicator: TypeAlias = tuple[str, int]
NO_CLINGO = "the Python package clingo is not installed"
READ = "{task}, and every row read in Python"
CLINGO_SETTINGS: tuple[tuple[tuple[str, ...], str], ...] = (
    ((), ""),
    (("--single-shot",), "#show."),
)


@dataclass(frozen=True, slots=True)
class Program:
    """Facts by predicate, rules without their full stop, and the predicates whose rows are the answers."""

    facts: dict[str, Rows]
    rules: tuple[str, ...]
    counted: tuple[Indicator, ...]
    tabling: tuple[str, ...] = ("variant",)  # SWI-Prolog's modes that are worth trying

    @property
    def smallest(self) -> Indicator:
        """The predicate with the fewest facts."""
        name = min(self.facts, key=lambda name: len(self.facts[name]))
        return name, len(self.facts[name][0])

    def text(self) -> str:
        """Everything as text."""
        facts = (f"{name}({','.join(map(str, row))})." for name, rows in self.facts.items() for row in rows)
        return "\n".join(chain(facts, (f"{rule}." for rule in self.rules), ("",)))


@dataclass(frozen=True, slots=True)
class Outcome:
    """Seconds of one derivation, the answers' fingerprint, and seconds of reading them all in Python."""

    seconds: float
    answers: tuple[int, int]
    reading: float | None = None


def has(kb: KnowledgeBase, method: str) -> bool:
    """Whether the knowledge base has a method (`hasattr` would not do: its predicates are attributes too)."""
    return hasattr(type(kb), method)


def loaded(program: Program) -> KnowledgeBase:
    """A knowledge base of the program, not yet compiled."""
    kb = KnowledgeBase()
    for name, rows in program.facts.items():
        if has(kb, "facts"):
            kb.facts(name, rows)
        else:
            kb.add([Clause(Compound((name, *row))) for row in rows])
    for rule in program.rules:
        kb.rule(rule)
    return kb


def stated(facts: Mapping[str, Rows], text: str) -> KnowledgeBase:
    """A knowledge base of rows and of rules and directives as text, not yet compiled."""
    kb = KnowledgeBase.from_text("".join(f":- dynamic {name}/{len(rows[0])}.\n" for name, rows in facts.items()) + text)
    for name, rows in facts.items():
        kb.facts(name, rows)
    return kb


def compiled(kb: KnowledgeBase, program: Program) -> int:
    """Derive everything, answer one question about constants that are there, and count the rows."""
    kb.compile()
    count = everything(kb, program.smallest, program.counted)
    name, arity = next(indicator for indicator in program.counted if kb.defines(*indicator))
    constants = [value for rows in program.facts.values() for value in rows[0]]
    kb.ask((name, *constants[:arity]))
    return count


def everything(kb: KnowledgeBase, smallest: Indicator, counted: Iterable[Indicator]) -> int:
    """Derive everything, and count rows: a large base lists what follows when the rows of some predicate are read."""
    for _ in kb.rows(*smallest):
        break
    relations = [kb.stored(indicator) for indicator in counted if kb.defines(*indicator)]
    assert None not in relations, "something that should be listed is not"
    return sum(len(relation) for relation in relations if relation is not None)


def casper(programs: Sequence[Program], sizes: Sizes) -> Outcome:
    """The knowledge base, put the first way: `compile`, a first `ask`, the count; then every row read."""
    program, times, reading = programs[0], [], []
    for _ in range(sizes.repeats):
        kb = loaded(program)
        times.append(timed(partial(compiled, kb, program))[0])
        reading.append(timed(partial(_read, kb, program))[0])
    return Outcome(statistics.median(times), answers_of(kb, program), statistics.median(reading))


def _read(kb: KnowledgeBase, program: Program) -> int:
    return sum(len(list(kb.rows(*indicator))) for indicator in program.counted)


def answers_of(kb: KnowledgeBase, program: Program) -> tuple[int, int]:
    """The fingerprint of the counted predicates' rows."""
    return fingerprint((name, *row) for name, arity in program.counted for row in kb.rows(name, arity))


def clingo(programs: Sequence[Program], sizes: Sizes) -> Outcome | str:
    """clingo: `ground` alone, the best of its settings, then reading every atom; or why it was left out."""
    if importlib.util.find_spec("clingo") is None:
        return NO_CLINGO
    ways = [(program.text(), *setting) for program in programs for setting in CLINGO_SETTINGS]
    best = min(ways, key=lambda way: grounded(*way)[0])
    runs = [grounded(*best) for _ in range(sizes.repeats)]
    control, counted = runs[-1][1], programs[0].counted
    reading, rows = timed(lambda: list(chain.from_iterable(atoms_of(control, *x) for x in counted)))
    return Outcome(statistics.median(run[0] for run in runs), fingerprint(rows), reading)


def grounded(text: str, options: tuple[str, ...], extra: str) -> tuple[float, Any]:
    import clingo as package

    control = package.Control(["-Wnone", *options])
    control.add("base", [], text + extra)
    return timed(lambda: control.ground([("base", [])]))[0], control


def grounded_rows(text: str, name: str, arity: int) -> tuple[float, tuple[int, int]] | str:
    """clingo's seconds of grounding, and the fingerprint of one predicate's rows; or why there are none."""
    if importlib.util.find_spec("clingo") is None:
        return NO_CLINGO
    seconds, control = grounded(text, (), "")
    return seconds, fingerprint(atom[1:] for atom in atoms_of(control, name, arity))


def atoms_of(control: Any, name: str, arity: int) -> Iterator[list[Any]]:
    return ([name, *atom.symbol.arguments] for atom in control.symbolic_atoms.by_signature(name, arity))


def swipl(programs: Sequence[Program], sizes: Sizes) -> Outcome | str:
    """SWI-Prolog: tabled queries for all answers, timed inside it, the best of its settings; or a reason."""
    if not prolog.is_installed():
        return prolog.ABSENT
    finished = []
    for program, mode in ((each, mode) for each in programs for mode in each.tabling):
        tabled = tuple(dict.fromkeys(_head(rule) for rule in program.rules))
        found = prolog.derive(program.text(), tabled, program.counted, mode, sizes)
        if found is not None:
            finished.append(Outcome(*found))
    if not finished:
        return f"no tabling mode finished in {sizes.limit:.0f} s"
    return min(finished, key=lambda outcome: outcome.seconds)


def _head(rule: str) -> Indicator:
    head = rule.split(" :- ")[0]
    name, _, args = head.partition("(")
    return name, args.count(",") + 1


Engine: TypeAlias = Callable[[Sequence[Program], Sizes], Outcome | str]
ENGINES: dict[str, Engine] = {OURS: casper, "clingo": clingo, "swipl": swipl}


def derivations(task: str, programs: Sequence[Program], sizes: Sizes) -> Iterator[Figure | Skipped]:
    """The figures of one task, engine by engine; peers choose among the ways to put it."""
    for name, engine in ENGINES.items():
        try:
            outcome = engine(programs, sizes)
        except Exception as mistake:
            if name == OURS:
                raise
            outcome = f"it failed: {str(mistake).strip().partition(chr(10))[0][:200]}"
        if isinstance(outcome, str):
            yield Skipped(task, name, outcome)
            continue
        yield Figure(task, name, outcome.seconds, outcome.answers)
        if outcome.reading is not None:
            yield Figure(READ.format(task=task), name, outcome.seconds + outcome.reading)
