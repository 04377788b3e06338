"""Whole recordings on arrays: the relations and the focus that are seen a step at a time."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from casper import qsr
from casper.engine.perception.counting import Count
from casper.engine.perception.focus import FocusEstimator, FocusSettings
from casper.engine.perception.perception import Perception, PerceptionSettings
from casper.engine.perception.recorded import recorded
from casper.engine.perception.world import AgentState, ObjectState, WorldState
from casper.kb.errors import TraceError

SEEN = [
    PerceptionSettings(),
    PerceptionSettings(qdc_margin=0.1, moving_margin=0.03, qtc_margin=0.05),
    PerceptionSettings(qtc="distance", snap_held=False),
]
ATTENDED = [
    FocusSettings(angle_resolution=10.0),
    FocusSettings(),
    FocusSettings(tie_tolerance=0.3),
    FocusSettings(angle_resolution=0.0, angle_unit="radians"),
    FocusSettings(target_votes=1, destination_votes=1, destination_window=2, threshold=0.2),
]


def walk(seed, steps, objects, gaps=True, hands=True, coarse=False):
    """Somebody walks about among objects, with something in the hand now and then; some things are hidden sometimes."""
    numbers = np.random.default_rng(seed)
    heading = np.cumsum(numbers.normal(0, 0.4, steps))
    way = np.stack([np.cos(heading), np.sin(heading)], 1) * 0.3 * (numbers.random(steps) < 0.6)[:, None]
    places = np.empty((steps, objects + 1, 2))
    places[:, 1:] = numbers.uniform(0, 4, (objects, 2))
    places[:, 0] = np.abs((np.cumsum(way, 0) + 2) % 8 - 4)
    names = ["human", *(f"o{(n * 13) % objects}" for n in range(objects))]
    hand = [[None] * (objects + 1) for _ in range(steps)]
    for at in range(steps if hands else 0):
        if at // 12 % 2:
            hand[at][0] = names[1 + at // 24 % objects]
    headings = np.concatenate([heading[:, None], np.full((steps, objects), np.nan)], axis=1)
    present = numbers.random((steps, objects + 1)) < (0.9 if gaps else 2)
    return qsr.Trace.of(
        np.arange(steps) / 2, names, places.round(1 if coarse else 6), present=present, headings=headings, holding=hand
    )


def worlds(trace):
    for at, t in enumerate(trace.t.tolist()):
        there = [i for i in range(len(trace.names)) if trace.present is None or trace.present[i, at]]
        x, y = (rows[:, at].tolist() for rows in trace.where)
        held = None if trace.held[0, at] < 0 else trace.names[trace.held[0, at]]
        agents = {"human": AgentState(x[0], y[0], float(trace.heading[0, at]), held)} if 0 in there else {}
        yield WorldState(t, agents, {trace.names[i]: ObjectState(x[i], y[i]) for i in there if i})


def assert_told_alike(trace, seen, attended):
    found = recorded(trace, "human", seen, attended)
    perception, focus = Perception(seen, "human"), FocusEstimator(attended)
    bands = [label for label, _ in seen.bands]
    for at, world in enumerate(worlds(trace)):
        relations = perception.update(world)
        assert (relations is not None) == found.seen[at]
        if relations is None:
            assert found.target[at] == -1
            continue
        attends = focus.update(relations)
        assert found.moving[at] == {None: -1, False: 0, True: 1}[relations.moving]
        for row, name in enumerate(found.objects):
            assert relations.qdc.get(name) == [*bands, None][found.qdc[row, at]]
            assert relations.qtc.get(name) == ["-", "0", "+", None][found.qtc[row, at]]
            assert attends.scores.get(name, 0.0) == pytest.approx(found.scores[row, at], rel=1e-12, abs=0)
        names = [*found.objects, None]
        assert (attends.target, attends.destination) == (names[found.target[at]], names[found.destination[at]])
        assert set(attends.attended) == {name for row, name in enumerate(found.objects) if found.attended[row, at]}


@settings(max_examples=settings().max_examples // 4)
@given(
    st.integers(0, 10**6),
    st.integers(1, 160),
    st.integers(1, 9),
    st.booleans(),
    st.sampled_from(SEEN),
    st.sampled_from(ATTENDED),
)
def test_a_recording_is_seen_as_it_is_a_step_at_a_time(seed, steps, objects, coarse, seen, attended):
    assert_told_alike(walk(seed, steps, objects, coarse=coarse), seen, attended)


@pytest.mark.parametrize("objects", [40, 90])
def test_many_objects_are_seen_as_a_few_are(objects):
    assert_told_alike(walk(5, 60, objects), SEEN[0], ATTENDED[0])


def test_without_gaps_scores_are_equal_to_the_last_digit():
    trace = walk(7, 300, 7, gaps=False, hands=False)
    found, perception, focus = (
        recorded(trace, "human", SEEN[0], ATTENDED[0]),
        Perception(SEEN[0], "human"),
        FocusEstimator(ATTENDED[0]),
    )
    for at, world in enumerate(worlds(trace)):
        scores = focus.update(perception.update(world)).scores
        assert [scores[name] for name in found.objects] == found.scores[:, at].tolist()


def test_where_guessing_leads_nowhere_votes_are_counted_one_by_one(monkeypatch):
    monkeypatch.setattr(Count, "settle", lambda self: False)
    assert_told_alike(walk(2, 90, 4), SEEN[0], ATTENDED[0])


@pytest.mark.parametrize("cells", [1, 50, 400])
def test_where_a_recording_is_cut_does_not_matter(monkeypatch, cells):
    monkeypatch.setattr("casper.engine.perception.recorded.CELLS", cells)
    assert_told_alike(walk(3, 150, 4, coarse=True), SEEN[1], ATTENDED[0])


def test_nobody_is_attended_to_where_there_is_nothing():
    trace = qsr.Trace.of((0, 1), ["human"], np.zeros((2, 1, 2)), headings=np.zeros((2, 1)))
    found = recorded(trace, "human", SEEN[0], ATTENDED[0])
    assert found.objects == () and found.target.tolist() == [-1, -1]


@pytest.mark.parametrize(
    ("headings", "sentence"),
    [(None, "human has no heading, which the focus needs"), ([[0.0], [math.nan]], "human has no heading at t=1")],
)
def test_who_looks_nowhere_has_no_focus(headings, sentence):
    trace = qsr.Trace.of((0, 1), ["human"], np.zeros((2, 1, 2)), headings=headings)
    with pytest.raises(TraceError, match=sentence):
        recorded(trace, "human", SEEN[0], ATTENDED[0])


def test_who_is_not_in_a_recording_is_refused_by_name():
    with pytest.raises(TraceError, match="bob is not in the trace; it has human"):
        recorded(qsr.Trace.of((0,), ["human"], np.zeros((1, 1, 2))), "bob", SEEN[0], ATTENDED[0])
