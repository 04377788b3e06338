"""Allen's algebra, and those of points and rectangles, worked out from what the relations mean.

Sources: Allen 1983; Freksa 1992 (neighbours); Ligozat 1998 (cardinal directions as points along two axes); Balbiani,
Condotta and Fariñas del Cerro 1998 (rectangles).
"""

from __future__ import annotations

from functools import cache
from itertools import combinations, product

from casper.qsr.plain.directions import CARDINAL
from casper.qsr.plain.regions import ALLEN
from casper.qsr.plain.regions import allen as relation
from casper.qsr.reasoning.algebra import Algebra
from casper.qsr.reasoning.algebra import product as paired


@cache
def allen() -> Algebra:
    """Three intervals have six ends: whatever their order, it is that of some intervals between 0 and 5."""
    place = {name: number for number, name in enumerate(ALLEN)}
    spans = list(combinations(range(6), 2))
    told = {(a, b): place[relation(a, b)] for a in spans for b in spans}
    composed = [[0] * 13 for _ in ALLEN]
    for a, b, c in product(spans, repeat=3):
        composed[told[a, b]][told[b, c]] |= 1 << told[a, c]
    converses = tuple(told[b, a] for a, b in (_example(told, n) for n in range(13)))
    return Algebra("allen", ALLEN, place["equals"], converses, tuple(map(tuple, composed)), _one_end_moves(told))


Span = tuple[int, int]


def _example(told: dict[tuple[Span, Span], int], number: int) -> tuple[Span, Span]:
    return next(pair for pair, found in told.items() if found == number)


def _one_end_moves(told: dict[tuple[Span, Span], int]) -> tuple[int, ...]:
    """Freksa's A-neighbours: exactly one end comes to, or leaves, one end of the other."""
    signs = {}
    for (a, b), number in told.items():
        signs[number] = tuple((x > y) - (x < y) for x in a for y in b)
    near = [0] * 13
    for r, s in product(range(13), repeat=2):
        changes = [abs(x - y) for x, y in zip(signs[r], signs[s])]
        if sum(changes) == 1:
            near[r] |= 1 << s
    return tuple(near)


@cache
def points() -> Algebra:
    """Before, equal and after on a line."""
    less, same, more = 1, 2, 4
    every = less | same | more
    composed = ((less, less, every), (less, same, more), (every, more, more))
    return Algebra("point", ("<", "=", ">"), 1, (2, 1, 0), composed, (same, less | more, same))


@cache
def cardinal() -> Algebra:
    """Cardinal directions by projection: points along two axes; exact.

    What changes along both axes at once may do so to or from ``=`` only.
    """
    by_signs = {("=", ">"): "n", (">", ">"): "ne", (">", "="): "e", (">", "<"): "se", ("=", "<"): "s"}
    by_signs |= {("<", "<"): "sw", ("<", "="): "w", ("<", ">"): "nw", ("=", "="): "eq"}
    made = paired("cardinal", points(), points(), by_signs)
    slanted = made.set_of(("ne", "se", "sw", "nw"))
    same = made.set_of("eq")
    near = tuple(
        members | (slanted if name == "eq" else same if made.set_of(name) & slanted else 0)
        for name, members in zip(made.relations, made.near)
    )
    return Algebra(made.name, made.relations, made.identity, made.converses, made.composed, near)


@cache
def cone() -> Algebra:
    """Cardinal directions by cones: the sum of displacements in two sectors lies between them, or anywhere if opposite.

    A network of them that is path-consistent may still be impossible.
    """
    same = 1 << 8

    def composed(r: int, s: int) -> int:
        if 8 in (r, s):
            return 1 << (r if s == 8 else s)
        turn = (s - r) % 8
        if turn == 4:
            return 0b1_1111_1111
        first, wide = (r, turn) if turn < 4 else (s, 8 - turn)
        return sum(1 << (first + step) % 8 for step in range(wide + 1))

    near = tuple(1 << (r + 1) % 8 | 1 << (r - 1) % 8 | same for r in range(8))
    table = tuple(tuple(composed(r, s) for s in range(9)) for r in range(9))
    return Algebra("cone", CARDINAL, 8, (4, 5, 6, 7, 0, 1, 2, 3, 8), table, (*near, 0b1111_1111), decides=False)


@cache
def rectangle() -> Algebra:
    """Rectangle algebra: Allen's along two axes; neighbours move one border."""
    return paired("rectangle", allen(), allen(), {(r, s): f"{r},{s}" for r, s in product(ALLEN, repeat=2)})
