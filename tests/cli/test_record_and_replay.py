"""``--record``, ``casper record`` and ``casper replay``: the same events again, a noisy sensor included."""

import json
import os
import shutil
import subprocess
import sys

import pytest

from casper.engine.domain.domain import SHIPPED

STATE = {"agents": {"human": {"x": 0.0, "y": 0.0, "heading": 0.0, "holding": None}}, "objects": {"plate": {"x": 0.5, "y": 0.0}}}
LINES = "\n".join(json.dumps({"t": t / 2, **STATE}) for t in range(1, 5))


def test_a_noisy_run_replays_bit_for_bit_in_another_process(casper, tmp_path):
    pytest.importorskip("mujoco")
    home = tmp_path / "home"
    shutil.copytree(SHIPPED / "kitchen", home)
    scene = home / "scene.pl"
    scene.write_text(scene.read_text() + "\nsetting(sensor, noise, 0.06).\n")
    file = tmp_path / "run.jsonl.gz"
    ran = casper("run", str(home), "--goal", "drink", "--seed", "3", "--noise", "0.1", "--record", str(file), "--json")
    again = subprocess.run(
        [sys.executable, "-m", "casper", "replay", str(file), "--json"],
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONHASHSEED": "7", "PYTHONPATH": os.pathsep.join(sys.path)},
    )
    assert (again.stdout, again.stderr, again.returncode) == (ran.out, "", 0)
    assert len(ran.json) > 100


def test_a_watch_is_recorded_and_replayed(casper, tmp_path):
    file = str(tmp_path / "a.jsonl")
    seen = casper("watch", "kitchen", "--record", file, "--json", stdin=LINES + "\n{oops")
    assert casper("replay", file, "--json").out == seen.out
    assert "still" in casper("replay", file).out


def test_a_replay_that_says_something_else_has_exit_code_1(casper, tmp_path):
    file = tmp_path / "a.jsonl"
    casper("watch", "kitchen", "--record", str(file), stdin=LINES)
    file.write_text(file.read_text().replace('"x": 0.5', '"x": 0.7'))
    told = casper("replay", str(file), "--json")
    assert (told.code, "the events are not those that were recorded" in told.err) == (1, True)


def test_a_stream_is_recorded_without_reading_it(casper, tmp_path):
    file = tmp_path / "a.jsonl"
    told = casper("record", "kitchen", str(file), stdin=LINES + "\n{oops")
    assert told.out == f"{file}: 4 world states of 1.5 s, 1 warnings\n"
    assert "line 5 is left out" in told.err
    again = casper("replay", str(file), "--json")
    assert (again.code, again.json[-1]["type"]) == (0, "summary")


def test_a_recording_is_never_written_over(casper, tmp_path):
    (tmp_path / "a.jsonl").write_text("precious")
    told = casper("watch", "kitchen", "--record", str(tmp_path / "a.jsonl"), stdin=LINES)
    assert (told.code, "is there already" in told.err) == (2, True)


def test_a_domain_that_is_read_anew_is_not_recorded(casper, tmp_path):
    told = casper("watch", "kitchen", "--reload", "--record", str(tmp_path / "a.jsonl"), stdin=LINES)
    assert (told.code, "do not go together" in told.err) == (2, True)


def test_a_replay_keeps_the_asked_pace(casper, tmp_path, monkeypatch):
    from casper.cli.terminal import pacing

    file, now, naps = str(tmp_path / "a.jsonl"), [100.0], []
    casper("watch", "kitchen", "--record", file, stdin=LINES)
    monkeypatch.setattr(pacing.time, "monotonic", lambda: now[0])
    monkeypatch.setattr(pacing.time, "sleep", lambda s: (naps.append(s), now.__setitem__(0, now[0] + s)))
    casper("replay", file, "--speed", "0.5", "--json")
    assert naps == [1.0, 1.0, 1.0]
