"""The human's body: a mocap root with hinged limbs for the gait, and a hand that is a mocap body of its own."""

from __future__ import annotations

from typing import Any

from casper.sim_adapter.physics.parts import HUMAN, NO_BITS, add_geom, add_limb, add_servo_hinge, rgba

HIP, SHOULDER_UP, SHOULDER_SIDE, UPPER_ARM, FOREARM = 0.92, 0.50, 0.21, 0.31, 0.30
THIGH, SHIN = 0.44, 0.42
SKIN, TROUSERS = rgba(0.9, 0.72, 0.6), rgba(0.25, 0.28, 0.4)
SHIRTS = rgba(0.2, 0.5, 0.45), rgba(0.75, 0.4, 0.2), rgba(0.45, 0.35, 0.6), rgba(0.6, 0.6, 0.25)  # one after the other


def add_human(spec: Any, name: str, number: int = 0) -> None:
    """Root (named like the agent, its origin on the floor), limbs, and ``<agent>:hand``; nothing collides.

    ``number`` is that of the person among all, from 0: each wears another shirt.
    """
    shirt = SHIRTS[number % len(SHIRTS)]
    root = spec.worldbody.add_body(name=name, mocap=True)
    add_limb(root, (0, -0.09, HIP), (0, 0.09, HIP), 0.09, TROUSERS, HUMAN)
    trunk = _link(spec, root, f"{name}:waist", (0, 0, HIP), (0, 1, 0))
    add_limb(trunk, (0, -0.07, 0.12), (0, -0.11, SHOULDER_UP - 0.06), 0.10, shirt, HUMAN)
    add_limb(trunk, (0, 0.07, 0.12), (0, 0.11, SHOULDER_UP - 0.06), 0.10, shirt, HUMAN)
    add_geom(trunk, "sphere", (0.11,), (0.01, 0, 0.75), colour=SKIN, group=HUMAN, bits=NO_BITS, mass=0.2)
    add_geom(trunk, "sphere", (0.02,), (0.12, 0, 0.75), colour=SKIN, group=HUMAN, bits=NO_BITS, mass=0.01)
    for side, sign in (("left", 1), ("right", -1)):
        _add_leg(spec, root, f"{name}:{side}", sign)
    _add_left_arm(spec, trunk, name, shirt)
    _add_right_arm(spec, trunk, name, shirt)
    hand = spec.worldbody.add_body(name=f"{name}:hand", mocap=True)
    add_geom(hand, "box", (0.05, 0.035, 0.015), colour=SKIN, group=HUMAN, bits=NO_BITS)


def _link(spec: Any, parent: Any, name: str, pos: tuple[float, float, float], axis: tuple[int, int, int]) -> Any:
    body = parent.add_body(name=name, pos=list(pos))
    body.gravcomp = 1.0
    add_servo_hinge(spec, body, name, axis, kp=60.0, armature=0.1)
    return body


def _add_leg(spec: Any, root: Any, name: str, sign: int) -> None:
    thigh = _link(spec, root, f"{name}_hip", (0, 0.1 * sign, HIP), (0, 1, 0))
    add_limb(thigh, (0, 0, 0), (0, 0, -THIGH), 0.075, TROUSERS, HUMAN)
    shin = _link(spec, thigh, f"{name}_knee", (0, 0, -THIGH), (0, 1, 0))
    add_limb(shin, (0, 0, 0), (0, 0, -SHIN), 0.055, TROUSERS, HUMAN)
    add_limb(shin, (-0.03, 0, -SHIN - 0.02), (0.12, 0, -SHIN - 0.02), 0.04, rgba(0.15, 0.12, 0.1), HUMAN)


def _add_left_arm(spec: Any, trunk: Any, name: str, shirt: list[float]) -> None:
    arm = _link(spec, trunk, f"{name}:left_shoulder", (0, SHOULDER_SIDE, SHOULDER_UP), (0, 1, 0))
    add_limb(arm, (0, 0, 0), (0, 0.02, -UPPER_ARM), 0.045, shirt, HUMAN)
    add_limb(arm, (0, 0.02, -UPPER_ARM), (0.04, 0.02, -UPPER_ARM - FOREARM), 0.035, SKIN, HUMAN)


def _add_right_arm(spec: Any, trunk: Any, name: str, shirt: list[float]) -> None:
    """Shoulder out, shoulder swing, elbow: the three angles that bring the wrist to the hand."""
    out = _link(spec, trunk, f"{name}:right_out", (0, -SHOULDER_SIDE, SHOULDER_UP), (1, 0, 0))
    out.mass = 0.05
    out.inertia = [1e-3, 1e-3, 1e-3]
    out.explicitinertial = True
    upper = _link(spec, out, f"{name}:right_swing", (0, 0, 0), (0, 1, 0))
    add_limb(upper, (0, 0, 0), (0, 0, -UPPER_ARM), 0.045, shirt, HUMAN)
    fore = _link(spec, upper, f"{name}:right_elbow", (0, 0, -UPPER_ARM), (0, 1, 0))
    add_limb(fore, (0, 0, 0), (0, 0, -FOREARM), 0.035, SKIN, HUMAN)
