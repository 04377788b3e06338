"""Whom the robot looks at: the one person there is, or of several those whom it can see at once, else one by one."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Protocol

from casper.sim_adapter.eye.sensors import Sensor
from casper.sim_adapter.room.geometry import bearing, turn
from casper.sim_adapter.room.scene import Point

DWELL = 1.0  # seconds it looks at one of several before it looks at the next
KEPT = 4.0  # seconds for which somebody is thought to be where they were last seen
SPARE = 0.8  # share of the field of view within which several must be to be looked at together


class Person(Protocol):
    """Somebody who stands somewhere."""

    @property
    def place(self) -> Point:
        """Where, x and y in metres."""


class Head(Protocol):
    """What is turned after people (`sim_adapter.robot.head`)."""

    def notice(self, place: Point, /) -> None:
        """Somebody was seen there just now."""


class Attention:
    """Tells the head where to look, whenever it is asked to (`update`)."""

    def __init__(self, sensor: Sensor, head: Head, people: Mapping[str, Person]) -> None:
        self.sensor, self.head, self.people = sensor, head, people
        self._last: dict[str, tuple[Point, float]] = {}  # where each was seen, and when

    def update(self) -> None:
        """Look who is in view, and turn to where they are."""
        now = self.sensor.physics.time
        for name, person in self.people.items():
            if self.sensor.sees_person(person.place):
                self._last[name] = (person.place, now)
        kept = KEPT if len(self.people) > 1 else 0.0
        known = [place for place, t in self._last.values() if now - t <= kept]
        if known:
            self.head.notice(self._aim(known, now))

    def _aim(self, places: list[Point], now: float) -> Point:
        """The middle of all, when they fit into the view; else each in turn."""
        if len(places) == 1:
            return places[0]
        eye = self.sensor.eye
        here = float(eye[0]), float(eye[1])
        first = bearing(here, places[0])
        turns = [turn(bearing(here, place) - first) for place in places]
        if max(turns) - min(turns) > SPARE * math.radians(self.sensor.settings.field_of_view):
            return places[int(now / DWELL) % len(places)]
        gaze, reach = first + (max(turns) + min(turns)) / 2, max(math.dist(here, place) for place in places)
        return here[0] + reach * math.cos(gaze), here[1] + reach * math.sin(gaze)
