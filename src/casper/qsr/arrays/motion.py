"""MOS and QTC on arrays (`casper.qsr.plain.motion`)."""

from __future__ import annotations

import numpy as np

from casper.qsr.arrays.hysteresis import kept
from casper.qsr.arrays.scene import Array, Scene, flat

Limit = Array | float
"""Metres a step: one for all, or one a step."""


def displacement(scene: Scene, heights: bool) -> Array:
    """Metres that the first members went in each step."""
    axes = len(scene.frames.where) if heights else 2
    total: Array | float = 0.0
    for axis in range(axes):
        shift = scene.shift(0, axis)
        total = total + shift * shift
    return np.asarray(np.sqrt(total))


def moving(metres: Array, threshold: Limit, margin: Limit, before: Array, defined: Array | None) -> Array:
    """0 stationary, 1 moving."""
    plain = (metres > threshold).astype(np.int8)
    if not np.any(np.asarray(margin) > 0.0):
        return plain
    if defined is not None:
        plain[~defined] = -1
    first = _firsts(plain, before)
    moves, keeps = metres > threshold + margin, metres > threshold + -margin
    later = np.where(plain < 0, plain, moves)
    return kept(np.where(first, plain, later).astype(np.int8), np.stack([~moves & ~first, keeps & ~first]), before)


def _firsts(plain: Array, before: Array) -> Array:
    """Where there is no step before to remember."""
    return np.concatenate([before[:, None] < 0, plain[:, :-1] < 0], axis=1)


def approach(scene: Scene, member: int, variant: str, heights: bool) -> Array:
    """Metres by which one of two members came nearer to where the other was, in each step."""
    axes = len(scene.frames.where) if heights else 2
    length = scene.distance_in_space if axes == 3 else scene.distance
    if variant == "projection":
        return _projected(scene, member, length[:, :-1], axes)
    other = 1 - member
    total: Array | float = 0.0
    for axis in range(axes):
        apart = flat(scene.axis(other, axis)[:, :-1] - scene.axis(member, axis)[:, 1:], axis)
        total = total + apart * apart
    was = length[:, :-1]
    return np.where(was != 0.0, was - np.sqrt(total), 0.0)


def _projected(scene: Scene, member: int, was: Array, axes: int) -> Array:
    along = scene.shift(member, 0) * _towards(scene, member, 0)
    for axis in range(1, axes):
        along = along + scene.shift(member, axis) * _towards(scene, member, axis)
    return _divided(along, was)


def _towards(scene: Scene, member: int, axis: int) -> Array:
    offset = scene.offsets[axis][:, :-1]
    return offset if member == 0 else -offset


def _divided(metres: Array, length: Array) -> Array:
    """Lengths along a unit vector; 0 where the vector has no length."""
    with np.errstate(divide="ignore", invalid="ignore"):
        quotient = metres / length
    if not length.all():
        quotient[length == 0.0] = 0.0
    return quotient


def sideways(scene: Scene, member: int) -> Array:
    """Metres that one of two members went to the left of the line to where the other was, in each step."""
    across = scene.shift(member, 1) * _towards(scene, member, 0) - scene.shift(member, 0) * _towards(scene, member, 1)
    return _divided(across, scene.distance[:, :-1])


def symbols(metres: Array, threshold: Limit, margin: Limit, before: Array, defined: Array | None) -> Array:
    """0 for ``-`` (towards, left), 1 for ``0``, 2 for ``+`` (away, right)."""
    limit = threshold + margin
    plain = np.ones(metres.shape, dtype=np.int8)
    plain -= metres > limit
    plain += metres < -limit
    if not np.any(np.asarray(margin) > 0.0):
        return plain
    if defined is not None:
        plain[~defined] = -1
    low = threshold + -margin
    may_keep = np.stack([(metres > 0.0) & (metres > low), plain == 1, (metres <= 0.0) & (np.abs(metres) > low)])
    return kept(plain, may_keep, before)
