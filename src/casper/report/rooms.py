"""The room of a domain from above, where its scene is stated."""

from __future__ import annotations

from casper.engine.domain.domain import Domain
from casper.kb.errors import DomainError
from casper.report.recording import Room
from casper.sim_adapter.room.facts import scene_of


def room_of(domain: Domain) -> Room:
    """Walls, furniture and things of a domain's scene; an empty room where the domain states none.

    A robot that sends world states needs no scene, so one that is incomplete is no mistake here.
    """
    try:
        scene = scene_of(domain)
    except DomainError:
        return Room()
    return Room(
        scene.outline,
        {piece.name: piece.footprint for piece in scene.furniture},
        {name: thing.radius for name, thing in scene.things.items()},
        frozenset(name for name, thing in scene.things.items() if not thing.movable),
    )
