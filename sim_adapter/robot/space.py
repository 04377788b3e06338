"""Speed and separation monitoring: how near people are, and at which share of its speed the robot may move.

The measure that safety standards of collaborative robots take (ISO/TS 15066, 5.5.4): the nearer somebody is, the
slower; inside a limit it stands still, whoever came nearer. What is measured is the gap between outlines, in metres:

* on the floor plan, between a person's body (a disc of ``setting(human, radius, R)``) and the robot's base (a disc of
  ``setting(robot, radius, R)``) or its arm (from the base's middle to the fingertips);
* in space, between a person's hand and the fingertips.
"""

from __future__ import annotations

import math

from casper.sim_adapter.physics.model import hand_name
from casper.sim_adapter.physics.physics import Physics
from casper.sim_adapter.room.geometry import point_to_segment
from casper.sim_adapter.room.placement import Spot
from casper.sim_adapter.room.scene import Point

MOVING = 0.03  # m/s of base or fingertips; what is slower stands (servos give way a little)
ARM = 0.05  # radius of the arm on the floor plan
HANDS = 0.10  # radii of a person's hand and of the gripper together
FAR = 2.0  # metres between middles beyond which only the bases' outlines matter
REACTION = 0.5  # seconds until the robot stands: an approaching person comes nearer meanwhile
BRAKING = 0.15  # seconds at its speed that it rolls on once it shall stand
SPARE = 0.01  # metres


class Space:
    """What is known of the people round the robot at this moment, and the least distance so far.

    ``pace`` is the share of its speed at which the robot may move: 1 while nobody is within ``slow_distance``, less the
    nearer somebody is, that of ``slow_speed`` just outside ``stop_distance``, and 0 within. ``least`` is the least gap
    while it moved, ``speed`` its speed then (m/s, of base or fingertips, whichever was faster); infinite and 0 while it
    never moved.
    """

    def __init__(self, physics: Physics) -> None:
        self.physics = physics
        scene = physics.scene
        self.name, self.people = scene.robot, scene.people
        self.settings = scene.robot_settings
        self.bodies = scene.human_settings.radius + self.settings.radius
        self.arms = scene.human_settings.radius + ARM
        self.pace, self.gap = 1.0, math.inf
        self.least, self.speed = math.inf, 0.0
        self._dt = scene.sim.control
        self._before: dict[str, tuple[Point, Spot]] = {}  # where each person's body and hand were a control step ago
        self._own: tuple[Point, Spot] | None = None  # the same of the robot's base and fingertips

    def update(self, base: Point) -> None:
        """Look how near everybody is, at every control step."""
        x, y, z = self.physics.site(f"{self.name}:tool")
        tool: Spot = (float(x), float(y), float(z))
        self.gap, soon = math.inf, math.inf
        for name in self.people:
            gap, then = self._gap(name, base, tool)
            self.gap, soon = min(self.gap, gap), min(soon, then)
        own = self._own or (base, tool)
        speed = max(math.dist(base, own[0]), math.dist(tool, own[1])) / self._dt
        if speed > MOVING and self.gap < self.least:
            self.least, self.speed = self.gap, speed
        self.pace = self._pace(soon - SPARE - BRAKING * speed)
        self._own = base, tool

    def _gap(self, name: str, base: Point, tool: Spot) -> tuple[float, float]:
        """The gap to somebody now, and when the robot would stand if they go on as they do."""
        x, y, _ = self.physics.position(name)
        hand = self.physics.position(hand_name(name))
        body, before = (x, y), self._before.get(name, ((x, y), hand))
        self._before[name] = body, hand
        apart = math.dist(body, base)
        gap = apart - self.bodies
        if apart > FAR:
            return gap, gap
        gap = min(gap, point_to_segment(body, (base, tool[:2])) - self.arms)
        near = math.dist(hand, tool) - HANDS
        ahead = REACTION / self._dt
        coming = max(0.0, math.dist(before[0], base) - apart) * ahead
        reaching = max(0.0, math.dist(before[1], tool) - HANDS - near) * ahead
        return min(gap, near), min(gap - coming, near - reaching)

    def _pace(self, gap: float) -> float:
        stop, slow = self.settings.stop_distance, self.settings.slow_distance
        if gap <= stop:
            return 0.0
        least = min(1.0, self.settings.slow_speed / self.settings.drive_speed)
        return 1.0 if gap >= slow else least + (1.0 - least) * (gap - stop) / (slow - stop)
