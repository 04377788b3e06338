"""What the simulator's tests share: the kitchen's scene, its scripts, and running them."""

from functools import cache
from pathlib import Path

import casper
from casper.kb.base import KnowledgeBase
from casper.sim_adapter.room.facts import scene_from
from casper.sim_adapter.steps import Step

SCENE_FILE = Path(casper.__file__).parent / "domains" / "kitchen" / "scene.pl"


@cache
def kitchen_scene():
    return scene_from(KnowledgeBase.from_text(SCENE_FILE.read_text()).rows)


def put(target, destination):
    return Step("pick_and_place", target, destination)


def use(target, destination):
    return Step("use", target, destination)


SCRIPTS = {
    "breakfast": [put("biscuits", "plate"), use("biscuits", "plate"), put("plate", "sink"), use("plate", "sink")],
    "drink": [put("bottle", "glass"), use("bottle", "glass"), put("glass", "sink"), use("glass", "sink")],
    "lunch": [
        put("meal", "hobs"),
        use("meal", "hobs"),
        put("meal", "plate"),
        use("meal", "plate"),
        put("plate", "sink"),
        use("plate", "sink"),
    ],
}


def run_until_idle(simulation, *, longest=200.0, each=None):
    """Run on until human and robot have nothing to do; ``each`` is called every half second."""
    while not (simulation.human.idle and simulation.robot.idle):
        assert simulation.time < longest, f"not done: {simulation.human.current}, {simulation.robot.current}"
        simulation.advance(0.5)
        if each is not None:
            each(simulation)
    return simulation
