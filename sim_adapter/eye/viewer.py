"""MuJoCo's viewer beside a simulation that goes on: a window to look around in, where there is a screen."""

from __future__ import annotations

import sys
import time
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from casper.kb.errors import CasperError
from casper.sim_adapter.eye.camera import SHOWN
from casper.sim_adapter.eye.film import overview
from casper.sim_adapter.physics.physics import Physics

INSTEAD = "without a window, --report FILE.html and --video FILE.mp4 show a run"
NAP = 3600.0  # seconds slept at once: no platform counts up to any float


def check_screen() -> None:
    """See that a window can be opened, before anything is simulated. MuJoCo itself would wait for ever for one.

    Raises:
        CasperError: there is no screen, or no OpenGL on it.
    """
    if sys.platform == "darwin":  # windows belong to the main thread there: only mjpython can show one
        return
    try:
        import glfw
    except ImportError as mistake:
        raise CasperError(f"--view needs GLFW, which cannot be loaded ({mistake}); {INSTEAD}") from None
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # GLFW's own words for what is told below
        if not glfw.init():
            raise CasperError(f"--view needs a screen, and there is none; {INSTEAD}")
        glfw.window_hint(glfw.VISIBLE, glfw.FALSE)
        window = glfw.create_window(64, 64, "casper", None, None)
        if window is not None:
            glfw.destroy_window(window)
        glfw.default_window_hints()
    if not window:
        raise CasperError(f"--view needs OpenGL on the screen, and there is none; {INSTEAD}")


class Viewer:
    """Shows the physics at every look, and holds the simulation back to a pace.

    Args:
        physics: what is shown.
        speed: simulated seconds a second; 0 is as fast as it goes.

    Raises:
        CasperError: the window needs another way to start Python (macOS).
    """

    def __init__(self, physics: Physics, speed: float) -> None:
        import mujoco.viewer

        self.physics, self.speed = physics, speed
        try:
            self._window: Any = mujoco.viewer.launch_passive(
                physics.model, physics.data, show_left_ui=False, show_right_ui=False
            )
        except RuntimeError:
            raise CasperError(f"--view on macOS needs mjpython: mjpython -m casper run …; {INSTEAD}") from None
        where = overview(physics.scene, 4 / 3)
        camera = self._window.cam
        camera.azimuth, camera.elevation, camera.distance = where["azimuth"], where["elevation"], where["distance"]
        camera.lookat[:] = where["look_at"]
        for group in range(6):  # by itself it shows furniture and things only; walls would be in the way
            self._window.opt.geomgroup[group] = group in SHOWN
        self._began = time.monotonic() - (physics.time / speed if speed > 0 else 0.0)

    def look(self) -> None:
        """Show this moment, when its time has come; nothing once the window was closed: the run goes on without."""
        if not self._window.is_running():
            return
        while self.speed > 0 and (left := self.physics.time / self.speed - (time.monotonic() - self._began)) > 0:
            time.sleep(min(left, NAP))
        self._window.sync()

    def close(self) -> None:
        """Close the window."""
        self._window.close()


@contextmanager
def viewing(simulation: Any, speed: float | None) -> Iterator[None]:
    """Show a simulation in a window while this lasts; nothing where the speed is None.

    Raises:
        CasperError: as `check_screen` and `Viewer`.
    """
    if speed is None:
        yield
        return
    check_screen()
    viewer, before = Viewer(simulation.physics, speed), simulation.each_glance

    def both() -> None:
        before()
        viewer.look()

    simulation.each_glance = both
    try:
        yield
    finally:
        simulation.each_glance = before
        viewer.close()
