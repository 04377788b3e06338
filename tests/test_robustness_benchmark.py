"""The benchmark of poor sensors, without simulating: its rows, what is counted, what is kept, what is drawn."""

import sys
from itertools import chain
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
if str(ROOT / "benchmarks" / "perception") not in sys.path:
    sys.path.append(str(ROOT / "benchmarks" / "perception"))
pytest.importorskip("mujoco")
pytest.importorskip("joblib")

import robustness  # noqa: E402
from sensors import FAMILIES, sensors  # noqa: E402

from casper import Domain  # noqa: E402
from casper.kb.errors import CasperError  # noqa: E402
from casper.sim_adapter.room.facts import scene_of  # noqa: E402


def outcome(row, seed, right=True, helped=True, t=12.0):
    return {"row": row, "seed": seed, "goal": "lunch", "right": right, "helped": helped, "wrong": False, "t": t}


def test_every_row_sets_what_the_simulated_eye_has_and_no_two_have_one_name():
    eye = scene_of(Domain.load("kitchen")).sensor
    names = [sensor.name for sensor in chain.from_iterable(family.rows for family in FAMILIES)]
    assert len(names) == len(set(names)) and set(names) | {"default", "cheap"} == set(sensors())
    assert all(hasattr(eye, setting) for sensor in sensors().values() for setting in sensor.eye)


def test_the_quantities_that_stand_alone_are_at_the_kitchens_own_value_elsewhere():
    scene = scene_of(Domain.load("kitchen"))
    eye = scene.sensor
    own = (eye.noise * 100, eye.drop * 100, scene.sim.period, eye.hold_misread * 100, eye.heading_noise, eye.field_of_view)
    assert [family.own for family in FAMILIES] == pytest.approx(own)


def test_a_row_counts_right_and_helped_apart_and_means_the_times_of_those_that_are_right():
    found = [outcome("cheap", 1, t=10.0), outcome("cheap", 2, helped=False, t=20.0), outcome("cheap", 3, False, False, 99.0)]
    row = robustness.counted("cheap", [*found, outcome("default", 1)])
    assert row == {"row": "cheap", "trials": 3, "right": 2, "helped": 1, "wrong": 0, "known at": 15.0}
    assert "| 3 | 2 (21–94 %) | 1 (6–79 %) | 0 | 15.0 s |" in list(robustness.table([row]))[-1]


def test_a_run_that_was_interrupted_goes_on_with_what_is_left(tmp_path, monkeypatch):
    ran = []
    monkeypatch.setattr(robustness, "trial", lambda sensor, seed: ran.append(seed) or outcome(sensor.name, seed))
    wanted = [(sensors()["cheap"], seed) for seed in range(4)]
    journal = robustness.opened(tmp_path)
    list(robustness.run(wanted[:2], 1, journal))
    journal.close(finished=False)
    journal = robustness.opened(tmp_path)
    assert [found["seed"] for found in robustness.run(wanted, 1, journal)] == [0, 1, 2, 3]
    journal.close(finished=False)
    assert ran == [0, 1, 2, 3] and len(robustness.kept_in(tmp_path)) == 4


def test_what_another_program_kept_is_refused_with_what_to_do(tmp_path, monkeypatch):
    robustness.opened(tmp_path).close(finished=False)
    monkeypatch.setattr(robustness, "code", lambda: "another")
    with pytest.raises(CasperError, match=r"another version of casper.*--redraw"):
        robustness.opened(tmp_path)


def test_nothing_to_draw_is_said():
    with pytest.raises(CasperError, match=r"no trials in .* run it without --redraw"):
        robustness.kept_in(Path("nowhere"))


@pytest.mark.parametrize("rows", [["default"], ["noise_6", "view_50", "cheap"], list(sensors())])
def test_the_plot_has_a_panel_for_each_quantity_however_few_rows_there_are(rows, tmp_path):
    pytest.importorskip("matplotlib")
    told = [robustness.counted(row, [outcome(row, 1), outcome(row, 2, helped=False)]) for row in rows]
    drawn = robustness.figure(told)
    assert len(drawn.axes) == 8 and [axes.get_title(loc="left") != "" for axes in drawn.axes[:7]] == [True] * 7
    assert [file.suffix for file in robustness.save(robustness.figure, told, tmp_path / "plot")] == [".svg", ".png"]
