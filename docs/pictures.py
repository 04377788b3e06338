"""Draws the pictures of the pages: a breakfast at three moments, the tutorial's room, the focus of a drink, TIAGo++.

    MUJOCO_GL=egl python docs/pictures.py

notebook.png is a part of the first notebook's page, as a browser shows it; report.png is the page of
`casper run kitchen --goal lunch --seed 3 --report lunch.html` at `lunch.html#t=80`, 1280 by 1570 pixels.
"""

import math
import sys
import tempfile
from contextlib import suppress
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / part) for part in ("src", "tests/helpers")]

from pages import blocks_of  # noqa: E402
from visits import Visit  # noqa: E402

from casper import Domain  # noqa: E402
from casper.engine.events.curves import focus_curve  # noqa: E402
from casper.kb.errors import CasperError  # noqa: E402
from casper.sim_adapter.eye.camera import Camera, look_from  # noqa: E402
from casper.sim_adapter.trial import Trial, TrialSettings  # noqa: E402


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


def tearoom() -> list[tuple[str, np.ndarray]]:
    """The room of the tutorial, when its goal is read and when the robot carries the mug."""
    with tempfile.TemporaryDirectory() as folder:
        visit = Visit(Path(folder))
        for block in blocks_of(HERE / "tutorial.md"):
            if block.language == "prolog":
                visit.run(block)
        trial = Trial(Domain.load(Path(folder) / "tearoom"), TrialSettings("tea", 1))
    camera, found, under_way = Camera(trial.simulation.physics, 800, 800), [], []
    for event in trial.events():
        if event.type == "prediction":
            found.append((f"{event.t:.0f} s: the goal is tea", camera.frame()))
        elif (event.type == "plan" and event.data["ready"]) or (event.type == "focus" and under_way):
            under_way.append((f"{event.t:.0f} s: the robot clears the mug", camera.frame()))
        elif event.type == "robot" and event.data["status"] == "done":
            done = (f"{event.t:.0f} s: the mug is in the sink", camera.frame())
            return [*found, under_way[3 * len(under_way) // 4], done]
    return found


def tiago() -> list[tuple[str, np.ndarray]]:
    """TIAGo++ at a breakfast: it watches, takes the plate, carries it, washes it."""
    trial = Trial(Domain.load("kitchen"), TrialSettings("breakfast", 3, body="tiago"))
    robot, camera, found = trial.simulation.robot, Camera(trial.simulation.physics, 800, 800), {}

    def take(title: str, turn: float) -> None:
        x, y, heading = robot.pose
        place = (x + 2.1 * math.cos(heading + turn), y + 2.1 * math.sin(heading + turn), 1.75)
        found[title] = camera.frame(**look_from(place, (x + 0.2 * math.cos(heading), y + 0.2 * math.sin(heading), 0.8)))

    def look() -> None:
        step, held = robot.current, robot.holding == "plate"
        if held and "takes the plate" not in found:
            take("takes the plate", -1.2)
        elif held and step is not None and step.skill == "use" and "washes it" not in found:
            take("washes it", 2.3)

    trial.each_step = look
    for event in trial.events():
        if event.type == "prediction":
            take("watches", -0.7)
    return list(found.items())


def draw(pictures: list[tuple[str, np.ndarray]], file: str) -> None:
    """Pictures side by side in a file."""
    figure, axes = plt.subplots(1, len(pictures), figsize=(5 * len(pictures), 5.3))
    for axis, (title, picture) in zip(axes, pictures):
        axis.imshow(picture)
        axis.set_title(title, fontsize=14)
        axis.axis("off")
    figure.tight_layout()
    figure.savefig(HERE / file, dpi=70, bbox_inches="tight")


def focus(file: str) -> None:
    """What somebody who has a drink attends to."""
    trial = Trial(Domain.load("kitchen"), TrialSettings("drink", 1, robot=False))
    (HERE / file).write_text(focus_curve(trial.events())._repr_svg_() or "")


if __name__ == "__main__":
    draw(frames(), "breakfast.png")
    draw(tearoom(), "tearoom.png")
    focus("focus.svg")
    with suppress(CasperError):  # its model is not there
        draw(tiago(), "tiago.png")
