"""Draws the README's picture: a breakfast at three moments.

    MUJOCO_GL=egl python docs/pictures.py
"""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from casper import Domain
from casper.sim_adapter.eye.camera import Camera
from casper.sim_adapter.trial import Trial, TrialSettings

HERE = Path(__file__).parent


def frames() -> list[tuple[str, np.ndarray]]:
    """Three moments: the prediction, the partner eating, the robot carrying the plate."""
    trial = Trial(Domain.load("kitchen"), TrialSettings("breakfast", 3))
    camera, found = Camera(trial.simulation.physics, 800, 800), {}
    for event in trial.events():
        if event.type == "prediction":
            found[f"{event.t:.0f} s: the goal is breakfast"] = camera.frame()
        if event.type == "plan" and event.data["ready"]:
            found[f"{event.t:.0f} s: eating is recognised"] = camera.frame()
        if event.type == "focus" and trial.simulation.robot.holding == "plate" and len(found) == 2:
            carried = event.t
            found["carrying"] = camera.frame()
        if event.type == "focus" and "carrying" in found and event.t < carried + 4:
            found["carrying"] = camera.frame()
    found[f"{carried:.0f} s: the robot clears the plate"] = found.pop("carrying")
    return list(found.items())


def main() -> None:
    """Write docs/breakfast.png."""
    pictures = frames()
    figure, axes = plt.subplots(1, len(pictures), figsize=(5 * len(pictures), 5.3))
    for axis, (title, picture) in zip(axes, pictures):
        axis.imshow(picture)
        axis.set_title(title, fontsize=14)
        axis.axis("off")
    figure.tight_layout()
    figure.savefig(HERE / "breakfast.png", dpi=70)


if __name__ == "__main__":
    main()
