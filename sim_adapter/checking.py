"""What a scene lacks: what cannot be built, acted out or reached in a domain's room, as findings with their places.

Needs no simulator: `casper check` tells it beside what else is wrong.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from itertools import combinations, islice
from pathlib import Path

from casper.engine.domain.check import check_domain
from casper.engine.domain.domain import Domain
from casper.engine.domain.relations import SCENE_RELATIONS
from casper.engine.movements.leaves import MOVEMENTS
from casper.kb.checks.finding import Finding, Severity, error, note, sorted_findings, warning
from casper.kb.errors import CasperError, Place
from casper.kb.terms.clauses import Indicator
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import as_term
from casper.plans.trees.plan import Plan
from casper.sim_adapter.room.facts import scene_of
from casper.sim_adapter.room.geometry import Floor, floor_of, inside
from casper.sim_adapter.room.scene import Point, Scene
from casper.sim_adapter.script import acted_out
from casper.sim_adapter.steps import HANDLING, check_objects

MOST_PLANS = 200  # looked at
HUMAN_REACH, ROBOT_REACH = 0.6, 0.7  # metres from the feet within which something can be handled
STRIDE = 0.5  # metres: who has two places nearer to each other reaches both without a step
GRAZE = 0.05  # metres somebody may begin too near to a wall
ONE_PLACE = 0.15  # metres within which one thing lies on another


def check_whole(name: str | Path) -> list[Finding]:
    """Everything that is wrong with a domain, its scene included, by file and line.

    Raises:
        DomainError: there is no such domain.
    """
    findings = check_domain(name)
    if any(finding.severity is Severity.ERROR for finding in findings):
        return findings
    return sorted_findings([*findings, *scene_findings(Domain.load(name))])


def scene_findings(domain: Domain) -> Iterator[Finding]:
    """What is wrong with the scene; nothing where there is none."""
    first = next((c.place for i in sorted(SCENE_RELATIONS) for c in domain.kb.clauses_of(i)), None)
    if first is None:
        return
    try:
        scene = scene_of(domain)
    except CasperError as mistake:
        yield error(mistake.place or first, mistake.sentence)
        return
    yield from _nothing_to_see_with(domain, first)
    yield from _misplaced(domain, scene, first)
    used: dict[str, Place] = {}
    for plan in islice(domain.library.ways if domain.library.is_listed else (), MOST_PLANS):
        yield from _cannot_be_acted_out(domain, scene, plan, used)
    yield from _out_of_reach(scene, floor_of(scene), used)
    yield from _too_near(scene, used)


def _nothing_to_see_with(domain: Domain, place: Place) -> Iterator[Finding]:
    wanted: dict[str, tuple[Indicator, ...]] = {"actions": (("transition", 4),), "movements": MOVEMENTS}
    for what, indicators in wanted.items():
        if not any(domain.kb.clauses_of(indicator) for indicator in indicators):
            advice = 'write :- include("household.pl"). in actions.pl'
            yield error(place, f"there is a room, and nothing says how {what} are made out in it; {advice}")


def _misplaced(domain: Domain, scene: Scene, first: Place) -> Iterator[Finding]:
    """Furniture outside, things on no furniture, people and robots who begin where nobody can stand."""
    floor = floor_of(scene)
    for piece in scene.furniture:
        if not inside(scene.outline, (piece.x, piece.y)):
            yield warning(_place(domain, "furniture", piece.name, first), f"{piece.name} stands outside the room")
    for thing in scene.things.values():
        boards = [p.surface for p in scene.furniture if p.holds(thing.x, thing.y) and p.surface <= thing.z + 0.02]
        if not boards:
            where = _place(domain, "position", thing.name, first)
            yield warning(where, f"{thing.name} is on no furniture, and no hand reaches the floor")
    for name, (x, y, _) in scene.starts.items():
        radius = scene.robot_settings.radius if name == scene.robot else scene.human_settings.radius
        if not floor.free((x, y), radius - GRAZE):
            yield error(_place(domain, "start", name, first), f"{name} cannot start there: it is not on the free floor")


def _cannot_be_acted_out(domain: Domain, scene: Scene, plan: Plan, used: dict[str, Place]) -> Iterator[Finding]:
    """Steps of a plan for which there is no skill, no such thing in the room, or no way to put it there."""
    try:
        script = acted_out(domain, plan)
    except CasperError as mistake:
        yield warning(mistake.place or plan.place, f"{plan.label} cannot be acted out: {mistake.sentence}")
        return
    for scripted, node in zip(script, plan.actions):
        shown, step = term_text(as_term(scripted.action or node.term)), scripted.step
        if step.skill not in HANDLING:
            advice = f"state context(use, {step.destination}, {step.skill}) in actions.pl if it is a use there"
            yield warning(node.place, f"nobody has a skill for {shown}; {advice}")
            return
        try:
            check_objects(scene, step)
        except CasperError as mistake:
            yield warning(node.place, f"{plan.label} cannot be acted out: {mistake.sentence}")
            return
        used.setdefault(str(step.target), node.place)
        used.setdefault(str(step.destination), node.place)


def _out_of_reach(scene: Scene, floor: Floor, used: Mapping[str, Place]) -> Iterator[Finding]:
    for name, place in used.items():
        thing = scene.things[name]
        for who, radius, reach in (
            ("people", scene.human_settings.radius, HUMAN_REACH),
            (scene.robot, scene.robot_settings.radius, ROBOT_REACH),
        ):
            if not _can_stand_near(floor, (thing.x, thing.y), radius, reach):
                sentence = f"{name} is out of reach for {who}: there is no free floor within {reach:g} m of it"
                yield warning(place, sentence)


def _can_stand_near(floor: Floor, at: Point, radius: float, reach: float) -> bool:
    rings = [reach - 0.05 * step for step in range(7)]
    angles = [math.radians(degrees) for degrees in range(0, 360, 5)]
    return any(
        floor.free((at[0] + ring * math.cos(a), at[1] + ring * math.sin(a)), radius) for ring in rings for a in angles
    )


def _too_near(scene: Scene, used: Mapping[str, Place]) -> Iterator[Finding]:
    """Places between which nobody takes a step: what is moved from one to the other is not seen."""
    fixed = [thing for name, thing in scene.things.items() if name in used and not thing.movable]
    for one, other in combinations(fixed, 2):
        apart = math.dist((one.x, one.y), (other.x, other.y))
        if ONE_PLACE < apart < STRIDE:
            advice = f"what is moved from one to the other without a step is not seen; put them {STRIDE:g} m apart"
            yield note(used[other.name], f"{one.name} and {other.name} are {apart:.2f} m apart: {advice}")


def _place(domain: Domain, relation: str, name: str, otherwise: Place) -> Place:
    """The fact about a name."""
    indicators = sorted(i for i in SCENE_RELATIONS if i[0] == relation)
    found = (c.place for i in indicators for c in domain.kb.clauses_of(i) if c.head.args[0] == name)
    return next(found, otherwise)
