"""The room in three dimensions: walls, furniture, things and agents where they are, ways, and what is attended to."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from casper.engine.events.event import Event
from casper.engine.perception.world import AgentState, WorldState
from casper.sim_adapter.room.scene import Furniture, Scene, Thing

TALL, STOUT = 1.65, 0.17  # metres: an agent's height and radius
EYES = 1.5  # metres above the floor, from where attention goes out
THING = 0.05  # metres: half the size of a thing of which nothing is said
PARTNER, ROBOT = (40, 125, 110), (60, 100, 170)
WOOD, WALLS, ATTENTION = (170, 145, 115, 90), (120, 120, 120), (230, 150, 30)
Place = tuple[float, float, float]
Entity = tuple[str, ...]


class Room:
    """Shows world states to a stream whose time has been set; what has not moved is not shown again."""

    def __init__(self, stream: Any, robot: str, scene: Scene | None) -> None:
        self.stream, self.robot, self.scene = stream, robot, scene
        self._shown: dict[Entity, tuple[float, ...]] = {}  # where each was shown last
        self._places: dict[str, Place] = {}
        if scene is not None:
            self._build(scene)

    def show(self, world: WorldState) -> None:
        """Everybody and everything where they are now; what is not in the world state is not shown."""
        import rerun

        for name, thing in world.objects.items():
            height = thing.z if thing.z is not None else self._height(name)
            self._places[name] = (thing.x, thing.y, height)
            self._thing(("room", "things", name), name, (thing.x, thing.y, height))
        for name, agent in world.agents.items():
            self._places[name] = (agent.x, agent.y, 0.0)
            self._agent(("room", "agents", name), name, agent)
        seen: set[Entity] = {("room", "things", name) for name in world.objects}
        seen |= {("room", "agents", name) for name in world.agents}
        for entity in [entity for entity in self._shown if entity not in seen]:
            del self._shown[entity]
            self.stream.log([*entity], rerun.Clear(recursive=True))

    def attend(self, event: Event) -> None:
        """An arrow from a partner's eyes to what they attend to (an event ``focus``)."""
        import rerun

        who, target = str(event.data.get("agent")), event.data.get("target")
        entity = ["room", "attention", who]
        if who not in self._places or target not in self._places:
            self.stream.log(entity, rerun.Clear(recursive=True))
            return
        x, y, _ = self._places[who]
        tip = self._places[str(target)]
        way = (tip[0] - x, tip[1] - y, tip[2] - EYES)
        self.stream.log(entity, rerun.Arrows3D(origins=[(x, y, EYES)], vectors=[way], colors=[ATTENTION], radii=0.012))

    # -- what moves ---------------------------------------------------------------------------------------------------

    def _thing(self, entity: Entity, name: str, at: Place) -> None:
        import rerun

        if self._shown.get(entity) == at:
            return
        if entity not in self._shown:
            self.stream.log([*entity], self._shape(name))
        self._shown[entity] = at
        self.stream.log([*entity], rerun.Transform3D(translation=at))

    def _agent(self, entity: Entity, name: str, agent: AgentState) -> None:
        import rerun

        at = (agent.x, agent.y, agent.heading)
        last = self._shown.get(entity)
        if last == at:
            return
        colour = ROBOT if name == self.robot else PARTNER
        if last is None:
            body = rerun.Capsules3D(
                lengths=[TALL - 2 * STOUT],
                radii=[STOUT],
                translations=[(0, 0, STOUT)],
                colors=[(*colour, 150)],
                labels=[name],
                fill_mode="solid",
            )
            self.stream.log([*entity], body)
            nose = rerun.Arrows3D(origins=[(0, 0, EYES)], vectors=[(0.4, 0, 0)], colors=[colour], radii=0.02)
            self.stream.log([*entity, "heading"], nose)
        else:
            piece = [(last[0], last[1], 0.02), (agent.x, agent.y, 0.02)]
            self.stream.log(["room", "ways", name], rerun.LineStrips3D([piece], colors=[colour], radii=0.015))
        self._shown[entity] = at
        turned = rerun.RotationAxisAngle(axis=(0, 0, 1), radians=agent.heading)
        self.stream.log([*entity], rerun.Transform3D(translation=(agent.x, agent.y, 0.0), rotation=turned))

    # -- what stays ---------------------------------------------------------------------------------------------------

    def _build(self, scene: Scene) -> None:
        import rerun

        outline = [(x, y, 0.0) for x, y in (*scene.outline, scene.outline[0])]
        self.stream.log("room/walls", rerun.LineStrips3D([outline], colors=[WALLS], radii=0.02), static=True)
        for piece in scene.furniture:
            boxes = _boxes(piece)
            shown = rerun.Boxes3D(
                centers=[centre for centre, _ in boxes],
                half_sizes=[half for _, half in boxes],
                colors=[WOOD],
                fill_mode="solid",
            )
            self.stream.log(["room", "furniture", piece.name], shown, static=True)

    def _height(self, name: str) -> float:
        things: Mapping[str, Thing] = self.scene.things if self.scene is not None else {}
        return things[name].z if name in things else 0.0

    def _shape(self, name: str) -> Any:
        """A box as large as the thing, with its name."""
        import rerun

        thing = self.scene.things.get(name) if self.scene is not None else None
        if thing is None:
            return rerun.Boxes3D(half_sizes=[(THING, THING, THING)], labels=[name])
        x, y, z = (max(0.01, size / 2) for size in thing.size)
        colour = [round(255 * part) for part in thing.colour]
        # A movable's origin is its middle; a basin goes down from where it is, a panel lies on it.
        rise = 0.0 if thing.movable else -z if thing.shape == "basin" else z
        how: dict[str, Any] = {"colors": [colour], "labels": [name], "fill_mode": "solid"}
        return rerun.Boxes3D(centers=[(0, 0, rise)], half_sizes=[(x, y, z)], **how)


def _boxes(piece: Furniture) -> list[tuple[Place, Place]]:
    """Middles and half sizes: a counter is one box, a table a board, a cabinet its board and its top."""
    half = piece.size_x / 2, piece.size_y / 2
    if piece.kind == "counter":
        return [((piece.x, piece.y, piece.top / 2), (*half, piece.top / 2))]
    boards = [piece.top] if piece.shelf is None else [piece.shelf, piece.top]
    return [((piece.x, piece.y, top - 0.015), (*half, 0.015)) for top in boards if math.isfinite(top)]
