"""The primitive body: an actuated mobile base, torso lift, arm, two-finger gripper, and a head with a camera."""

from __future__ import annotations

import math
from typing import Any

from casper.sim_adapter.physics.bodies.body import Body, Reach, eye_name
from casper.sim_adapter.physics.parts import (
    BASE_BITS,
    FINGER_BITS,
    NO_BITS,
    ROBOT,
    add_base,
    add_geom,
    add_limb,
    add_servo_hinge,
    rgba,
)
from casper.sim_adapter.room.placement import Spot
from casper.sim_adapter.room.scene import BODY, Scene

HOME: Spot = (0.42, 0.0, 1.18)
ABOVE = 0.17  # the shoulder works best this far above the wrist
SHOULDER_X, SHOULDER_Z = 0.14, 0.82  # shoulder in the base frame with the lift down
LIFT_RANGE = (0.0, 0.35)
UPPER, FORE, TOOL = 0.34, 0.33, 0.16  # arm links, and wrist to fingertips
OPEN = 0.055  # half the opening between the fingers
FINGER = 0.008  # half the thickness of a finger
HEAD_X, HEAD_Z = 0.02, 0.36  # head above the shoulder's height
ARM = ("arm_yaw", "arm_lift", "arm_elbow", "arm_wrist", "arm_roll")
DARK, LIGHT, BLUE = rgba(0.2, 0.2, 0.22), rgba(0.92, 0.92, 0.92), rgba(0.25, 0.4, 0.7)


def add_primitive(spec: Any, scene: Scene) -> None:
    """The whole body."""
    name = scene.robot
    base = add_base(spec, name)
    radius = scene.robot_settings.radius - 0.03
    add_geom(base, "cylinder", (radius, 0.13), (0, 0, 0.16), colour=DARK, group=ROBOT, bits=BASE_BITS, mass=40)
    add_geom(base, "box", (0.1, 0.13, 0.25), (-0.06, 0, 0.5), colour=LIGHT, group=ROBOT, bits=NO_BITS, mass=8)
    torso = base.add_body(name=f"{name}:torso", pos=[0, 0, SHOULDER_Z], gravcomp=1.0)
    add_servo_hinge(spec, torso, f"{name}:lift", (0, 0, 1), kp=8000, limits=LIFT_RANGE, slide=True, armature=1.0)
    add_geom(torso, "box", (0.09, 0.12, 0.3), (-0.04, 0, -0.16), colour=LIGHT, group=ROBOT, bits=NO_BITS, mass=6)
    _add_head(spec, torso, name, math.radians(scene.sensor.pan_limit))
    _add_arm(spec, torso, name)


def _add_head(spec: Any, torso: Any, name: str, pan_limit: float) -> None:
    neck = torso.add_body(name=f"{name}:neck", pos=[HEAD_X, 0, HEAD_Z - 0.08], gravcomp=1.0)
    add_servo_hinge(spec, neck, f"{name}:pan", (0, 0, 1), kp=40, limits=(-pan_limit, pan_limit))
    add_limb(neck, (0, 0, -0.16), (0, 0, 0.03), 0.04, DARK, ROBOT)
    head = neck.add_body(name=f"{name}:head", pos=[0, 0, 0.08], gravcomp=1.0)
    add_servo_hinge(spec, head, f"{name}:tilt", (0, 1, 0), kp=40, limits=(-0.6, 0.9))
    add_geom(head, "box", (0.08, 0.09, 0.06), colour=LIGHT, group=ROBOT, bits=NO_BITS, mass=0.8)
    add_geom(head, "box", (0.005, 0.07, 0.025), (0.08, 0, 0), colour=DARK, group=ROBOT, bits=NO_BITS, mass=0.05)
    head.add_site(name=eye_name(name), pos=[0.09, 0, 0], group=ROBOT, size=[0.005, 0.005, 0.005])
    head.add_camera(name=eye_name(name), pos=[0.09, 0, 0], quat=[0.5, 0.5, -0.5, -0.5], fovy=60)


def _add_arm(spec: Any, torso: Any, name: str) -> None:
    shoulder = torso.add_body(name=f"{name}:shoulder", pos=[SHOULDER_X, 0, 0], gravcomp=1.0)
    add_servo_hinge(spec, shoulder, f"{name}:arm_yaw", (0, 0, 1), kp=600, limits=(-2.6, 2.6))
    add_limb(shoulder, (-0.08, 0, 0), (0, 0, 0), 0.055, DARK, ROBOT)
    upper = shoulder.add_body(name=f"{name}:upper", gravcomp=1.0)
    add_servo_hinge(spec, upper, f"{name}:arm_lift", (0, 1, 0), kp=800, limits=(-2.9, 1.9))
    add_limb(upper, (0, 0, 0), (UPPER, 0, 0), 0.045, LIGHT, ROBOT)
    fore = upper.add_body(name=f"{name}:fore", pos=[UPPER, 0, 0], gravcomp=1.0)
    add_servo_hinge(spec, fore, f"{name}:arm_elbow", (0, 1, 0), kp=600, limits=(-0.1, 2.9))
    add_limb(fore, (0, 0, 0), (FORE, 0, 0), 0.04, LIGHT, ROBOT)
    wrist = fore.add_body(name=f"{name}:wrist", pos=[FORE, 0, 0], gravcomp=1.0)
    add_servo_hinge(spec, wrist, f"{name}:arm_wrist", (0, 1, 0), kp=300, limits=(-2.6, 2.9))
    add_limb(wrist, (0, 0, 0), (0.04, 0, 0), 0.035, DARK, ROBOT)
    hand = wrist.add_body(name=f"{name}:hand", gravcomp=1.0)
    add_servo_hinge(spec, hand, f"{name}:arm_roll", (1, 0, 0), kp=150, limits=(-3.2, 3.2))
    add_geom(
        hand,
        "box",
        (0.02, 0.03, OPEN + 0.02),
        (0.07, 0, 0),
        colour=BLUE,
        group=ROBOT,
        bits=NO_BITS,
        mass=0.3,
    )
    hand.add_site(name=f"{name}:tool", pos=[TOOL, 0, 0], group=ROBOT, size=[0.005, 0.005, 0.005])
    for side, sign in (("inner", -1), ("outer", 1)):
        _add_finger(spec, hand, f"{name}:{side}_finger", sign)


def _add_finger(spec: Any, hand: Any, name: str, sign: int) -> None:
    """A finger slides along the hand's z; at 0 it is open, at OPEN it meets the other."""
    finger = hand.add_body(name=name, pos=[0.09, 0, sign * (OPEN + FINGER)], gravcomp=1.0)
    add_servo_hinge(spec, finger, name, (0, 0, -sign), kp=400, limits=(0.0, OPEN), slide=True, force=8, armature=0.1)
    size, pos = (0.04, 0.012, FINGER), (0.04, 0, 0)
    add_geom(finger, "box", size, pos, colour=DARK, group=ROBOT, bits=FINGER_BITS, mass=0.05)


# --- how it reaches -------------------------------------------------------------------------------------------------


def arm_angles(tool: Spot, lift: float, roll: float = 0.0) -> tuple[float, float, float, float, float] | None:
    """Joint angles that bring the fingertips, pointing down, to a point of the base frame; None: out of reach.

    Two links in the vertical plane of the arm, elbow up, the wrist making the hand vertical.
    """
    dx, dy, rise = tool[0] - SHOULDER_X, tool[1], tool[2] + TOOL - SHOULDER_Z - lift
    out = math.hypot(dx, dy)
    far = math.hypot(out, rise)
    if not abs(UPPER - FORE) + 0.08 < far < UPPER + FORE - 0.003:
        return None
    at_shoulder = math.acos((UPPER**2 + far**2 - FORE**2) / (2 * UPPER * far))
    at_elbow = math.acos((UPPER**2 + FORE**2 - far**2) / (2 * UPPER * FORE))
    raised = -(math.atan2(rise, out) + at_shoulder)
    bent = math.pi - at_elbow
    return math.atan2(dy, dx), raised, bent, math.pi / 2 - raised - bent, roll


def best_lift(height: float) -> float:
    """The lift at which the arm works best with the fingertips at a height."""
    return max(LIFT_RANGE[0], min(LIFT_RANGE[1], height + TOOL + ABOVE - SHOULDER_Z))


def _reach(model: Any, robot: str) -> Reach:
    """Where the arm was does not matter to it."""
    return arm_angles


PRIMITIVE = Body(
    name=BODY,
    check=bool,
    add=add_primitive,
    reach=_reach,
    arm=ARM,
    home=HOME,
    carry_clear=0.95,
    best_lift=best_lift,
    eye_height=SHOULDER_Z + best_lift(HOME[2]) + HEAD_Z,
    opening=OPEN,
)
