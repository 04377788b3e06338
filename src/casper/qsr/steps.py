"""Steps of a stream on arrays: two columns, the step before and now."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from operator import itemgetter

import numpy as np

from casper.qsr.arrays.scene import Array, Frames, Scene, pairs_array
from casper.qsr.calculi.calculus import Body, Calculus, Names

Holds = dict[str, dict[Names, str]]
_X, _Y = itemgetter(0), itemgetter(1)


class ArraySteps:
    """What `casper.qsr.stream` tells of a step, by the kernels of the batch; what stays the same is kept as arrays."""

    def __init__(self, chosen: Sequence[Calculus]) -> None:
        self._calculi = chosen
        self._names: tuple[str, ...] | None = None
        self._tuples: Mapping[int, tuple[Names, ...]] = {}
        self._members: dict[int, tuple[Array, ...]] = {}
        self._last: tuple[Mapping[str, Body], list[Array]] | None = None

    def step(
        self,
        tuples: Mapping[int, tuple[Names, ...]],
        now: Mapping[str, Body],
        was: Mapping[str, Body],
        dt: float,
        held: Holds,
    ) -> Holds:
        """The labels of all tuples; ``was`` are the things a step before, ``held`` the labels then."""
        names = tuple(now)
        if names != self._names or tuples is not self._tuples:
            self._names, self._tuples = names, tuples
            place = {name: i for i, name in enumerate(names)}
            made = {arity: [[place[name] for name in row] for row in rows] for arity, rows in tuples.items() if rows}
            self._members = {arity: pairs_array(rows) for arity, rows in made.items()}
        frames = self._frames(names, now, was, dt)
        scenes = {arity: Scene(frames, members) for arity, members in self._members.items()}
        told: Holds = {}
        for calculus in self._calculi:
            rows = tuples[calculus.arity]
            told[calculus.name] = _told(calculus, scenes[calculus.arity], rows, held) if rows else {}
        return told

    def _frames(self, names: Sequence[str], now: Mapping[str, Body], was: Mapping[str, Body], dt: float) -> Frames:
        nothing = Body(math.nan, math.nan)
        earlier = [was.get(name, nothing) for name in names]
        axes = _axes(now.values())
        if (
            self._last is not None
            and self._last[0] is was
            and len(self._last[1]) == len(axes)
            and list(was) == list(names)
        ):
            before = self._last[1]
        else:
            before = _axes(earlier, len(axes))
        self._last = (now, axes)
        missing = [body is nothing for body in earlier]
        there = None
        if any(missing):
            there = np.ones((len(names), 2), dtype=bool)
            there[:, 0] = np.logical_not(missing)
        needs = {need for calculus in self._calculi for need in calculus.needs}
        sizes = _sizes(now.values()) if "size" in needs else None
        return Frames(
            where=tuple(np.stack(pair, axis=1) for pair in zip(before, axes, strict=True)),
            dt=np.array([dt]),
            present=there,
            heading=_twice([body.heading for body in now.values()]) if "heading" in needs else None,
            sizes=None if sizes is None else tuple(map(_twice, sizes)),
            held=_twice([-1.0 if body.holding is None else 0.0 for body in now.values()]),
        )


def _told(calculus: Calculus, scene: Scene, rows: Sequence[Names], held: Holds) -> dict[Names, str]:
    labels = calculus.labels
    before = np.full(len(rows), -1, dtype=np.int16)
    earlier = held.get(calculus.name)
    if calculus.remembers and earlier:
        code = {label: number for number, label in enumerate(labels)}
        before[:] = [code[earlier[row]] if row in earlier else -1 for row in rows]
    with np.errstate(invalid="ignore"):
        codes = scene.told(calculus.codes(scene, before), calculus.motion)[:, 0]
    if (codes >= 0).all():
        return dict(zip(rows, map(labels.__getitem__, codes.tolist()), strict=True))
    return {row: labels[code] for row, code in zip(rows, codes.tolist(), strict=True) if code >= 0}


def _axes(bodies: Iterable[Body], least: int = 2) -> list[Array]:
    """x, y and, where somebody has one, z of things, NaN where there is none."""
    given = list(bodies)
    axes = [np.fromiter(map(part, given), np.float64, len(given)) for part in (_X, _Y)]
    heights = [body[2] for body in given]
    if least == 3 or any(z is not None for z in heights):
        axes.append(np.array(heights, dtype=np.float64))
    return axes


def _sizes(bodies: Iterable[Body]) -> list[list[float | None]] | None:
    given = [body.size or () for body in bodies]
    most = max(map(len, given), default=0)
    return [[size[axis] if axis < len(size) else None for size in given] for axis in range(most)] or None


def _twice(column: Sequence[float | None]) -> Array:
    once = np.array(column, dtype=np.float64)
    return np.stack([once, once], axis=1)
