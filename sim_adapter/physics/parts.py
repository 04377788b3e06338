"""Small helpers for building MuJoCo bodies from primitives, and the groups geoms are sorted into."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import mujoco

# Visual groups: what a ray or a picture may leave out.
FURNITURE, THINGS, HUMAN, ROBOT, WALLS, FLOOR = 1, 2, 3, 4, 5, 0

# Collision bits. Fixed things and movables carry bit 0; fingers bit 1, which only movables answer to.
FIXED_BITS = (1, 0)
MOVABLE_BITS = (1, 3)
FINGER_BITS = (2, 0)
BASE_BITS = (0, 1)
NO_BITS = (0, 0)


def rgba(red: float, green: float, blue: float, alpha: float = 1.0) -> list[float]:
    """A colour."""
    return [red, green, blue, alpha]


def add_geom(
    body: Any,
    kind: str,
    size: Sequence[float],
    pos: Sequence[float] = (0.0, 0.0, 0.0),
    *,
    colour: Sequence[float],
    group: int,
    bits: tuple[int, int],
    mass: float | None = None,
    quat: Sequence[float] | None = None,
) -> Any:
    """A box, cylinder, sphere or capsule with half sizes as MuJoCo has them; metres."""
    geom = body.add_geom(type=getattr(mujoco.mjtGeom, f"mjGEOM_{kind.upper()}"), pos=list(pos))
    geom.size = [*size, 0.0, 0.0, 0.0][:3]
    geom.rgba = list(colour)
    geom.group = group
    geom.contype, geom.conaffinity = bits
    if mass is not None:
        geom.mass = mass
    if quat is not None:
        geom.quat = list(quat)
    return geom


def add_limb(
    body: Any, start: Sequence[float], end: Sequence[float], radius: float, colour: Sequence[float], group: int
) -> Any:
    """A capsule from start to end that touches nothing."""
    geom = body.add_geom(type=mujoco.mjtGeom.mjGEOM_CAPSULE)
    geom.fromto = [*start, *end]
    geom.size = [radius, 0.0, 0.0]
    geom.rgba = list(colour)
    geom.group = group
    geom.contype, geom.conaffinity = NO_BITS
    geom.mass = 0.2
    return geom


def add_servo_hinge(
    spec: Any,
    body: Any,
    name: str,
    axis: Sequence[float],
    *,
    kp: float,
    limits: tuple[float, float] | None = None,
    slide: bool = False,
    force: float | None = None,
    armature: float = 0.05,
) -> None:
    """A joint (hinge, or slide) with a critically damped position servo of the same name."""
    kind = mujoco.mjtJoint.mjJNT_SLIDE if slide else mujoco.mjtJoint.mjJNT_HINGE
    joint = body.add_joint(name=name, type=kind, axis=list(axis))
    joint.armature = armature
    if limits is not None:
        joint.limited = True
        joint.range = list(limits)
    add_servo(spec, name, kp, force=force)


def add_servo(spec: Any, joint: str, kp: float, *, force: float | None = None) -> None:
    """A critically damped position servo of a joint, named like it; ``force`` is the most it has (N or N m)."""
    servo = spec.add_actuator(name=joint, target=joint, trntype=mujoco.mjtTrn.mjTRN_JOINT)
    servo.set_to_position(kp=kp, dampratio=1.0)
    if force is not None:
        servo.forcelimited = True
        servo.forcerange = [-force, force]


def add_base(spec: Any, robot: str) -> Any:
    """A robot's base: a body of the robot's name that slides over the floor and turns."""
    base = spec.worldbody.add_body(name=robot)
    add_servo_hinge(spec, base, f"{robot}:x", (1, 0, 0), kp=6000, slide=True, force=800, armature=1.0)
    add_servo_hinge(spec, base, f"{robot}:y", (0, 1, 0), kp=6000, slide=True, force=800, armature=1.0)
    add_servo_hinge(spec, base, f"{robot}:yaw", (0, 0, 1), kp=1500, force=300, armature=1.0)
    return base
