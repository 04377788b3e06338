"""Scene → MuJoCo model: the room and its furniture, the objects, people, a robot."""

from __future__ import annotations

from typing import Any

import mujoco

from casper.sim_adapter.physics.bodies.table import body_of
from casper.sim_adapter.physics.human import add_human
from casper.sim_adapter.physics.objects import add_things
from casper.sim_adapter.physics.room import add_room
from casper.sim_adapter.room.scene import Scene


def hold_name(agent: str, thing: str) -> str:
    """Name of the weld by which an agent's hand holds an object."""
    return f"{agent}:hold:{thing}"


def hand_name(agent: str) -> str:
    """Name of the body an agent grasps with."""
    return f"{agent}:hand"


def build_spec(scene: Scene) -> Any:
    """The MjSpec of a scene (still editable: add bodies, change sizes, then ``compile()``)."""
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    spec.option.timestep = scene.sim.timestep
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.enableflags |= mujoco.mjtEnableBit.mjENBL_SLEEP  # what rests costs nothing until it is touched
    spec.visual.headlight.ambient = [0.4, 0.4, 0.4]
    spec.visual.headlight.diffuse = [0.25, 0.25, 0.25]
    spec.visual.global_.offwidth = 1280
    spec.visual.global_.offheight = 960
    spec.visual.map.znear = 0.01
    add_room(spec, scene)
    add_things(spec, scene)
    for number, person in enumerate(scene.people):
        add_human(spec, person, number)
    body_of(scene.body).add(spec, scene)
    for agent in (*scene.people, scene.robot):
        for thing in scene.movables:
            _add_hold(spec, agent, thing)
    return spec


def build_model(scene: Scene) -> Any:
    """Compile a scene to an MjModel."""
    return build_spec(scene).compile()


def _add_hold(spec: Any, agent: str, thing: str) -> None:
    hold = spec.add_equality(name=hold_name(agent, thing), type=mujoco.mjtEq.mjEQ_WELD)
    hold.objtype = mujoco.mjtObj.mjOBJ_BODY
    hold.name1, hold.name2 = hand_name(agent), thing
    hold.active = False
    hold.solref = [0.02, 1.0]
