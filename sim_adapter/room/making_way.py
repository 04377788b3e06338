"""Making way: where somebody who has nothing to do can go so that one who is held up gets through."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from casper.sim_adapter.room.geometry import Disc
from casper.sim_adapter.room.navigation import CELL, Navigator
from casper.sim_adapter.room.scene import Point

HELD_UP = 5.0  # seconds somebody waits for a way before others make one
MOST_TRIED = 40  # spots
FAR = 3  # cells between two spots that are tried


def spot_out_of_the_way(
    idle: Navigator, here: Point, others: Sequence[Disc], through: Callable[[Point], bool]
) -> Point | None:
    """The nearest spot for one who stands ``here`` at which the other one has a way; None when none was found.

    Args:
        idle: ways of the one who moves.
        here: where they stand.
        others: whom they keep away from.
        through: whether the one who is held up has a way when they stand at a spot.
    """
    cells = [cell for cell in idle.graph if cell[0] % FAR == 0 and cell[1] % FAR == 0]
    spots = sorted(((CELL * column, CELL * row) for column, row in cells), key=lambda spot: math.dist(spot, here))
    free = [spot for spot in spots if idle.free(spot, others)][:MOST_TRIED]
    return next((spot for spot in free if through(spot) and idle.path(here, spot, others) is not None), None)
