"""What a scene may leave out: the usual sizes of furniture and things, and where on a piece of furniture they are."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from casper.sim_adapter.room.scene import Furniture, Point

SIZES = {"counter": (1.2, 0.6, 0.86), "table": (1.2, 0.7, 0.74), "cabinet": (0.7, 0.7, 1.85)}
"""Of each kind of furniture: metres east and north, and the height of its top."""

SHELF = 0.98  # the height of a cabinet's board

SHAPES = {
    "box": (0.08, 0.06, 0.06),
    "cylinder": (0.07, 0.07, 0.10),
    "dish": (0.24, 0.24, 0.03),
    "basin": (0.40, 0.40, 0.07),
    "panel": (0.32, 0.32, 0.01),
}
"""Of each shape: metres east, north and up."""

MASS = 0.3  # kilograms of what can be moved

PLACED = {"dish": "inside", "basin": "inside", "panel": "on_top"}
"""How something is put at a thing of a shape."""

PALETTE = (
    (0.80, 0.25, 0.20),
    (0.20, 0.50, 0.80),
    (0.90, 0.65, 0.15),
    (0.30, 0.60, 0.35),
    (0.55, 0.35, 0.65),
    (0.85, 0.85, 0.88),
    (0.35, 0.35, 0.40),
)
"""Colours of things that have none of their own, in turn."""

RIM = 0.01  # metres that a basin's rim stands out of its counter
EDGE = 0.3  # metres from the edge within which one can get at a thing


def faces(at: Point, middle: Point) -> str:
    """The side of something that looks to the middle of the room."""
    dx, dy = middle[0] - at[0], middle[1] - at[1]
    if abs(dx) >= abs(dy):
        return "east" if dx > 0 else "west"
    return "north" if dy > 0 else "south"


def spread(piece: Furniture, count: int, middle: Point) -> Iterator[Point]:
    """Places for so many things on a piece of furniture: along its longer side, within reach from the room's middle."""
    along = 0 if piece.size_x >= piece.size_y else 1
    size, depth = (piece.size_x, piece.size_y) if along == 0 else (piece.size_y, piece.size_x)
    centre, across = (piece.x, piece.y), 1 - along
    near = max(0.0, depth / 2 - EDGE) * (1 if middle[across] >= centre[across] else -1)
    for number in range(count):
        at = [0.0, 0.0]
        at[along] = centre[along] + size * ((number + 0.5) / count - 0.5)
        at[across] = centre[across] + near
        yield at[0], at[1]


def height_on(furniture: Sequence[Furniture], at: Point, shape: str) -> float:
    """The height of what lies at a point of the floor plan: on the highest board there, or on the floor."""
    top = max((piece.surface for piece in furniture if piece.holds(*at)), default=0.0)
    return top + (RIM if shape == "basin" else 0.0)
