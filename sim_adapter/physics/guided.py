"""Bodies that go where they are told (mocap bodies: people, and their hands), and the physics meanwhile."""

from __future__ import annotations

import math
from typing import Any

import mujoco

from casper.sim_adapter.room.placement import Spot


class Guided:
    """Every mocap body of a model has a goal, where it is at the end of the next control step.

    Args:
        model, data: MuJoCo's; ``data`` is stepped.
        substeps: how many steps of the physics make a control step.
    """

    def __init__(self, model: Any, data: Any, substeps: int) -> None:
        self.model, self.data, self.substeps = model, data, substeps
        self._index = {model.body(i).name: int(n) for i, n in enumerate(model.body_mocapid) if n >= 0}
        self._pos, self._quat = data.mocap_pos, data.mocap_quat  # views
        self._goals = self._pos.copy(), self._quat.copy()
        self._half = [0.0] * len(self._index)  # half the angle about z, so that a quaternion keeps its sign

    def __contains__(self, name: str) -> bool:
        return name in self._index

    def aim(self, name: str, position: Spot, yaw: float, *, at_once: bool = False) -> None:
        """Where a body shall be: metres, and radians about z."""
        index = self._index[name]
        half = yaw / 2
        if math.cos(half - self._half[index]) < 0:  # the same turn, by the quaternion nearer to the last one
            half += math.pi
        self._half[index] = half
        quat = (math.cos(half), 0.0, 0.0, math.sin(half))
        self._goals[0][index], self._goals[1][index] = position, quat
        if at_once:
            self._pos[index], self._quat[index] = position, quat

    def step(self, *, gliding: bool) -> None:
        """One control step.

        Args:
            gliding: whether the bodies glide to their goals, so that what is welded to them is not jerked; otherwise
                they are there at once, which nothing notices: they touch nothing.
        """
        if not gliding:
            self._pos[:], self._quat[:] = self._goals
            mujoco.mj_step(self.model, self.data, self.substeps)
            return
        ways = (self._goals[0] - self._pos) / self.substeps, (self._goals[1] - self._quat) / self.substeps
        for _ in range(self.substeps):
            self._pos += ways[0]
            self._quat += ways[1]
            mujoco.mj_step(self.model, self.data)
