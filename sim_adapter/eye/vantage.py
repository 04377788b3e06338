"""Where the robot watches from: the free spot that sees most of the objects and is in nobody's way."""

from __future__ import annotations

import math

import numpy as np

from casper.sim_adapter.eye.sensors import Sensor, visible_from
from casper.sim_adapter.physics.physics import Physics
from casper.sim_adapter.room.navigation import CELL, Navigator
from casper.sim_adapter.room.scene import Point

APART = (1.1, 0.9, 0.7)  # metres kept from every object, so that the partner can get at it; less in a narrow room


def vantage(physics: Physics, sensor: Sensor, navigator: Navigator, start: Point) -> Point:
    """The best spot, of equally good ones the nearest to the start; the start when there is no free spot."""
    things = physics.scene.things
    where = physics.positions()

    def seen(spot: Point) -> int:
        eye = np.array([*spot, physics.body.eye_height])
        return sum(visible_from(sensor, eye, things[name], at) for name, at in where.items())

    spots = [(CELL * column, CELL * row) for column, row in navigator.graph]
    for apart in APART:
        free = [spot for spot in spots if all(math.dist(spot, at[:2]) >= apart for at in where.values())]
        if free:
            return max(free, key=lambda spot: (seen(spot), -math.dist(spot, start)))
    return start
