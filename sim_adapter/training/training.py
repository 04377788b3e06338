"""Scripts of random trials, from which the movement classifier learns (the paper's section on its training data)."""

from __future__ import annotations

import numpy as np

from casper.sim_adapter.room.scene import Scene
from casper.sim_adapter.steps import Step


def training_script(
    scene: Scene, rng: np.random.Generator, *, step_back: bool = False, uses: bool = False
) -> list[Step]:
    """One trial: still a while, fetch a random object, bring it to a random place, still again.

    With ``step_back`` the human steps back from the place before it stands still the second time; with ``uses`` what
    was brought is used there before that.
    """
    target = str(rng.choice(scene.movables))
    places = [name for name in scene.destinations if name != target]
    destination = str(rng.choice(places))
    script = [
        Step("still", seconds=float(rng.uniform(2.0, 4.0))),
        Step("pick_and_place", target, destination),
        Step("still", seconds=2.0),
    ]
    if step_back:
        script.insert(2, Step("step_back"))
    if uses:
        script.insert(2, Step("use", target, destination))
    return script
