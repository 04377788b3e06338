import subprocess
import sys
import textwrap

import numpy as np
import pytest

pytest.importorskip("mujoco")

import simulated_kitchen

from casper.sim_adapter.eye.camera import look_from, write_png

DRAW = """
    import sys
    sys.path.insert(0, {tests!r})
    from simulated_kitchen import kitchen_scene
    from casper.sim_adapter.eye.camera import Camera, RenderError, write_png
    from casper.sim_adapter.physics.physics import Physics
    try:
        camera = Camera(Physics(kitchen_scene()), 160, 120)
    except RenderError as reason:
        print("no picture:", str(reason).splitlines()[0])
    else:
        picture = camera.frame()
        write_png({file!r}, picture)
        print("picture", picture.shape, int(picture.std()))
        camera.close()
"""


def draw(file, gl):
    """Draw in a process of its own: MuJoCo chooses its OpenGL when it is imported."""
    code = textwrap.dedent(DRAW).format(tests=simulated_kitchen.__file__.rsplit("/", 1)[0], file=str(file))
    environment = {"MUJOCO_GL": gl, "PATH": "/usr/bin:/bin"}
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=environment).stdout


def test_a_picture_of_the_room_is_drawn_or_one_sentence_says_why_not(tmp_path):
    said = draw(tmp_path / "room.png", "egl")
    if said.startswith("no picture:"):
        assert "MUJOCO_GL" in said
    else:
        assert said.startswith("picture (120, 160, 3)")
        assert int(said.split()[-1]) > 10
        assert (tmp_path / "room.png").read_bytes().startswith(b"\x89PNG")


def test_a_machine_without_opengl_is_told_what_to_install(tmp_path):
    said = draw(tmp_path / "room.png", "off")
    assert said.startswith("no picture:") and "libegl1" in said


def test_a_written_picture_reads_back_as_it_was(tmp_path):
    image = pytest.importorskip("matplotlib.image")
    picture = np.random.default_rng(0).integers(0, 256, (7, 5, 3), dtype=np.uint8)
    write_png(tmp_path / "p.png", picture)
    read = np.round(image.imread(tmp_path / "p.png")[..., :3] * 255).astype(np.uint8)
    assert (read == picture).all()


def test_looking_straight_down_is_an_elevation_of_minus_ninety():
    view = look_from((0.0, 0.0, 3.0), (0.0, 0.0, 1.0))
    assert view["elevation"] == pytest.approx(-90.0) and view["distance"] == pytest.approx(2.0)
