"""The calculi by name."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial

from casper.kb.errors import TraceError
from casper.qsr.calculi.calculus import Calculus
from casper.qsr.calculi.directions import Cardinal, Egocentric, Tpcc
from casper.qsr.calculi.distances import Qdc, RelativeDistance
from casper.qsr.calculi.hand import Hold
from casper.qsr.calculi.motion import Mos, QtcB, QtcB11, QtcBC, QtcC
from casper.qsr.calculi.regions import Block, Rcc, Rectangle

CALCULI: dict[str, Callable[[], Calculus]] = {
    "qdc": Qdc,
    "relative_distance": RelativeDistance,
    "mos": Mos,
    "qtc_b": QtcB,
    "qtc_b11": QtcB11,
    "qtc_c": QtcC,
    "qtc_bc": QtcBC,
    "cardinal": Cardinal,
    "egocentric": Egocentric,
    "tpcc": Tpcc,
    "rectangle": Rectangle,
    "block": Block,
    **{f"rcc{kind}": partial(Rcc, kind) for kind in (8, 5, 4, 3, 2)},
    "hold": Hold,
}


def calculus(given: str | Calculus) -> Calculus:
    """A calculus by its name, with its usual settings; one that is given is itself.

    Raises:
        TraceError: no calculus has the name.
    """
    if not isinstance(given, str):
        return given
    if given not in CALCULI:
        raise TraceError(f"there is no calculus {given!r:.40}; there are {', '.join(sorted(CALCULI))}")
    return CALCULI[given]()


def calculi(given: Iterable[str | Calculus]) -> tuple[Calculus, ...]:
    """Several, by name or as they are.

    Raises:
        TraceError: none, one without a name in the table, or two of one name.
    """
    made = tuple(calculus(each) for each in given)
    if not made:
        raise TraceError(f"no calculus is named; there are {', '.join(sorted(CALCULI))}")
    seen: set[str] = set()
    for each in made:
        if each.name in seen:
            raise TraceError(f"two calculi are named {each.name}; give one of them another name=…")
        seen.add(each.name)
    return made
