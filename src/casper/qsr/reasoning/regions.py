"""RCC8 and RCC5: weak composition, as published (Randell, Cui and Cohn 1992; Cohn et al. 1997)."""

from __future__ import annotations

from functools import cache

from casper.qsr.plain.regions import COARSER, RCC8
from casper.qsr.reasoning.algebra import Algebra

_COLUMNS = ("dc", "ec", "po", "tpp", "ntpp", "tppi", "ntppi", "eq")
_SHORT = {"A": "dc ec", "I": "tppi ntppi", "P": "tpp ntpp"}
_TABLE = """
dc    | *    | A po P   | A po P        | A po P        | A po P          | dc            | dc     | dc
ec    | A po I | A po tpp tppi eq | A po P | ec po P     | po P            | A             | dc     | ec
po    | A po I | A po I  | *            | po P          | po P            | A po I        | A po I | po
tpp   | dc   | A        | A po P        | P             | ntpp            | A po tpp tppi eq | A po I | tpp
ntpp  | dc   | dc       | A po P        | ntpp          | ntpp            | A po P        | *      | ntpp
tppi  | A po I | ec po I | po I         | po tpp tppi eq | po P           | I             | ntppi  | tppi
ntppi | A po I | po I    | po I         | po I          | po P I eq       | ntppi         | ntppi  | ntppi
eq    | dc   | ec       | po            | tpp           | ntpp            | tppi          | ntppi  | eq
"""
_NEAR = {
    "dc": "ec",
    "ec": "dc po",
    "po": "ec tpp tppi eq",
    "tpp": "po ntpp eq",
    "ntpp": "tpp eq",
    "tppi": "po ntppi eq",
    "ntppi": "tppi eq",
    "eq": "po tpp ntpp tppi ntppi",
}
"""Under moving, growing and changing shape; what is equal may become any part at once (Galton 2000)."""
_CONVERSE = {"tpp": "tppi", "ntpp": "ntppi", "tppi": "tpp", "ntppi": "ntpp"}


@cache
def rcc8() -> Algebra:
    """Of regions of any shape."""
    place = {name: number for number, name in enumerate(RCC8)}

    def members(names: str) -> int:
        spelt = " ".join(_SHORT.get(name, name) for name in names.split())
        return 0b1111_1111 if spelt == "*" else sum(1 << place[name] for name in spelt.split())

    rows: dict[str, dict[str, int]] = {}
    for line in _TABLE.strip().splitlines():
        name, *cells = line.split("|")
        rows[name.strip()] = dict(zip(_COLUMNS, map(members, cells), strict=True))
    return Algebra(
        "rcc8",
        RCC8,
        place["eq"],
        tuple(place[_CONVERSE.get(name, name)] for name in RCC8),
        tuple(tuple(rows[r][s] for s in RCC8) for r in RCC8),
        tuple(members(_NEAR[name]) for name in RCC8),
    )


@cache
def rcc5() -> Algebra:
    """Without borders: what RCC8 says of what is merged."""
    fine, coarse = rcc8(), COARSER[5]
    names = tuple(dict.fromkeys(coarse.values()))
    place = {name: number for number, name in enumerate(names)}

    def merged(members: int) -> int:
        return sum(1 << place[name] for name in {coarse[each] for each in fine.names(members)})

    within = [fine.set_of([each for each in RCC8 if coarse[each] == name]) for name in names]
    near = [merged(_all_near(fine, members)) & ~(1 << number) for number, members in enumerate(within)]
    return Algebra(
        "rcc5",
        names,
        place["eq"],
        tuple(merged(fine.turned(members)).bit_length() - 1 for members in within),
        tuple(tuple(merged(fine.joined(r, s)) for s in within) for r in within),
        tuple(near),
    )


def _all_near(algebra: Algebra, members: int) -> int:
    found = 0
    for name in algebra.names(members):
        found |= algebra.near[algebra.place[name]]
    return found
