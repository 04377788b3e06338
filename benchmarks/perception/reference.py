"""The plain reference: every calculus of every pair at every step by itself, as its definition is written."""

from collections.abc import Sequence

from casper import qsr
from casper.qsr.calculi.calculus import Body, Calculus, Moment
from casper.qsr.tuples import Related


def pair_by_pair(
    calculi: Sequence[Calculus], t: Sequence[float], steps: Sequence[dict[str, Body]], observer: str
) -> list[dict[str, dict[tuple[str, ...], str]]]:
    """What holds at each step, as `casper.qsr.Stream` tells it; nothing is shared, and the step before is kept."""
    told = []
    before: dict[str, Body] = {}
    for at, now in enumerate(steps):
        dt = t[at] - t[at - 1] if at else 1.0
        holds: dict[str, dict[tuple[str, ...], str]] = {}
        for calculus in calculi:
            holds[calculus.name] = {}
            for row in Related(observer).tuples(calculus.arity, list(now)):
                was = [before[name] for name in row] if calculus.motion and before else None
                if not calculus.motion or was is not None:
                    holds[calculus.name][row] = calculus.one(Moment([now[name] for name in row], was, dt), None)
        told.append(holds)
        before = now
    return told


def check(found: qsr.Relations, told: Sequence[dict[str, dict[tuple[str, ...], str]]]) -> None:
    """Refuse figures of different answers.

    Raises:
        AssertionError: a step at which the two differ.
    """
    for at, holds in enumerate(told):
        assert found.at(at) == holds, f"different answers at step {at}"
