"""TIAGo++ as PAL Robotics builds it; its model comes with a package of which one file, and its meshes, are read.

Taken of it are shapes, joints and masses. What touches there is left away, the left arm is folded, and added is what it
lacks: a base that drives, the wrist's last joint, the gripper, the eye, and servos.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from casper.sim_adapter.physics.bodies.body import Body, Reach
from casper.sim_adapter.physics.bodies.package import model_file
from casper.sim_adapter.physics.bodies.reaching import Reaching
from casper.sim_adapter.physics.parts import (
    BASE_BITS,
    FINGER_BITS,
    NO_BITS,
    ROBOT,
    add_base,
    add_geom,
    add_servo,
    rgba,
)
from casper.sim_adapter.room.placement import Spot
from casper.sim_adapter.room.scene import Scene

HOME: Spot = (0.45, 0.0, 1.0)
REST = (1.15, -1.12, 1.45, 2.04, 0.24, -1.25, -1.37)  # the arm's joints there
TILT = 0.8  # of the fingers from straight down: the shoulder is too low for a hand above what stands on a worktop
LIFT_RANGE = (0.0, 0.35)
BELOW = 0.65  # metres from the fingertips' height down to the lift at which the arm works best
EYE, EYE_Z = (0.07, 0.0, 0.0), 0.987  # in the head, and how high that is with the lift down

ARM = tuple(f"arm_{number}" for number in range(1, 8))
GAINS = {"lift": 8000, "pan": 40, "tilt": 40} | dict(zip(ARM, (1500, 1500, 1000, 1000, 500, 500, 300)))
ROLL_RANGE = (-2.07, 2.07)  # of the last joint, as the manufacturer has it
FOLDED = (-1.1, 1.5, 2.7, 1.8, -1.6, 0.0)  # the left arm's joints
BALL = 0.004  # inertia (kg m²) of a kilogram: that of a ball of 10 cm

OPEN = 0.045  # half the opening between the fingers
FLANGE, TOOL = 0.036, 0.245  # from the wrist's end to the gripper's frame, and to where the fingertips take hold
PAD = (0.04, 0.02, 0.004)  # half sizes of a fingertip
SIDES = {"inner": -1, "outer": 1}
UPRIGHT = (math.sqrt(0.5), 0.0, -math.sqrt(0.5), 0.0)  # a hand points along x, the gripper's mesh against z
STRAIGHT, ROUND = (1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0)
UNSEEN = rgba(0.0, 0.0, 0.0, 0.0)


def add_tiago(spec: Any, scene: Scene) -> None:
    """The whole body.

    Raises:
        CasperError: the package is not there.
    """
    name, part = scene.robot, mujoco.MjSpec.from_file(str(model_file()))
    _strip(part)
    _rename(part)
    _fold_left_arm(part)
    _add_gripper(part)
    _add_eye(part)
    for body in part.bodies[1:]:
        body.gravcomp = 1.0
    base = add_base(spec, name)
    size = (scene.robot_settings.radius - 0.03, 0.13)
    add_geom(base, "cylinder", size, (0, 0, 0.16), colour=UNSEEN, group=ROBOT, bits=BASE_BITS, mass=5)
    base.add_frame().attach_body(part.body("base"), f"{name}:", "")
    for joint, gain in GAINS.items():
        add_servo(spec, f"{name}:{joint}", gain)
    for side in SIDES:
        add_servo(spec, f"{name}:{side}_finger", 400, force=8)


def _strip(part: Any) -> None:
    """Leave away what touches, motors and marks; links weigh what the file says, but turn as easily as balls do.

    The file gives every link the same inertia, however light it is: the arm would swing like a beam.
    """
    touching = [geom for geom in part.geoms if geom.contype or geom.conaffinity]
    for other in (*touching, *part.actuators, *part.sites, *part.cameras):
        part.delete(other)
    shown = {geom.meshname for geom in part.geoms} | {"gripper_link", "gripper_finger_link"}
    for mesh in [mesh for mesh in part.meshes if mesh.name not in shown]:
        part.delete(mesh)
    for geom in part.geoms:
        geom.group = ROBOT
    for body in part.bodies[1:]:
        body.inertia = [max(1e-6, BALL * body.mass)] * 3


def _rename(part: Any) -> None:
    """Joints are called as in every body; servos damp them, and the head nods down first."""
    names = {"torso_lift_joint": "lift", "head_1_joint": "pan", "head_2_joint": "tilt"}
    names |= {f"arm_right_{number}_joint": ARM[number - 1] for number in range(1, 7)}
    for old, new in names.items():
        joint = part.joint(old)
        joint.name, joint.damping, joint.armature = new, 0.0 * joint.damping, 0.05
    tilt = part.joint("tilt")
    tilt.axis, tilt.range = -tilt.axis, -tilt.range[::-1]


def _fold_left_arm(part: Any) -> None:
    """One arm does the work; the other is folded for good."""
    for number, angle in enumerate(FOLDED, 1):
        joint = part.joint(f"arm_left_{number}_joint")
        body, about = joint.parent, np.array([math.cos(angle / 2), *(math.sin(angle / 2) * joint.axis)])
        turned = _after(_turned(part, body), about)
        body.alt.type, body.quat = mujoco.mjtOrientation.mjORIENTATION_QUAT, turned
        part.delete(joint)


def _turned(part: Any, body: Any) -> Sequence[float]:
    """How a body is turned, a quaternion, however the file says it."""
    if body.alt.type == mujoco.mjtOrientation.mjORIENTATION_QUAT:
        return list(body.quat)
    found = part.resolve_orientation(degree=False, sequence=part.compiler.eulerseq, orientation=body.alt)
    return [float(number) for number in found]


def _after(first: Sequence[float], then: Sequence[float] | NDArray[np.float64]) -> NDArray[np.float64]:
    """One turn after another, as quaternions."""
    both = np.empty(4)
    mujoco.mju_mulQuat(both, np.array(first, dtype=float), np.array(then, dtype=float))
    return both


def _add_gripper(part: Any) -> None:
    """The last joint, and the parallel gripper of which the package has the shapes alone; the left one is for show."""
    hand = part.body("right_hand").add_body(name="hand", quat=UPRIGHT)
    roll = hand.add_joint(name=ARM[-1], axis=[1, 0, 0], armature=0.05)
    roll.limited, roll.range = True, ROLL_RANGE
    hand.add_site(name="tool", pos=[TOOL, 0, 0], group=ROBOT, size=[0.005] * 3)
    left = part.body("left_hand").add_body(name="left_gripper", quat=UPRIGHT)
    for side, sign in SIDES.items():
        finger = hand.add_body(name=f"{side}_finger", pos=[0, 0, sign * (OPEN + PAD[2])])
        slide = finger.add_joint(name=f"{side}_finger", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[0, 0, -sign])
        slide.armature, slide.limited, slide.range = 0.1, True, (0.0, OPEN)
        tip = (TOOL + 0.01 - PAD[0], 0, 0)
        add_geom(finger, "box", PAD, tip, colour=UNSEEN, group=ROBOT, bits=FINGER_BITS, mass=0.05)
        _add_finger(finger, sign, sign * PAD[2])
        _add_finger(left, sign, sign * 2 * PAD[2])
    for wrist in (hand, left):
        _add_mesh(wrist, "gripper_link", (FLANGE, 0, 0), STRAIGHT, "Grey", 0.6)


def _add_finger(body: Any, sign: int, off: float) -> None:
    """The mesh of a finger has its pad beside the middle: moved by its thickness it meets the other's."""
    _add_mesh(body, "gripper_finger_link", (FLANGE, 0, off), STRAIGHT if sign < 0 else ROUND, "DarkGrey", 0.02)


def _add_mesh(
    body: Any, mesh: str, pos: Sequence[float], turned: Sequence[float], material: str, mass: float
) -> None:
    geom = body.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname=mesh, material=material, pos=list(pos))
    geom.quat, geom.group, geom.mass = _after(turned, UPRIGHT), ROBOT, mass
    geom.contype, geom.conaffinity = NO_BITS


def _add_eye(part: Any) -> None:
    """The camera in the head, whose frame has x ahead and y up."""
    head = part.body("head_2_link")
    head.add_site(name="eye", pos=EYE, group=ROBOT, size=[0.005] * 3)
    head.add_camera(name="eye", pos=EYE, quat=UPRIGHT, fovy=60)


def best_lift(height: float) -> float:
    """The lift at which the arm works best with the fingertips at a height."""
    return max(LIFT_RANGE[0], min(LIFT_RANGE[1], height - BELOW))


def _reach(model: Any, robot: str) -> Reach:
    return Reaching(model, robot, ARM, REST, TILT)


TIAGO = Body(
    name="tiago",
    check=model_file,
    add=add_tiago,
    reach=_reach,
    arm=ARM,
    home=HOME,
    carry_clear=0.9,
    best_lift=best_lift,
    eye_height=EYE_Z + best_lift(HOME[2]),
    opening=OPEN,
    roll=math.pi / 2,
    lift_follows=True,
)
