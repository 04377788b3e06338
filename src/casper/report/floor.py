"""The room from above as a picture: walls, furniture, things and people; what moves is moved by the page's script."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from casper.engine.events.event import Event
from casper.engine.perception.world import WorldState
from casper.notebook.markup import Markup, joined, tag
from casper.report.recording import Box, Recording, Room
from casper.report.story import names_of

SCALE = 100  # units of the picture a metre
MARGIN = 0.35  # metres around what there is to see
THING = 0.07  # metres: the radius of a thing of which nothing is said
BODY = 0.22  # metres: the radius of an agent
LETTER = 0.065  # metres a letter takes: furniture that is wide enough for its name gets it
LINE, ROOM = 0.13, 0.7  # metres: the height of a line of text, and beside a thing what its own name takes
BESIDE = 0.24  # metres between numbers that would lie on each other
MOST_MARKS = 40  # numbered places on the way


def floor_svg(recording: Recording, colours: Mapping[str, str]) -> Markup:
    """The room at its beginning; groups with ``data-agent`` and ``data-object`` are what moves."""
    left, low, right, high = extent(recording)
    box = f"{_n(left)} {_n(-high)} {_n(right - left)} {_n(high - low)}"
    agents = list(dict.fromkeys(name for state in recording.states for name in state.agents))
    objects = list(dict.fromkeys(name for state in recording.states for name in state.objects))
    first = {name: state for state in reversed(recording.states) for name in state.objects}
    parts = [
        joined(_walls(recording.room, [(at.objects[name].x, at.objects[name].y) for name, at in first.items()])),
        *(_way(name, recording) for name in agents),
        *(tag("polyline", class_=f"trail {_side(name, recording)}", data_trail=name, points="") for name in agents),
        *(tag("line", class_="gaze", data_gaze=name) for name in recording.partners),
        *(_thing(name, first[name], recording.room, colours) for name in objects),
        *marks(recording),
        *(_agent(name, recording) for name in agents),
    ]
    title = tag("title", "the room from above; the slider below moves what happens")
    return tag("svg", title, *parts, xmlns="http://www.w3.org/2000/svg", viewBox=box, class_="floor", role="img")


def extent(recording: Recording) -> Box:
    """What has to be seen: the walls, and everybody and everything that was anywhere (metres)."""
    points = [*recording.room.outline]
    for state in recording.states:
        points += [(a.x, a.y) for a in state.agents.values()] + [(o.x, o.y) for o in state.objects.values()]
    xs, ys = zip(*points) if points else ((-1.0, 1.0), (-1.0, 1.0))
    return min(xs) - MARGIN, min(ys) - MARGIN, max(xs) + MARGIN, max(ys) + MARGIN


def marks(recording: Recording) -> Iterator[Markup]:
    """Numbers on the floor: where the partner was when an action of theirs was made out."""
    names = {name: at for at, name in enumerate(recording.partners)}
    number = 0
    taken: list[tuple[float, float]] = []
    for event in recording.of_type("reading"):
        state = _state_at(recording, event.t)
        agent = state.agents.get(str(event.data.get("agent"))) if state is not None else None
        number += 1
        if agent is None or event.data.get("agent") not in names or number > MOST_MARKS:
            continue
        step = names_of(recording, event).tell.theirs(event.data["observations"][-1])
        about = tag("title", f"{number}: {step}, {event.t:g} s")
        spot = _beside((agent.x, agent.y), taken)
        taken.append(spot)
        dot = tag("circle", r=11)
        text = tag("text", number, y=5, text_anchor="middle")
        where = f"translate({_n(spot[0])} {_n(-spot[1])})"
        yield tag("g", about, dot, text, class_="mark", transform=where, data_t=repr(event.t))


def _beside(spot: tuple[float, float], taken: Sequence[tuple[float, float]]) -> tuple[float, float]:
    """The spot, or one to its right that is still free."""
    x, y = spot
    while any(math.hypot(x - a, y - b) < 0.9 * BESIDE for a, b in taken):
        x += BESIDE
    return x, y


def _state_at(recording: Recording, t: float) -> WorldState | None:
    """The last world state that is no later."""
    return next((state for state in reversed(recording.states) if state.t <= t), None)


def _walls(room: Room, things: Sequence[tuple[float, float]]) -> Iterator[Markup]:
    if room.outline:
        yield tag("polygon", points=" ".join(f"{_n(x)},{_n(-y)}" for x, y in room.outline), class_="walls")
    for name, (left, low, right, high) in room.furniture.items():
        box = {"x": _n(left), "y": _n(-high), "width": _n(right - left), "height": _n(high - low)}
        middle = (left + right) / 2
        rows = ((low + high) / 2, low + LINE, high - LINE)
        free = [y for y in rows if not any(abs(x - middle) < ROOM and -LINE < b - y < 3 * LINE for x, b in things)]
        fits = free and right - left >= LETTER * len(name)
        named = [tag("text", _plain(name), text_anchor="middle", x=_n(middle), y=_n(-free[0]) + 4)] if fits else []
        yield tag("g", tag("title", _plain(name)), tag("rect", **box, rx=3), *named, class_="furniture low")


def _way(name: str, recording: Recording) -> Markup:
    points = " ".join(f"{_n(a.x)},{_n(-a.y)}" for s in recording.states if (a := s.agents.get(name)) is not None)
    return tag("polyline", points=points, class_=f"way {_side(name, recording)}")


def _thing(name: str, state: WorldState, room: Room, colours: Mapping[str, str]) -> Markup:
    where = state.objects[name]
    shape = tag("circle", r=_n(room.radii.get(name, THING)), fill=colours.get(name, "currentColor"))
    kind = "thing fixed" if name in room.fixed else "thing"
    label = tag("text", _plain(name), text_anchor="middle", y=_n(room.radii.get(name, THING)) + 15)
    at = f"translate({_n(where.x)} {_n(-where.y)})"
    return tag("g", tag("title", _plain(name)), shape, label, class_=kind, data_object=name, transform=at)


def _agent(name: str, recording: Recording) -> Markup:
    beak = tag("path", d="M20 -11L36 0L20 11Z")
    turned = tag("g", tag("circle", r=_n(BODY)), beak, class_="turned")
    label = tag("text", names_of(recording).tell.name(name), text_anchor="middle", y=_n(-BODY) - 9)
    return tag("g", turned, label, class_=f"agent {_side(name, recording)}", data_agent=name)


def _side(name: str, recording: Recording) -> str:
    return "robot" if name == recording.robot else "partner"


def _plain(name: str) -> str:
    return name.replace("_", " ")


def _n(metres: float) -> float:
    return round(metres * SCALE, 1)


def is_about(event: Event, partner: str) -> bool:
    """Whether an event is about a partner, or the robot's part for them."""
    return partner in (event.data.get("agent"), event.data.get("partner"))
