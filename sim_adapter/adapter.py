"""MuJoCo state → world state, exactly as things are."""

from __future__ import annotations

from collections.abc import Iterable

from casper.engine.perception.world import AgentState, ObjectState, WorldState
from casper.sim_adapter.human.human import Human
from casper.sim_adapter.physics.physics import Physics
from casper.sim_adapter.robot.robot import Robot


def truth(physics: Physics, people: Iterable[Human], robot: Robot) -> WorldState:
    """Everything as it is, without noise, and nothing hidden."""
    agents = {human.name: AgentState(human.x, human.y, human.heading, human.holding) for human in people}
    agents[robot.name] = AgentState(*robot.pose, robot.holding)
    objects = {name: ObjectState(*spot) for name, spot in physics.positions().items()}
    return WorldState(physics.time, agents, objects)
