"""How times are taken, and how figures are told."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Sequence
from typing import Any

from casper.engine.verification.observation import Observation

held: list[bool] = []  # of every figure told so far, whether its bound was held


def told(what: str, figure: float, unit: str, bound: float | None = None, note: str = "") -> None:
    """Print a figure with its bound."""
    ok = bound is None or figure <= bound
    held.append(ok)
    shown = "" if bound is None else f"bound {bound:,g} {unit}: {'held' if ok else 'NOT held'}"
    said = "  ".join(filter(None, (shown, note)))
    print(f"{what:<66} {significant(figure):>9} {unit:<2}  {said}".rstrip(), flush=True)


def significant(figure: float) -> str:
    """Three digits, and no exponents."""
    return f"{figure:,.0f}" if figure >= 100 else f"{figure:.3g}"


def times(
    make: Callable[[], Any],
    episodes: Sequence[Sequence[Observation]],
    best: str = "standing",
    rounds: int = 3,
    later: bool = False,
) -> list[float]:
    """Seconds of each observation (or of those after an episode's first), posterior and best explanation.

    Tables of the library are there already; nothing of an episode is kept from one round to the next.
    """
    taken: list[float] = []
    prototype = make()
    for _ in range(rounds):
        taken.clear()
        for seen in episodes:
            engine = prototype.fork()
            for observation in seen:
                began = time.perf_counter()
                engine.observe(observation)
                engine.posterior()
                getattr(engine, best)()
                if not later or observation is not seen[0]:
                    taken.append(time.perf_counter() - began)
    return taken


def median(
    make: Callable[[], Any],
    episodes: Sequence[Sequence[Observation]],
    best: str = "standing",
    rounds: int = 3,
    later: bool = False,
) -> float:
    """The median of `times`."""
    return statistics.median(times(make, episodes, best, rounds, later))
