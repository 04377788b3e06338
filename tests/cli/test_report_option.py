"""``--report FILE.html``: a place that will not do is told at once, and watched world states make a page, too."""

import json
import re
import sys

import pytest


def test_a_place_that_cannot_be_written_is_told_before_anything_is_simulated(casper):
    told = casper("run", "kitchen", "--report", "/nowhere/run.html")
    assert (told.code, told.out) == (2, "")
    assert told.err == "casper: cannot write /nowhere/run.html (there is no folder /nowhere); choose another place\n"


def test_a_report_is_a_page(casper):
    told = casper("watch", "kitchen", "--report", "run.pdf")
    assert (told.code, told.err) == (2, "casper: a report is a page, such as run.html, not run.pdf\n")


def test_watched_world_states_make_a_page_too(casper, tmp_path):
    page = tmp_path / "watched.html"
    place = {"x": 0.0, "y": 0.0, "heading": 0.0, "holding": None}
    states = [{"t": t, "agents": {"human": {**place, "x": t / 10}}, "objects": {"plate": {"x": 0.5, "y": 0.0}}} for t in (1, 2, 3)]
    told = casper("watch", "kitchen", "--json", "--report", str(page), stdin="\n".join(map(json.dumps, states)))
    written = re.search(r'id="recording">(.*?)</script>', page.read_text(), re.S)
    data = json.loads(written[1])
    assert data["events"] == told.json
    assert data["states"]["t"] == [1.0, 2.0, 3.0]


def test_what_is_missing_for_a_view_or_a_recording_is_told_before_anything_is_simulated(casper, monkeypatch):
    monkeypatch.setattr("casper.rrd.writing.find_spec", lambda name: None)
    told = casper("run", "kitchen", "--rerun", "run.rrd")
    assert (told.code, told.out) == (2, "")
    assert told.err == "casper: this needs rerun-sdk, which is not installed: pip install 'casper-hri[rerun]'\n"
    told = casper("watch", "kitchen", "--rerun", "run.mp4")
    assert (told.code, told.err) == (2, "casper: a recording for Rerun is written as .rrd, such as run.rrd, not as run.mp4\n")


@pytest.mark.skipif(sys.platform == "darwin", reason="windows are the main thread's there")
def test_a_view_without_a_screen_is_told_before_anything_is_simulated(casper, monkeypatch):
    pytest.importorskip("mujoco")
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    told = casper("run", "kitchen", "--view", "--rerun", "run.rrd")
    assert (told.code, told.out) == (2, "")
    assert told.err.startswith("casper: --view needs a screen, and there is none; without a window, --report FILE.html")


def test_a_page_and_a_recording_are_made_of_one_run(casper, tmp_path):
    pytest.importorskip("mujoco")
    pytest.importorskip("rerun", reason="rerun-sdk is not installed, with which recordings are written")
    page, recording = tmp_path / "run.html", tmp_path / "run.rrd"
    files = ("--report", str(page), "--rerun", str(recording))
    told = casper("run", "minimal", "--json", "--no-robot", *files)
    written = re.search(r'id="recording">(.*?)</script>', page.read_text(), re.S)
    assert told.code == 0 and json.loads(written[1])["events"] == told.json
    assert recording.read_bytes()[:3] == b"RRF"
