"""MuJoCo's viewer beside a run: without a screen it is a sentence, with one the simulation goes on as it would without."""

import os
import select
import shutil
import subprocess
import sys
import textwrap
from contextlib import contextmanager

import pytest

pytest.importorskip("mujoco")

import simulated_kitchen

from casper.kb.errors import CasperError
from casper.sim_adapter.eye.viewer import viewing
from casper.sim_adapter.simulation import Simulation

CHECK = "from casper.sim_adapter.eye.viewer import check_screen; check_screen()"
RUN = """
    import sys
    sys.path.insert(0, {tests!r})
    from simulated_kitchen import kitchen_scene
    from casper.sim_adapter.eye.viewer import viewing
    from casper.sim_adapter.simulation import Simulation
    def told(speed):
        simulation = Simulation(kitchen_scene(), seed=1)
        with viewing(simulation, speed):
            simulation.advance(1.0)
        return simulation.truth()
    print(told(0.0) == told(None))
"""


def python(code, **environment):
    surroundings = {"PATH": "/usr/bin:/bin", "PYTHONPATH": ":".join(sys.path), "LIBGL_ALWAYS_SOFTWARE": "1", **environment}
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=surroundings, timeout=300)


@contextmanager
def screen():
    """A screen that nobody sees; its name."""
    if shutil.which("Xvfb") is None:
        pytest.skip("Xvfb is not installed, with which there is a screen that nobody sees")
    ours, theirs = os.pipe()
    command = ["Xvfb", "-displayfd", str(theirs), "-screen", "0", "640x480x24", "-nolisten", "tcp"]
    server = subprocess.Popen(command, pass_fds=[theirs], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(theirs)
    try:
        if not select.select([ours], [], [], 60)[0]:
            pytest.skip("Xvfb does not start")
        yield f":{os.read(ours, 16).decode().strip()}"
    finally:
        os.close(ours)
        server.terminate()
        server.wait(30)


@pytest.mark.skipif(sys.platform == "darwin", reason="windows are the main thread's there")
@pytest.mark.parametrize("display", [{}, {"DISPLAY": ":9999"}])
def test_without_a_screen_it_is_told_what_shows_a_run_instead(display):
    told = python(f"from casper.kb.errors import CasperError\ntry:\n    {CHECK}\nexcept CasperError as reason:\n    print(reason)", **display)
    assert told.stdout.startswith("--view needs a screen, and there is none; without a window, --report FILE.html"), told
    assert told.stderr == ""


def test_a_simulation_that_is_watched_goes_on_as_any_other():
    with screen() as display:
        code = textwrap.dedent(RUN).format(tests=simulated_kitchen.__file__.rsplit("/", 1)[0])
        told = python(code, DISPLAY=display)
        if "there is none" in told.stderr:
            pytest.skip("there is no OpenGL on the screen that nobody sees")
        assert told.stdout.strip() == "True", told.stderr


def test_nobody_watches_where_it_is_not_asked_for():
    simulation = Simulation(simulated_kitchen.kitchen_scene(), seed=1)
    with viewing(simulation, None):
        assert simulation.each_glance is bool


def test_what_is_filmed_is_filmed_while_it_is_watched(monkeypatch):
    seen = []

    class Window:
        def __init__(self, physics, speed):
            self.close = lambda: seen.append("closed")

        def look(self):
            seen.append("watched")

    monkeypatch.setattr("casper.sim_adapter.eye.viewer.Viewer", Window)
    monkeypatch.setattr("casper.sim_adapter.eye.viewer.check_screen", lambda: None)
    simulation = Simulation(simulated_kitchen.kitchen_scene(), seed=1)
    simulation.each_glance = film = lambda: seen.append("filmed")
    with pytest.raises(CasperError, match="broken off"), viewing(simulation, 0.0):
        simulation.advance(0.04)
        raise CasperError("broken off")
    assert seen == ["filmed", "watched", "closed"] and simulation.each_glance is film
