"""Examples a second of the strategies that are shipped, for the kitchen: python benchmarks/strategies.py.

Seconds of the processor, the best of three runs: the first one also loads what hypothesis loads when it is first used.
Hypothesis makes no example twice where it can tell, so there may be fewer than were asked for: the kitchen has 52
statements that are well typed.
"""

from __future__ import annotations

import time
from typing import Any

from hypothesis import HealthCheck, Phase, given, settings

from casper.engine.domain.domain import Domain
from casper.testing.strategies import (
    facts,
    interleavings,
    libraries,
    observations,
    programs,
    statements,
    world_traces,
)

PROMISED = 500  # of statements and observations


def rate(strategy: Any, examples: int) -> float:
    return max(_rate(strategy, examples) for _ in range(3))


def _rate(strategy: Any, examples: int) -> float:
    made: list[Any] = []
    quick = settings(
        max_examples=examples,
        database=None,
        deadline=None,
        phases=[Phase.generate],
        suppress_health_check=list(HealthCheck),
    )

    @quick
    @given(strategy)
    def draw(value: Any) -> None:
        made.append(value)

    start = time.process_time()
    draw()
    return len(made) / (time.process_time() - start)


def main() -> None:
    kitchen = Domain.load("kitchen")
    seen = observations(kitchen)
    rows = (
        ("statements", statements(kitchen), 2000, PROMISED),
        ("valid statements", statements(kitchen, valid=True), 2000, PROMISED),
        ("observations", seen, 2000, PROMISED),
        ("observations, noisy", observations(kitchen, drop=0.3, needless=0.3, misread=0.2), 1000, None),
        ("facts", facts(kitchen), 2000, None),
        ("interleavings of two", interleavings(seen, seen), 500, None),
        ("libraries", libraries(), 200, None),
        ("programs", programs(), 200, None),
        ("world traces", world_traces(kitchen), 200, None),
    )
    for name, strategy, examples, promised in rows:
        found = rate(strategy, examples)
        kept = "" if promised is None else f"   promised {promised}: {'kept' if found >= promised else 'NOT KEPT'}"
        print(f"{name:<22} {found:8,.0f} a second{kept}")


if __name__ == "__main__":
    main()
