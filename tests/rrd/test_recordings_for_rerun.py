"""Recordings for Rerun's viewer, read back: everything is there, on one time line, at its time."""

import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest

pytest.importorskip("rerun", reason="rerun-sdk is not installed, with which recordings are written and read")

from rerun.chunk import RrdReader

from casper.engine.domain.domain import Domain
from casper.engine.events.event import Event
from casper.engine.live import Partners
from casper.engine.perception.world import AgentState, ObjectState, WorldState
from casper.kb.errors import CasperError
from casper.rrd.log import Log
from casper.rrd.writing import check_rrd


@cache
def domain():
    return Domain.load("kitchen")


def world(t, x=0.0, **places):
    return WorldState(t, {"human": AgentState(x, 0.0, 0.5)}, {name: ObjectState(*at) for name, at in places.items()})


def rows(path, entity, what):
    """Time and value of everything that an entity was told of a component, in order; static values have no time."""
    found = []
    for chunk in RrdReader(path).stream().to_chunks():
        if chunk.entity_path != entity:
            continue
        batch = chunk.to_record_batch().to_pydict()
        name = next((name for name in batch if name.endswith(f":{what}")), None)
        if name is not None:
            times = batch.get("time", [None] * len(batch[name]))
            found += [(None if t is None else round(t.total_seconds(), 3), v) for t, v in zip(times, batch[name])]
    return sorted(((t, v) for t, v in found if v), key=lambda row: row[0] or 0.0)


def written(tmp_path, *heard):
    """A recording of world states and events in order."""
    path = tmp_path / "run.rrd"
    log, minds = Log(domain(), path), Partners(domain())
    for item in heard:
        if isinstance(item, WorldState):
            log.see(item)
        else:
            log.take(item, minds)
    log.close()
    return path


def entities(path):
    return {chunk.entity_path for chunk in RrdReader(path).stream().to_chunks()}


def test_the_room_stands_there_at_all_times(tmp_path):
    path = written(tmp_path, world(1.0))
    assert {"/room/walls", "/room/furniture/fridge"} <= entities(path)
    assert all(t is None for t, _ in rows(path, "/room/furniture/fridge", "half_sizes"))


def test_there_is_one_time_line_in_seconds(tmp_path):
    path = written(tmp_path, world(1.0, plate=(1.0, 2.0, 0.9)))
    lines = {name for chunk in RrdReader(path).stream().to_chunks() for name in chunk.timeline_names}
    assert lines == {"time"}


def test_an_agent_is_where_it_was_at_each_time(tmp_path):
    path = written(tmp_path, world(0.5, 0.0), world(1.0, 0.25), world(1.5, 0.5))
    told = rows(path, "/room/agents/human", "translation")
    assert [(t, v[0][0]) for t, v in told] == [(0.5, 0.0), (1.0, 0.25), (1.5, 0.5)]


def test_what_does_not_move_is_told_once(tmp_path):
    path = written(tmp_path, *(world(t / 2, t / 10, plate=(1.0, 2.0, 0.9)) for t in range(1, 8)))
    assert [t for t, _ in rows(path, "/room/things/plate", "translation")] == [0.5]


def test_what_is_gone_is_cleared_and_what_is_back_is_shown_anew(tmp_path):
    plate = {"plate": (1.0, 2.0, 0.9)}
    path = written(tmp_path, world(0.5, **plate), world(1.0), world(1.5, **plate))
    assert [t for t, _ in rows(path, "/room/things/plate", "is_recursive")] == [1.0]
    assert [t for t, _ in rows(path, "/room/things/plate", "translation")] == [0.5, 1.5]


def test_a_world_state_that_is_no_later_is_left_out(tmp_path):
    path = written(tmp_path, world(1.0, 0.1), world(1.0, 0.2))
    assert len(rows(path, "/room/agents/human", "translation")) == 1


def test_bands_hold_what_was_the_case_and_gaps(tmp_path):
    focus = {"agent": "human", "target": "plate", "destination": None, "scores": {"plate": 0.7}}
    later = {**focus, "target": "sink", "destination": "plate"}
    path = written(tmp_path, world(1.0, plate=(1.0, 2.0, 0.9)), Event("focus", 1.0, focus), Event("focus", 2.0, later))
    assert rows(path, "/bands/human/target", "state") == [(1.0, ["plate"]), (2.0, ["sink"])]
    assert rows(path, "/bands/human/destination", "state")[-1] == (2.0, ["plate"])
    assert rows(path, "/focus/human/plate", "scalars") == [(1.0, [0.7]), (2.0, [0.7])]


def test_names_may_hold_any_letter(tmp_path):
    state = WorldState(1.0, {"human": AgentState(0.0, 0.0, 0.0)}, {"a/b c": ObjectState(1.0, 1.0)})
    assert r"/room/things/a\/b\ c" in entities(written(tmp_path, state))


@cache
def lunch():
    """The events of a trial, and its recording."""
    pytest.importorskip("mujoco")
    import tempfile

    from casper.sim_adapter.trial import Trial, TrialSettings

    path = Path(tempfile.mkdtemp()) / "breakfast.rrd"
    log, trial = Log(domain(), path), Trial(domain(), TrialSettings(goal="breakfast", seed=3))
    trial.each_step = lambda: log.see(trial.simulation.truth())
    events = list(log.heard(trial.events(), trial.minds))
    log.close()
    return events, path


def of_type(kind):
    return [event for event in lunch()[0] if event.type == kind]


def test_posteriors_are_those_of_the_readings():
    told = rows(lunch()[1], "/posterior/human/breakfast", "scalars")
    assert told == [(event.t, [event.data["posterior"]["breakfast"]]) for event in of_type("reading")]


def test_the_goal_is_known_from_the_prediction_on():
    first = of_type("prediction")[0]
    assert rows(lunch()[1], "/bands/human/goal", "state")[0] == (first.t, [first.data["goal"]])


def test_movements_are_those_of_the_events():
    told = rows(lunch()[1], "/bands/human/movement", "state")
    assert told == [(event.t, [event.data["movement"]]) for event in of_type("movement")]


def test_each_action_of_the_robot_has_a_band():
    told = rows(lunch()[1], "/bands/human/tiago.wash.plate.sink", "state")
    times = [(event.t, event.data["status"]) for event in of_type("robot") if event.data["action"] == "wash(plate, sink)"]
    assert [status for _, status in times] == ["asked", "done"]
    assert told == [(times[0][0], ["wash(plate, sink)"]), (times[1][0], [None])]


def test_why_says_what_stood_behind_each_action_and_reading():
    pages = [text for _, (text,) in rows(lunch()[1], "/why", "text")]
    assert len(pages) == len(of_type("verdict")) + len(of_type("reading"))
    rejected = of_type("reading")[0].data["rejected"][0]
    assert any(rejected["goal"] in page and "is ruled out" in page for page in pages)


def test_what_was_told_ends_with_the_summary():
    assert "right" in " ".join(text for t, (text,) in rows(lunch()[1], "/told", "text") if t == lunch()[0][-1].t)


def test_another_ending_is_refused():
    with pytest.raises(CasperError, match=r"written as \.rrd, such as run\.rrd, not as run\.mp4"):
        check_rrd(Path("run.mp4"))


def test_a_place_that_cannot_be_written_is_told():
    with pytest.raises(CasperError, match=r"cannot write /nowhere/run\.rrd"):
        check_rrd(Path("/nowhere/run.rrd"))


def test_without_the_library_it_is_told_what_to_type(monkeypatch, tmp_path):
    monkeypatch.setattr("casper.rrd.writing.find_spec", lambda name: None)
    with pytest.raises(CasperError, match=r"needs rerun-sdk, which is not installed: pip install 'casper-hri\[rerun\]'"):
        check_rrd(tmp_path / "run.rrd")


def test_the_library_is_loaded_for_a_recording_only():
    code = "import sys, casper.rrd.writing; print('rerun' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout.strip() == "False"
