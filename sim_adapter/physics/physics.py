"""The MuJoCo state behind names: poses, servos, welds that hold, and stepping with smoothly moved mocap bodies."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from casper.kb.errors import DomainError
from casper.sim_adapter.physics.bodies.table import body_of
from casper.sim_adapter.physics.guided import Guided
from casper.sim_adapter.physics.model import build_model, hand_name, hold_name
from casper.sim_adapter.physics.stability import check_stable, keep_warnings_to_itself
from casper.sim_adapter.room.placement import Spot, is_placed
from casper.sim_adapter.room.scene import Scene

Vector = NDArray[np.float64]
STILL_SPEED = 0.03  # m/s: below it an object counts as resting
STIR = 1e-12  # m/s: any speed wakes what sleeps; a weld that is undone does not, and it would hang in the air
AWAY = (20.0, 20.0)  # where removed objects are parked


class Physics:
    """A compiled scene and its state. Positions are metres, angles radians, times seconds."""

    def __init__(self, scene: Scene) -> None:
        keep_warnings_to_itself()
        self.scene = scene
        self.body = body_of(scene.body)
        self.model: Any = build_model(scene)
        self.data: Any = mujoco.MjData(self.model)
        self.substeps = max(1, round(scene.sim.control / scene.sim.timestep))
        self.removed: dict[str, int] = {}  # name -> the parking place
        self._held: dict[str, str] = {}
        self._body = {self.model.body(i).name: i for i in range(self.model.nbody)}
        self._servo = {self.model.actuator(i).name: i for i in range(self.model.nu)}
        self._hold = {self.model.equality(i).name: i for i in range(self.model.neq)}
        self._qpos = {self.model.joint(i).name: int(self.model.jnt_qposadr[i]) for i in range(self.model.njnt)}
        self._dof = {self.model.joint(i).name: int(self.model.jnt_dofadr[i]) for i in range(self.model.njnt)}
        self._site = {self.model.site(i).name: i for i in range(self.model.nsite)}
        # Views, made once: each look at data.qpos makes a new array.
        self._q, self._v, self._ctrl, self._xpos = self.data.qpos, self.data.qvel, self.data.ctrl, self.data.xpos
        self.guided = Guided(self.model, self.data, self.substeps)
        mujoco.mj_forward(self.model, self.data)

    @property
    def time(self) -> float:
        """Seconds since the start."""
        return round(float(self.data.time), 6)  # the sum of many steps is off by some 1e-12

    @property
    def warnings(self) -> int:
        """Number of warnings MuJoCo has given so far."""
        return sum(int(warning.number) for warning in self.data.warning)

    def body_id(self, name: str) -> int:
        """MuJoCo's number of a body."""
        return self._body[name]

    def position(self, name: str) -> Spot:
        """Where the origin of a body is; of a movable, its middle."""
        if name in self._qpos:
            at = self._qpos[name]
            x, y, z = self._q[at : at + 3].tolist()
        else:
            x, y, z = self._xpos[self._body[name]].tolist()
        return x, y, z

    def positions(self) -> dict[str, Spot]:
        """Where every object of interest is that is still in the world."""
        return {name: self.position(name) for name in self.scene.things if name not in self.removed}

    def site(self, name: str) -> Vector:
        """Where a site is."""
        return np.array(self.data.site_xpos[self._site[name]])

    def looking(self, name: str) -> float:
        """The heading of a site's x axis, radians."""
        turned = self.data.site_xmat[self._site[name]]
        return math.atan2(turned[3], turned[0])

    def joint(self, name: str) -> float:
        """Angle (or way) of a joint."""
        return float(self._q[self._qpos[name]])

    def joint_speed(self, name: str) -> float:
        """Speed of a joint."""
        return float(self._v[self._dof[name]])

    def set_joint(self, name: str, value: float) -> None:
        """Put a joint and its servo somewhere at once (only for the start)."""
        self._q[self._qpos[name]] = value
        self._ctrl[self._servo[name]] = value

    def servo(self, name: str, value: float) -> None:
        """Set what a servo aims at."""
        self._ctrl[self._servo[name]] = value

    def speed(self, name: str) -> float:
        """Speed of a movable, m/s."""
        at = self._dof[name]
        return float(np.linalg.norm(self._v[at : at + 3]))

    def aim_mocap(self, name: str, position: Spot, yaw: float, *, at_once: bool = False) -> None:
        """Where a mocap body shall be at the end of the next control step."""
        self.guided.aim(name, position, yaw, at_once=at_once)

    def step(self) -> None:
        """One control step.

        Raises:
            PhysicsFailed: the numbers ran away.
        """
        before = self.time
        self.guided.step(gliding=any(hand_name(agent) in self.guided for agent in self._held))
        check_stable(self.model, self.data, before)

    def refresh(self) -> None:
        """Bring everything that is derived from the joints up to date without moving the clock."""
        mujoco.mj_forward(self.model, self.data)

    def held_by(self, agent: str) -> str | None:
        """What an agent holds."""
        return self._held.get(agent)

    def holder(self, thing: str) -> str | None:
        """Who holds an object."""
        return next((agent for agent, held in self._held.items() if held == thing), None)

    def grasp(self, agent: str, thing: str) -> bool:
        """Weld an object to an agent's hand exactly as the two lie now, so that nothing jumps.

        Whether it is held now: not while another hand holds it, since two welds pull against each other until the
        numbers run away.

        What stands in a dish is held steady with it, but for what another hand holds: people balance a carried plate,
        this simulation does not.
        """
        if self.holder(thing) not in (None, agent):
            return False
        steadied = [name for name in self.contents(thing) if self.holder(name) is None]
        for name in (thing, *steadied):
            self._let_go_of(name)
            self._weld(hand_name(agent), name, self._hold[hold_name(agent, name)])
        self._held[agent] = thing
        return True

    def _let_go_of(self, thing: str) -> None:
        """End every weld of an object: who takes the food from a carried plate has it alone."""
        for agent in (*self.scene.people, self.scene.robot):
            self.data.eq_active[self._hold[hold_name(agent, thing)]] = 0

    def release(self, agent: str) -> None:
        """Let go of what the agent holds, if anything."""
        if self._held.pop(agent, None) is not None:
            holds = {thing: self._hold[hold_name(agent, thing)] for thing in self.scene.movables}
            for thing in (thing for thing, hold in holds.items() if self.data.eq_active[hold]):
                self.data.eq_active[holds[thing]] = 0
                self._v[self._dof[thing]] += STIR

    def contents(self, dish: str) -> list[str]:
        """What stands in a dish."""
        if self.scene.thing(dish).shape != "dish":
            return []
        where = self.positions()
        return [name for name in self.scene.movables if is_placed(self.scene, where, name, dish, inside=True)]

    def _weld(self, hand: str, thing: str, index: int) -> None:
        place, turn = np.empty(3), np.empty(4)
        inverse_place, inverse_turn = np.empty(3), np.empty(4)
        data, one, other = self.data, self._body[hand], self._body[thing]
        mujoco.mju_negPose(inverse_place, inverse_turn, data.xpos[one], data.xquat[one])
        mujoco.mju_mulPose(place, turn, inverse_place, inverse_turn, data.xpos[other], data.xquat[other])
        self.model.eq_data[index, 0:3] = 0.0
        self.model.eq_data[index, 3:6] = place
        self.model.eq_data[index, 6:10] = turn
        data.eq_active[index] = 1

    def remove(self, thing: str) -> None:
        """Take a movable object out of the world, until it is put back.

        Raises:
            DomainError: no such object, or it is fixed.
        """
        if not self.scene.thing(thing).movable:
            raise DomainError(f"{thing} is fixed; only what has a mass can be removed")
        holder = self.holder(thing)
        if holder is not None:
            self.release(holder)
        taken = set(self.removed.values())
        self.removed[thing] = next(number for number in range(1, len(taken) + 2) if number not in taken)
        x = AWAY[0] + self.removed[thing]
        self._move(thing, (x, AWAY[1], self.scene.thing(thing).height / 2, 1.0, 0.0, 0.0, 0.0))

    def put_back(self, thing: str) -> None:
        """Put a movable object that nobody holds where it was at the start; one that was removed is there anew."""
        self.removed.pop(thing, None)
        at = self._qpos[thing]
        self._move(thing, self.model.qpos0[at : at + 7])

    def _move(self, thing: str, pose: Sequence[float]) -> None:
        """An object rests somewhere else at once: x, y, z, and a quaternion.

        Nothing holds it there any more: the weld that steadies it on a carried plate would pull over any distance.
        """
        self._let_go_of(thing)
        at, dof = self._qpos[thing], self._dof[thing]
        self._q[at : at + 7] = pose
        self._v[dof : dof + 6] = 0.0
        mujoco.mj_forward(self.model, self.data)
