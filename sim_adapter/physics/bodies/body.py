"""What a body of the robot is: how it is built, how its arm reaches, and the measures that differ between bodies.

Every body has the same names, after the robot's (``tiago:x``): joints and servos ``x``, ``y``, ``yaw``, ``lift``,
``pan``, ``tilt``, ``inner_finger``, ``outer_finger`` and those of its arm; bodies ``hand`` (what is held is welded to
it), ``inner_finger`` and ``outer_finger`` (they touch); sites ``tool``, between the fingertips, and ``eye``, where a
camera of that name is.
The base frame has x ahead, y to the left, z up from the floor.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from casper.sim_adapter.room.placement import Spot
from casper.sim_adapter.room.scene import Scene

Reach: TypeAlias = Callable[[Spot, float, float], Sequence[float] | None]
"""Angles of the arm's joints that bring the fingertips to a point of the base frame, with the lift (metres) and the
hand's roll (radians) as they are; None: out of reach."""


@dataclass(frozen=True, slots=True)
class Body:
    """A body; metres and radians.

    Attributes:
        name: by which it is asked for.
        check: raises a CasperError where what it is made of is missing.
        add: builds it into a MjSpec.
        reach: makes, for a compiled model and the robot's name, what brings the fingertips to a point; it may remember
            where the arm was.
        arm: the arm's joints, in the order in which ``reach`` gives angles.
        home: the fingertips while nothing is to be done, base frame.
        carry_clear: the underside of what is carried is kept above this.
        best_lift: the lift at which the arm works best with the fingertips at a height.
        eye_height: of the eye while nothing is to be done.
        opening: half the widest opening between the fingers.
        roll: how far the hand is rolled to take something round its top; a rim it pinches unrolled, one finger nearer
            to the robot than the other.
        lift_follows: whether the lift goes with the fingertips at all times; otherwise it is brought to where they will
            work before they do.
    """

    name: str
    check: Callable[[], object]
    add: Callable[[Any, Scene], None]
    reach: Callable[[Any, str], Reach]
    arm: tuple[str, ...]
    home: Spot
    carry_clear: float
    best_lift: Callable[[float], float]
    eye_height: float
    opening: float
    roll: float = 0.0
    lift_follows: bool = False


def eye_name(robot: str) -> str:
    """Name of the camera, and of the site it sits at."""
    return f"{robot}:eye"
