"""How two intervals, two boxes or two regions lie to each other: Allen's relations, rectangle algebra, RCC.

Sources: Allen 1983; Balbiani, Condotta and Fariñas del Cerro 1998 (rectangles and blocks); Randell, Cui and Cohn 1992
(RCC). A box is its centre and its full extent along each axis, as QSRlib's axis-parallel bounding boxes.
"""

from __future__ import annotations

from collections.abc import Sequence

ALLEN = (
    "before", "meets", "overlaps", "starts", "during", "finishes", "equals",
    "finished_by", "contains", "started_by", "overlapped_by", "met_by", "after",
)  # fmt: skip
"""In the order of how far the one has come past the other; the converse of the n-th is the n-th from the end."""
RCC8 = ("dc", "ec", "po", "tpp", "ntpp", "tppi", "ntppi", "eq")
COARSER: dict[int, dict[str, str]] = {
    8: {name: name for name in RCC8},
    5: {"dc": "dr", "ec": "dr", "po": "po", "tpp": "pp", "ntpp": "pp", "tppi": "ppi", "ntppi": "ppi", "eq": "eq"},
    4: {"dc": "dc", "ec": "po", "po": "po", "tpp": "pp", "ntpp": "pp", "tppi": "ppi", "ntppi": "ppi", "eq": "pp"},
    3: {"dc": "dc", "ec": "po", "po": "po", "tpp": "o", "ntpp": "o", "tppi": "o", "ntppi": "o", "eq": "o"},
    2: {"dc": "dc", "ec": "c", "po": "c", "tpp": "c", "ntpp": "c", "tppi": "c", "ntppi": "c", "eq": "c"},
}
"""RCC5 has dr for dc and ec; RCC4, RCC3 and RCC2 are QSRlib's (eq is a pp in RCC4)."""

Interval = tuple[float, float]


def allen(one: Interval, other: Interval, tolerance: float = 0.0) -> str:
    """The relation of two intervals (start, end) with start < end; ends within the tolerance count as equal."""
    return ALLEN[_allen(one, other, tolerance)]


def _allen(one: Interval, other: Interval, tolerance: float) -> int:
    if _sign(one[1] - other[0], tolerance) <= 0:
        return 1 if _sign(one[1] - other[0], tolerance) == 0 else 0
    if _sign(one[0] - other[1], tolerance) >= 0:
        return 11 if _sign(one[0] - other[1], tolerance) == 0 else 12
    return _INNER[_sign(one[0] - other[0], tolerance) + 1][_sign(one[1] - other[1], tolerance) + 1]


_INNER = ((2, 7, 8), (3, 6, 9), (4, 5, 10))
"""Which relation of intervals that share an inside: by the sign of start - start, then of end - end."""


def _sign(difference: float, tolerance: float) -> int:
    return 1 if difference > tolerance else -1 if difference < -tolerance else 0


def intervals(centre: Sequence[float], size: Sequence[float]) -> tuple[Interval, ...]:
    """The extent of a box along each axis (metres)."""
    return tuple((c - s / 2.0, c + s / 2.0) for c, s in zip(centre, size, strict=False))


def rectangle(one: Sequence[Interval], other: Sequence[Interval], tolerance: float = 0.0) -> str:
    """Allen's relation along each axis, joined by commas: two for rectangles, three for blocks."""
    return ",".join(allen(a, b, tolerance) for a, b in zip(one, other, strict=True))


def rcc8(one: Sequence[Interval], other: Sequence[Interval], tolerance: float = 0.0) -> str:
    """The relation of two boxes as regions; borders within the tolerance coincide."""
    relations = [_allen(a, b, tolerance) for a, b in zip(one, other, strict=True)]
    if any(r in (0, 12) for r in relations):
        return "dc"
    if any(r in (1, 11) for r in relations):
        return "ec"
    if all(r == 6 for r in relations):
        return "eq"
    if all(r in (3, 4, 5, 6) for r in relations):
        return "ntpp" if all(r == 4 for r in relations) else "tpp"
    if all(r in (6, 7, 8, 9) for r in relations):
        return "ntppi" if all(r == 8 for r in relations) else "tppi"
    return "po"
