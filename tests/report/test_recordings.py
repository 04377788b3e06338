"""What is recorded is bounded, what is printed of it is escaped, and what became of an announcement is found."""

import json

from hypothesis import given, settings
from hypothesis import strategies as st

from casper import Domain
from casper.engine.events.event import Event
from casper.engine.mind import Mind
from casper.engine.perception.world import AgentState, ObjectState, WorldState
from casper.report.helped import parts_of
from casper.report.page import page_of
from casper.report.payload import script_json
from casper.report.recorder import MOST_EVENTS, Recorder
from casper.report.recording import Recording
from casper.report.story import answers
from casper.report.thinned import Thinned

EVIL = "</script><script>alert(1)</script><img src=x onerror=alert(1)>\"'&$x"
PLAN = {"agent": "tiago", "partner": "ann", "waiting": [], "actions": ["wash(cup)"], "ready": True}


def plan(t, goal, **changed):
    return Event("plan", t, {**PLAN, "goal": goal, **changed})


def episode(t, goal, outcome):
    row = {"agent": "ann", "goal": goal, "outcome": outcome, "from": 0.0, "to": t, "observed": 1, "missed": 0}
    return Event("episode", t, row)


def robot(t, status):
    return Event("robot", t, {"agent": "tiago", "partner": "ann", "action": "wash(cup)", "status": status})


@settings(max_examples=50)
@given(st.integers(2, 20), st.integers(0, 300))
def test_a_thinned_series_is_bounded_begins_with_the_first_and_has_equal_gaps(most, count):
    series = Thinned(most)
    for item in range(count):
        series.add(item)
    kept = list(series)
    assert len(kept) <= most
    assert kept == list(range(0, count, series.stride))
    assert series.left_out == count - len(kept)


def test_a_series_that_fits_is_kept_whole():
    series = Thinned(10)
    for item in range(10):
        series.add(item)
    assert list(series) == list(range(10))


def test_a_long_run_keeps_its_summary_and_says_what_is_left_out():
    domain = Domain.load("kitchen")
    recorder = Recorder(domain)
    minds = Mind(domain)
    for t in range(MOST_EVENTS + 5):
        recorder.take(Event("warning", float(t), {"message": "again"}), minds)
    recorder.take(Event("summary", 1e4, minds.summary()), minds)
    recording = recorder.recording()
    assert len(recording.events) == MOST_EVENTS + 1
    assert recording.summary is not None
    assert recording.left_out == {"warning": 5}




def test_an_announcement_that_is_taken_back_is_told_as_withdrawn():
    because = Event("withdrawn", 2.0, {"agent": "tiago", "partner": "ann", "goal": "tea", "because": "no tea"})
    first, second = parts_of([plan(1.0, "tea"), because, episode(2.0, "tea", "abandoned"), plan(2.0, "soup"), robot(3.0, "done")])
    assert first.end is because
    assert (first.steps, [e.data["status"] for e in second.steps]) == ([], ["done"])


def test_plans_for_one_goal_are_one_part_until_its_episode_ends():
    events = [plan(1.0, "tea", waiting=["sip(cup)"]), plan(2.0, "tea"), robot(3.0, "done"), episode(3.0, "tea", "finished"), plan(9.0, "tea")]
    first, second = parts_of(events)
    assert (len(first.plans), first.end, len(first.steps)) == (2, events[3], 1)
    assert (len(second.plans), second.end) == (1, None)


def test_of_two_partners_each_part_is_announced_once():
    events = [
        plan(1.0, "tea", waiting=["sip(cup)"]),
        plan(2.0, "tea", waiting=["sip(cup)"], partner="bob"),
        plan(3.0, "tea"),
        plan(4.0, "tea", partner="bob"),
    ]
    told = dict(answers(Recording("home", ("ann", "bob"), "tiago", tuple(events))))
    assert told["What did tiago do?"].count("announced") == 2
    assert told["What did the partners do?"] == "<p>Nothing that the robot made out.</p>"


def test_no_name_becomes_a_tag_or_ends_the_data():
    scores = {"agent": EVIL, "target": EVIL, "destination": None, "scores": {EVIL: 1.0}}
    reading = {
        "agent": EVIL, "observations": [EVIL], "explanations": 1, "confidence": 1.0, "outcome": EVIL, "posterior": {EVIL: 1.0},
        "best": [{"goal": EVIL, "share": 1.0, "score": 1.0, "leaves": [{"action": EVIL, "status": "observed"}]}],
        "frontier": [EVIL], "rejected": [{"goal": EVIL, "reasons": [EVIL]}],
    }  # fmt: skip
    events = (
        Event("focus", 0.0, scores),
        Event("movement", 0.0, {"agent": EVIL, "movement": EVIL}),
        Event("verdict", 1.0, {"agent": EVIL, "statement": EVIL, "completed": EVIL, "valid": False, "reasons": [EVIL]}),
        Event("verdict", 1.0, {"agent": EVIL, "statement": EVIL, "completed": EVIL, "valid": True, "reasons": []}),
        Event("reading", 1.0, reading),
        Event("prediction", 1.0, {"agent": EVIL, "goal": EVIL, "observed": 1, "missed": 0, "posterior": {EVIL: 1.0}}),
        Event("plan", 1.0, {**PLAN, "agent": EVIL, "partner": EVIL, "goal": EVIL, "waiting": [EVIL], "actions": [EVIL]}),
        Event("robot", 2.0, {"agent": EVIL, "partner": EVIL, "action": EVIL, "status": "failed", "reason": EVIL}),
        Event("withdrawn", 2.0, {"agent": EVIL, "partner": EVIL, "goal": EVIL, "because": EVIL}),
        Event("warning", 2.0, {"message": EVIL}),
    )
    state = WorldState(0.0, {EVIL: AgentState(0.0, 0.0, 0.0, EVIL)}, {EVIL: ObjectState(1.0, 1.0)})
    page = page_of(Recording(EVIL, (EVIL,), EVIL, events, (state,)))
    assert page.count("<script") == 2
    assert "<img" not in page
    assert page.count("alert(1)") > 30


def test_what_is_no_finite_number_is_null_in_the_data():
    assert json.loads(script_json({"a": [float("nan"), float("inf"), 1.5]})) == {"a": [None, None, 1.5]}


def test_a_run_in_which_nothing_happened_is_a_page():
    page = page_of(Recording("empty", ("ann",), "tiago", ()))
    assert "Nothing that the robot made out." in page
    assert "broken off before the end" in page
