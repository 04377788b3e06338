"""The algebras of QTC: on a line, and in the plane.

Sources: Van de Weghe 2004; Delafontaine, Cohn and Van de Weghe 2011 (neighbours, by continuity and dominance).

What is known of k to l and of l to m says nothing of k to m by QTC_B in the plane: every composition is universal. On a
line it does say something, and in the plane QTC_C tells who stands still (both of a thing's symbols are 0), which is
the same towards everybody; its compositions here are right, but not all as small as they could be.
"""

from __future__ import annotations

from functools import cache
from itertools import permutations, product

from casper.qsr.plain.between import between
from casper.qsr.reasoning.algebra import Algebra

_TWO = tuple("".join(symbols) for symbols in product("-0+", repeat=2))
_FOUR = tuple("".join(symbols) for symbols in product("-0+", repeat=4))


def _near(relations: tuple[str, ...]) -> tuple[int, ...]:
    return tuple(
        sum(1 << n for n, other in enumerate(relations) if other != one and between(one, other) is None)
        for one in relations
    )


def _swapped(relations: tuple[str, ...]) -> tuple[int, ...]:
    """l's symbols before k's."""
    order = (1, 0, 3, 2)
    return tuple(relations.index("".join(one[place] for place in order[: len(one)])) for one in relations)


@cache
def qtc_b() -> Algebra:
    """QTC_B in the plane."""
    every = (1 << 9) - 1
    return Algebra("qtc_b", _TWO, None, _swapped(_TWO), ((every,) * 9,) * 9, _near(_TWO), decides=False)


@cache
def qtc_b_line() -> Algebra:
    """QTC_B of things on a line that are not in one place: every order of three, and every way they may move."""
    composed = [[0] * 9 for _ in _TWO]
    for places in permutations(range(3)):
        for moves in product((-1, 0, 1), repeat=3):

            def told(one: int, other: int, at: tuple[int, ...] = places, by: tuple[int, ...] = moves) -> int:
                ahead = 1 if at[other] > at[one] else -1
                return _TWO.index("0-+"[by[one] * ahead] + "0-+"[-by[other] * ahead])

            composed[told(0, 1)][told(1, 2)] |= 1 << told(0, 2)
    return Algebra("qtc_b_line", _TWO, None, _swapped(_TWO), tuple(map(tuple, composed)), _near(_TWO), decides=False)


@cache
def qtc_c() -> Algebra:
    """QTC_C in the plane: who stands still does so towards everybody, and who moves is still towards nobody."""
    stands = [(one[0] + one[2] == "00", one[1] + one[3] == "00") for one in _FOUR]
    by_rest = {
        rest: sum(1 << n for n, found in enumerate(stands) if found == rest)
        for rest in product((False, True), repeat=2)
    }
    composed = tuple(tuple(by_rest[r[0], s[1]] if r[1] == s[0] else 0 for s in stands) for r in stands)
    return Algebra("qtc_c", _FOUR, None, _swapped(_FOUR), composed, _near(_FOUR), decides=False, tight=False)
