"""Films: a picture for every fifth of a second; what is missing for one is told in a sentence."""

import subprocess
import sys
import textwrap

import pytest

pytest.importorskip("mujoco")

import simulated_kitchen

from casper.kb.errors import CasperError
from casper.sim_adapter.eye import film
from casper.sim_adapter.eye.film import check_film, overview

FILM = """
    import sys
    from pathlib import Path
    sys.path.insert(0, {tests!r})
    from simulated_kitchen import kitchen_scene
    from casper.sim_adapter.eye.camera import RenderError
    from casper.sim_adapter.eye.film import Film
    from casper.sim_adapter.simulation import Simulation
    simulation = Simulation(kitchen_scene(), seed=1)
    try:
        film = Film(simulation.physics, Path({file!r}), 160, 112)
    except RenderError as reason:
        print("no picture:", reason)
    else:
        simulation.each_glance = film.look
        simulation.advance(2.0)
        film.close()
        import imageio_ffmpeg
        print(*imageio_ffmpeg.count_frames_and_secs({file!r}))
"""


def test_two_seconds_are_ten_pictures_that_take_half_a_second(tmp_path):
    pytest.importorskip("imageio_ffmpeg", reason="imageio-ffmpeg is not installed, with which films are encoded")
    code = textwrap.dedent(FILM).format(tests=simulated_kitchen.__file__.rsplit("/", 1)[0], file=str(tmp_path / "run.mp4"))
    environment = {"MUJOCO_GL": "egl", "PATH": "/usr/bin:/bin", "PYTHONPATH": ":".join(sys.path)}
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=environment)
    if told.stdout.startswith("no picture:"):
        pytest.skip("there is no OpenGL with which a picture could be drawn")
    assert told.stdout.split() == ["10", "0.5"], told.stderr


def test_films_have_one_format():
    with pytest.raises(CasperError, match=r"a film is written as \.mp4, such as run\.mp4, not as run\.avi"):
        check_film(simulated_kitchen.Path("run.avi"))


def test_a_folder_that_is_not_there_is_told_at_once(tmp_path):
    with pytest.raises(CasperError, match="there is no folder"):
        check_film(tmp_path / "nowhere" / "run.mp4")


def test_a_missing_encoder_is_told_with_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setattr(film, "find_spec", lambda name: None)
    with pytest.raises(CasperError, match=r"films need imageio-ffmpeg, .*casper-hri\[video\]"):
        check_film(tmp_path / "run.mp4")


def test_the_camera_looks_at_the_middle_of_the_room():
    view = overview(simulated_kitchen.kitchen_scene(), 4 / 3)
    assert view["look_at"][:2] == pytest.approx(simulated_kitchen.kitchen_scene().middle)
