"""A domain's facts → its scene, with a sensible value for whatever they leave out (``docs/rooms.md``)."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from casper.engine.domain.domain import Domain
from casper.kb.errors import DomainError
from casper.kb.terms.numbers import as_float
from casper.sim_adapter.room.furnishing import (
    MASS,
    PALETTE,
    PLACED,
    SHAPES,
    SHELF,
    SIZES,
    faces,
    height_on,
    spread,
)
from casper.sim_adapter.room.scene import (
    FIXED_SHAPES,
    FURNITURE_KINDS,
    MOVABLE_SHAPES,
    PLACINGS,
    SIDES,
    Furniture,
    Point,
    Scene,
    Thing,
)
from casper.sim_adapter.room.settings import HumanSettings, RobotSettings, SensorSettings, SimSettings, settings_from

Rows = Callable[[str, int], Iterable[tuple[Any, ...]]]
Hole = tuple[float, float, float, float]
Spot = tuple[float, float, float]


def scene_of(domain: Domain) -> Scene:
    """The scene of a domain; its partners and its robot are in the room unless it names other bodies.

    Raises:
        DomainError: as `scene_from`.
    """
    return scene_from(domain.kb.rows, domain.partners, domain.robot)


def scene_from(rows: Rows, people: Sequence[str] = (), robot: str | None = None) -> Scene:
    """Read a scene from a domain's facts.

    Args:
        rows: the facts.
        people, robot: who is in the room where no ``body/2`` says so.

    Raises:
        DomainError: something is missing or contradicts itself; the sentence names the fact that is needed.
    """
    people, robot = _bodies(rows, people, robot)
    table = {(group, name): value for group, name, value in rows("setting", 3)}
    outline = _outline(rows)
    furniture = _furniture(rows, _middle(outline))
    walkable, holes = _walkable(rows, outline, furniture)
    return Scene(
        outline=outline,
        walkable=walkable,
        holes=holes,
        furniture=furniture,
        things=_things(rows, furniture, _middle(outline)),
        people=tuple(people),
        robot=robot,
        starts={name: (_n(x), _n(y), math.radians(_n(h))) for name, x, y, h in rows("start", 4)},
        sim=settings_from(SimSettings, "sim", table),
        human_settings=settings_from(HumanSettings, "human", table),
        robot_settings=settings_from(RobotSettings, "robot", table),
        sensor=settings_from(SensorSettings, "sensor", table),
    )


def _bodies(rows: Rows, people: Sequence[str], robot: str | None) -> tuple[Sequence[str], str]:
    """Who is in the room: those whom ``body/2`` names, else those who are watched and who helps."""
    named: dict[str, list[str]] = {"person": [], "mobile_manipulator": []}
    for name, kind in rows("body", 2):
        _one_of(name, kind, tuple(named))
        named[kind].append(name)
    if not (named["person"] or people):
        raise DomainError("the scene has no body(Name, person)")
    machine = (*named["mobile_manipulator"], robot)[0]
    if machine is None:
        raise DomainError("the scene has no body(Name, mobile_manipulator)")
    return tuple(dict.fromkeys(named["person"] or people)), machine


# --- the room -------------------------------------------------------------------------------------------------------


def _outline(rows: Rows) -> tuple[Point, ...]:
    """The corners that are said, or those of a rectangle round (0, 0)."""
    sizes = [(_n(x), _n(y)) for x, y in rows("room_size", 2)]
    if tuple(rows("outline", 3)) or not sizes:
        return _corners(rows, "outline", "; or state its size: room_size(SizeX, SizeY)")
    if min(sizes[0]) <= 0 or len(sizes) > 1:
        raise DomainError("room_size(SizeX, SizeY) is one fact with two lengths in metres")
    x, y = sizes[0][0] / 2, sizes[0][1] / 2
    return ((x, y), (-x, y), (-x, -y), (x, -y))


def _walkable(
    rows: Rows, outline: tuple[Point, ...], furniture: Sequence[Furniture]
) -> tuple[tuple[Point, ...], tuple[Hole, ...]]:
    """Where one can walk: as said, or wherever no furniture stands."""
    holes = tuple((_n(a), _n(b), _n(c), _n(d)) for _, a, b, c, d in rows("hole", 5))
    if tuple(rows("walkable", 3)):
        return _corners(rows, "walkable"), holes
    return outline, (*holes, *(piece.footprint for piece in furniture))


def _corners(rows: Rows, name: str, otherwise: str = "") -> tuple[Point, ...]:
    corners = tuple((_n(x), _n(y)) for _, x, y in sorted(rows(name, 3)))
    if len(corners) < 3:
        need = f"the scene needs at least three corners {name}(Number, X, Y)"
        raise DomainError(f"{need}; it has {len(corners)}{otherwise}")
    return corners


def _middle(outline: Sequence[Point]) -> Point:
    xs, ys = zip(*outline)
    return (min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2


# --- furniture ------------------------------------------------------------------------------------------------------


def _furniture(rows: Rows, middle: Point) -> tuple[Furniture, ...]:
    """``furniture(Name, Kind, X, Y)``, with sizes and with the height of its top where these are not the usual ones."""
    shelves: dict[str, Any] = dict(rows("shelf", 2))
    sides: dict[str, Any] = dict(rows("opens", 2))
    pieces: dict[str, Furniture] = {}
    for arity in (7, 6, 4):
        for name, kind, *numbers in rows("furniture", arity):
            if kind not in FURNITURE_KINDS:
                raise DomainError(f"furniture {name} is a {kind}; it must be one of {', '.join(FURNITURE_KINDS)}")
            if name in pieces:
                raise DomainError(f"furniture({name}, {kind}, …) is there twice")
            x, y, *sizes = map(_n, numbers)
            size_x, size_y, top = (*sizes, *SIZES[kind][len(sizes) :])
            side = _side(kind, name, sides, (x, y), middle)
            shelf = _n(shelves.get(name, SHELF)) if name in shelves or kind == "cabinet" else None
            pieces[name] = Furniture(name, kind, x, y, size_x, size_y, top, shelf, side)
    return tuple(pieces.values())


def _side(kind: str, name: str, sides: Mapping[str, Any], at: Point, middle: Point) -> str | None:
    """The side on which a cabinet is open: as said, or towards the middle of the room."""
    if name in sides:
        _one_of(name, sides[name], SIDES)
        return str(sides[name])
    return faces(at, middle) if kind == "cabinet" else None


# --- things ---------------------------------------------------------------------------------------------------------


def _things(rows: Rows, furniture: Sequence[Furniture], middle: Point) -> dict[str, Thing]:
    shapes, masses = _shapes(rows), {name: _n(mass) for name, mass in rows("mass", 2)}
    placings: dict[str, str] = dict(rows("placing", 2))
    colours = {name: (_n(r), _n(g), _n(b)) for name, r, g, b in rows("colour", 4)}
    things: dict[str, Thing] = {}
    for name, (x, y, z) in _positions(rows, shapes, furniture, middle).items():
        kind, size = shapes[name]
        _one_of(name, kind, MOVABLE_SHAPES if name in masses else (*FIXED_SHAPES, *MOVABLE_SHAPES))
        mass = masses.get(name, MASS if kind in MOVABLE_SHAPES else None)
        placing = placings.get(name, PLACED.get(kind))
        if placing is not None:
            _one_of(name, placing, PLACINGS)
        colour = colours.get(name, PALETTE[len(things) % len(PALETTE)])
        things[name] = Thing(name, x, y, z, kind, size, mass, placing, colour)
    if not things:
        raise DomainError("the scene has no object: position(Name, X, Y, Z) or position(Name, Furniture) is missing")
    for name in (*shapes, *masses, *placings):
        _needs(name, things, f"position({name}, X, Y, Z) or position({name}, Furniture)")
    return things


def _shapes(rows: Rows) -> dict[str, tuple[str, Spot]]:
    """Kind and sizes of each thing, where only the kind is said the usual sizes."""
    shapes = {name: (kind, (_n(x), _n(y), _n(z))) for name, kind, x, y, z in rows("shape", 5)}
    for name, kind in rows("shape", 2):
        _one_of(name, kind, tuple(SHAPES))
        if name in shapes:
            raise DomainError(f"shape({name}, {kind}) and another shape({name}, …): a thing has one")
        shapes[name] = (kind, SHAPES[kind])
    return shapes


def _positions(
    rows: Rows, shapes: Mapping[str, tuple[str, Spot]], furniture: Sequence[Furniture], middle: Point
) -> dict[str, Spot]:
    """Where each thing is: in full, at a point of the floor plan, or somewhere on a piece of furniture."""
    full = {name: (_n(x), _n(y), _n(z)) for name, x, y, z in rows("position", 4)}
    flat = {name: (_n(x), _n(y)) for name, x, y in rows("position", 3)}
    pieces, on = {piece.name: piece for piece in furniture}, dict[str, list[str]]()
    for name, piece in rows("position", 2):
        if piece not in pieces:
            there = ", ".join(pieces) or "none"
            raise DomainError(f"position({name}, {piece}) needs the furniture {piece}; there is {there}")
        on.setdefault(piece, []).append(name)
    for piece, names in on.items():
        flat |= zip(names, spread(pieces[piece], len(names), middle))
    for name in (*full, *flat):
        _needs(name, shapes, f"shape({name}, Kind) or shape({name}, Kind, SizeX, SizeY, SizeZ)")
    return full | {name: (*at, height_on(furniture, at, shapes[name][0])) for name, at in flat.items()}


def _needs(name: str, table: Mapping[str, Any], fact: str) -> None:
    if name not in table:
        raise DomainError(f"the scene says nothing of {name} here: {fact} is missing")


def _one_of(name: str, value: Any, allowed: Sequence[str]) -> None:
    if value not in allowed:
        raise DomainError(f"{name} cannot be {value}; it must be one of {', '.join(allowed)}")


def _n(value: Any) -> float:
    if not math.isfinite(as_float(value)):
        raise DomainError(f"the scene needs a number where it has {value!r:.40}")
    return as_float(value)
