"""The algebras by name."""

from __future__ import annotations

from collections.abc import Callable

from casper.kb.errors import TraceError
from casper.qsr.reasoning.algebra import Algebra
from casper.qsr.reasoning.intervals import allen, cardinal, cone, points, rectangle
from casper.qsr.reasoning.regions import rcc5, rcc8
from casper.qsr.reasoning.trajectories import qtc_b, qtc_b_line, qtc_c

ALGEBRAS: dict[str, Callable[[], Algebra]] = {
    "allen": allen,
    "point": points,
    "rectangle": rectangle,
    "rcc8": rcc8,
    "rcc5": rcc5,
    "cardinal": cardinal,
    "cone": cone,
    "qtc_b": qtc_b,
    "qtc_b_line": qtc_b_line,
    "qtc_c": qtc_c,
}


def algebra(name: str) -> Algebra:
    """The algebra of a calculus.

    Raises:
        TraceError: there is none of the name.
    """
    if name not in ALGEBRAS:
        raise TraceError(f"there is no algebra {name!r:.40}; there are {', '.join(ALGEBRAS)}")
    return ALGEBRAS[name]()
