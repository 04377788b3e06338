"""Plan recognition in figures: time for an observation with posterior and best explanation, and what it is compared to.

    python benchmarks/recognition/figures.py [--quick]

Every comparison first checks that the answers are equal; after x stands how many times as long as the engine it took.
Exit code 1 when a bound of the project is not held.
"""

from __future__ import annotations

import argparse
import sys

import by_name
import loading
import noise
import several_goals
import shapes
from timing import held

THEMES = (by_name, shapes, noise, several_goals, loading)


def main() -> int:
    """Print the figures."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--quick", action="store_true", help="smaller libraries, half a minute")
    quick = parser.parse_args().quick
    for theme in THEMES:
        theme.figures(quick)
    print(f"\n{'every bound held' if all(held) else 'some bound NOT held'}")
    return int(not all(held))


if __name__ == "__main__":
    sys.exit(main())
