"""What the project promises of its logic, each promise as a number from the run beside its bound."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TypeAlias

from . import closures, ontology, queries, reasons, updates
from .figures import CONTROL, OURS, Sizes
from .memory import Memory
from .peers import DERIVING

Times: TypeAlias = Mapping[tuple[str, str], float]  # seconds by (task, engine)


@dataclass(frozen=True, slots=True)
class Bound:
    """A promise; ``value`` is None when something it needs was not measured."""

    promise: str
    value: float | None
    bound: float
    unit: str
    at_least: bool = False

    @property
    def held(self) -> bool | None:
        """Whether the promise is kept; None when that is not known."""
        if self.value is None:
            return None
        return self.value >= self.bound if self.at_least else self.value <= self.bound


def bounds(times: Times, sizes: Sizes, memory: Memory | None) -> Iterator[Bound]:
    """Every promise, against what was measured."""
    yield from _verification(times)
    for task in closures.graphs(sizes):
        yield _ratio(times, f"{task}, against clingo", (task, OURS), (task, "clingo"), 1, "×")
    yield _best_encoding(times)
    derived = (ontology.LOADING.format(source="rows"), DERIVING)
    for source in ("rows", "text"):
        task = ontology.LOADING.format(source=source)
        yield _ratio(times, f"{task}, against deriving alone", (task, OURS), derived, 2, "×")
    for name in ("type", "holds"):
        yield _absolute(times, updates.ASSERT.format(name=name), 100)
        yield _absolute(times, updates.RETRACT.format(name=name), 1000)
        yield _absolute(times, updates.GIVEN.format(name=name), 1000)
    for task in (task for task in reasons.KITCHEN if "why_not" in task):
        yield _absolute(times, task, 100)
    each = None if memory is None else memory.resident / memory.derived
    yield Bound("memory of the large base", each, 1024, "bytes a derived fact")


def _verification(times: Times) -> Iterator[Bound]:
    task = queries.EVERY
    value = _quotient(times, (task, queries.KANREN), (task, OURS))
    yield Bound(f"{task}: `ask` faster than plain kanren by", value, 1000, "×", at_least=True)
    for task in queries.GROUND:
        yield _ratio(times, f"{task}: `ask`, against SWI-Prolog", (task, OURS), (task, "swipl"), 1, "×")
        yield _ratio(
            times, f"{task}: goal in `run`, control", (task, queries.GOAL), (CONTROL, queries.KANREN), 2, "×"
        )


def _best_encoding(times: Times) -> Bound:
    """The ontology, each engine on the encoding of the axioms that suits it best."""
    tasks = [ontology.TASK.format(encoding=encoding) for encoding in ("facts", "rules")]
    ours, theirs = ([times[task, engine] for task in tasks if (task, engine) in times] for engine in (OURS, "clingo"))
    value = min(ours) / min(theirs) if ours and theirs else None
    return Bound("the ontology, each in its best encoding, against clingo", value, 1, "×")


def _ratio(
    times: Times, promise: str, ours: tuple[str, str], other: tuple[str, str], bound: float, unit: str
) -> Bound:
    return Bound(promise, _quotient(times, ours, other), bound, unit)


def _quotient(times: Times, one: tuple[str, str], other: tuple[str, str]) -> float | None:
    return times[one] / times[other] if one in times and other in times else None


def _absolute(times: Times, task: str, microseconds: float) -> Bound:
    found = times.get((task, OURS))
    return Bound(task, None if found is None else found * 1e6, microseconds, "µs")
