"""One interface to the engines that derive everything a program means: load, derive, count, time.

A `Program` is facts as tuples and rules as text in the syntax that Prolog, clingo and casper share; every engine gets
the same. An engine that is not installed gives a `Skipped`, which the report prints.
"""

import importlib.util
import statistics
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from itertools import chain
from typing import Any, TypeAlias

from casper.kb.base import KnowledgeBase
from casper.kb.clauses import Clause
from casper.kb.terms import Compound

from . import prolog
from .figures import OURS, Figure, Rows, Sizes, Skipped, fingerprint, timed

Indicator: TypeAlias = tuple[str, int]
CLINGO_SETTINGS: tuple[tuple[tuple[str, ...], str], ...] = (
    ((), ""),
    ((), "#show."),
    (("--single-shot",), "#show."),
)


@dataclass(frozen=True, slots=True)
class Program:
    """Facts by predicate, rules without their full stop, and the predicates whose rows are the answers."""

    facts: dict[str, Rows]
    rules: tuple[str, ...]
    counted: tuple[Indicator, ...]
    tabling: tuple[str, ...] = ("variant", "subsumptive")  # SWI-Prolog's modes that are worth trying

    def text(self) -> str:
        """Everything as text."""
        facts = (f"{name}({','.join(map(str, row))})." for name, rows in self.facts.items() for row in rows)
        return "\n".join(chain(facts, (f"{rule}." for rule in self.rules), ("",)))


@dataclass(frozen=True, slots=True)
class Outcome:
    """Seconds of one derivation, and the fingerprint of the answers."""

    seconds: float
    answers: tuple[int, int]


def has(kb: KnowledgeBase, method: str) -> bool:
    """Whether the knowledge base has a method (its predicates are attributes too, so `hasattr` would not do)."""
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


def compiled(kb: KnowledgeBase, program: Program) -> int:
    """Derive everything, answer one question, and say how many rows there are: nothing is put off."""
    kb.compile()
    for name, arity in program.counted[:1]:
        kb.ask((name, *["c0"] * arity))
    relations = [kb.stored(indicator) for indicator in program.counted if kb.defines(*indicator)]
    return sum(len(relation) for relation in relations if relation is not None)


def casper(program: Program, sizes: Sizes) -> Outcome:
    """The knowledge base: `compile`, a first `ask`, and the count of the rows."""
    times = []
    for _ in range(sizes.repeats):
        kb = loaded(program)
        seconds, _ = timed(lambda kb=kb: compiled(kb, program))
        times.append(seconds)
    return Outcome(statistics.median(times), answers_of(kb, program))


def answers_of(kb: KnowledgeBase, program: Program) -> tuple[int, int]:
    """The fingerprint of the counted predicates' rows."""
    return fingerprint((name, *row) for name, arity in program.counted for row in kb.rows(name, arity))


def clingo(program: Program, sizes: Sizes) -> Outcome | str:
    """clingo: `ground` alone, the best of its settings; a reason when it is not installed."""
    if importlib.util.find_spec("clingo") is None:
        return "the Python package clingo is not installed"
    text = program.text()
    runs = [_clingo_runs(text, options, extra, sizes.repeats) for options, extra in CLINGO_SETTINGS]
    seconds, control = min(runs, key=lambda run: run[0])
    names = {name: arity for name, arity in program.counted}
    rows = (_clingo_row(control, name, arity) for name, arity in names.items())
    return Outcome(seconds, fingerprint(chain.from_iterable(rows)))


def _clingo_runs(text: str, options: tuple[str, ...], extra: str, repeats: int) -> tuple[float, Any]:
    import clingo as package

    times = []
    for _ in range(repeats):
        control = package.Control(["-Wnone", *options])
        control.add("base", [], text + extra)
        seconds, _ = timed(lambda control=control: control.ground([("base", [])]))
        times.append(seconds)
    return statistics.median(times), control


def _clingo_row(control: Any, name: str, arity: int) -> Iterator[list[Any]]:
    return ([name, *atom.symbol.arguments] for atom in control.symbolic_atoms.by_signature(name, arity))


def swipl(program: Program, sizes: Sizes) -> Outcome | str:
    """SWI-Prolog: tabled queries for all answers, timed inside it, the best of its settings; or a reason."""
    if not prolog.is_installed():
        return "swipl is not on the PATH"
    tabled = tuple(dict.fromkeys(_head(rule) for rule in program.rules))
    found = [prolog.derive(program.text(), tabled, program.counted, mode, sizes) for mode in program.tabling]
    finished = [Outcome(*result) for result in found if result is not None]
    if not finished:
        return f"no tabling mode finished in {sizes.limit:.0f} s"
    return min(finished, key=lambda outcome: outcome.seconds)


def _head(rule: str) -> Indicator:
    head = rule.split(" :- ")[0]
    name, _, args = head.partition("(")
    return name, args.count(",") + 1


Engine: TypeAlias = Callable[[Program, Sizes], Outcome | str]
PEERS: dict[str, Engine] = {"clingo": clingo, "swipl": swipl}
ENGINES: dict[str, Engine] = {OURS: casper, **PEERS}


def derivations(task: str, program: Program, sizes: Sizes, engines: Iterable[str] = ()) -> Iterator[Figure | Skipped]:
    """The figures of one derivation task, engine by engine; all of them when none is named."""
    for name in engines or ENGINES:
        outcome = ENGINES[name](program, sizes)
        if isinstance(outcome, str):
            yield Skipped(task, name, outcome)
        else:
            yield Figure(task, name, outcome.seconds, outcome.answers)


def loadings(task: str, program: Program, sizes: Sizes) -> Iterator[Figure | Skipped]:
    """Building the knowledge base and deriving, together, from rows and from text."""
    rows = [timed(lambda: compiled(loaded(program), program)) for _ in range(sizes.repeats)]
    yield Figure(task.format(source="rows"), OURS, statistics.median(x[0] for x in rows), rows[0][1])
    text = program.text()
    seconds, count = timed(lambda: compiled(KnowledgeBase.from_text(text), program))
    yield Figure(task.format(source="text"), OURS, seconds, count)
