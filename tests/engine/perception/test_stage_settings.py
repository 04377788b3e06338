"""Settings of perception, tracking and focus: their bounds, and where facts say them."""

import math

import pytest
from low_level_kitchen import rows_of

from casper.engine.perception.focus import FocusSettings, focus_settings
from casper.engine.perception.perception import BANDS, PerceptionSettings, perception_settings
from casper.engine.perception.tracking import Tracker, TrackerSettings, tracker_settings
from casper.engine.perception.world import AgentState, WorldState
from casper.engine.settings import number, read_settings
from casper.kb.errors import DomainError


@pytest.mark.parametrize(
    ("kind", "wrong", "sentence"),
    [
        (FocusSettings, {"angle_unit": "turns"}, "angle_unit is degrees or radians, not turns"),
        (FocusSettings, {"w_qdc": -0.1}, "focus weights are positive"),
        (FocusSettings, {"w_qtc": -0.1}, "focus weights are positive"),
        (FocusSettings, {"w_qdc": 0.0, "w_qtc": 0.0}, "focus weights are positive"),
        (FocusSettings, {"angle_resolution": -1.0}, "focus tolerances are not negative"),
        (FocusSettings, {"tie_tolerance": -0.1}, "focus tolerances are not negative"),
        (FocusSettings, {"target_votes": 0}, "target_votes lies between 1 and target_window"),
        (FocusSettings, {"target_votes": 5}, "target_votes lies between 1 and target_window"),
        (FocusSettings, {"destination_votes": 0}, "destination_votes lies between 1 and destination_window"),
        (FocusSettings, {"destination_votes": 6}, "destination_votes lies between 1 and destination_window"),
        (PerceptionSettings, {"bands": ()}, "QDC bands need ends that grow"),
        (PerceptionSettings, {"bands": (("a", 2.0), ("b", 1.0))}, "QDC bands need ends that grow"),
        (PerceptionSettings, {"bands": (("a", 1.0), ("b", 1.0))}, "QDC bands need ends that grow"),
        (PerceptionSettings, {"bands": (("a", 1.0), ("a", 2.0))}, "a QDC band is named twice"),
        (PerceptionSettings, {"qtc": "x"}, "qtc is projection or distance, not x"),
        *[(PerceptionSettings, {name: -0.1}, f"{name} of the perception must not be negative") for name in ("moving_speed", "qtc_speed", "qdc_margin", "moving_margin", "qtc_margin")],
        *[(TrackerSettings, {name: -0.1}, f"{name} of the tracker must not be negative") for name in ("gate", "agent_gate", "agent_bridge")],
        (TrackerSettings, {"memory": 0}, "memory and outliers of the tracker start at 1"),
        (TrackerSettings, {"outliers": 0}, "memory and outliers of the tracker start at 1"),
        (TrackerSettings, {"hold_bridge": -1}, "hold_bridge starts at 0, hold_confirm at 1"),
        (TrackerSettings, {"hold_confirm": 0}, "hold_bridge starts at 0, hold_confirm at 1"),
    ],
)  # fmt: skip
def test_a_setting_out_of_its_bounds_is_refused(kind, wrong, sentence):
    with pytest.raises(DomainError, match=sentence):
        kind(**wrong)


@pytest.mark.parametrize(
    ("kind", "edge"),
    [
        (FocusSettings, {"w_qdc": 0.0, "w_qtc": 0.1}),
        (FocusSettings, {"w_qdc": 0.1, "w_qtc": 0.0, "angle_resolution": 0.0, "tie_tolerance": 0.0}),
        (FocusSettings, {"target_votes": 1, "target_window": 1, "destination_votes": 1, "destination_window": 1}),
        (PerceptionSettings, {"moving_speed": 0.0, "qtc_speed": 0.0, "qdc_margin": 0.0, "bands": (("a", 1.0),)}),
        (TrackerSettings, {"gate": 0.0, "memory": 1, "outliers": 1, "hold_bridge": 0, "hold_confirm": 1}),
    ],
)
def test_a_setting_at_its_bound_is_allowed(kind, edge):
    assert all(getattr(kind(**edge), name) == value for name, value in edge.items())


def facts(section, **values):
    return rows_of({("setting", 3): [(section, name, value) for name, value in values.items()]})


def test_facts_say_what_differs_from_the_defaults():
    assert tracker_settings(facts("tracking", enabled="false", gate=1)) == TrackerSettings(enabled=False, gate=1.0)
    assert focus_settings(facts("focus", threshold="infinite")).threshold == math.inf
    assert perception_settings(facts("focus", threshold=1)) == PerceptionSettings()
    assert perception_settings(rows_of({})).bands == BANDS


def test_encodings_of_one_kind_leave_the_other_alone():
    settings = focus_settings(rows_of({("encoding", 3): [("qdc", "here", 1)]}))
    assert settings.qdc == {"here": 1.0} and settings.qtc == FocusSettings().qtc
    with pytest.raises(DomainError, match="only qdc and qtc are encoded"):
        focus_settings(rows_of({("encoding", 3): [("mos", "still", 1)]}))


def test_bands_are_sorted_and_closed_at_infinity():
    rows = rows_of({("band", 2): [("far", 5), ("near", 2)]})
    assert perception_settings(rows).bands == (("near", 2.0), ("far", 5.0), ("ignore", math.inf))
    closed = rows_of({("band", 2): [("near", 2), ("far", "infinite")]})
    assert perception_settings(closed).bands == (("near", 2.0), ("far", math.inf))


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({"gait": 1}, r"setting\(tracking, gait, …\) is unknown; tracking has agent_bridge, "),
        ({"gate": "wide"}, r"setting\(tracking, gate, wide\): 'wide' should be a number"),
        ({"memory": 1.5}, "should be a whole number"),
        ({"memory": True}, "should be a whole number"),
        ({"enabled": 1}, "should be true or false"),
        ({"enabled": "maybe"}, "should be true or false"),
    ],
)
def test_a_value_of_the_wrong_kind_is_refused(values, sentence):
    with pytest.raises(DomainError, match=sentence):
        tracker_settings(facts("tracking", **values))


def test_a_name_with_two_values_is_refused_and_one_said_twice_is_not():
    twice = rows_of({("setting", 3): [("tracking", "gate", 1), ("tracking", "gate", 1.0)]})
    assert tracker_settings(twice).gate == 1.0
    two = rows_of({("setting", 3): [("tracking", "gate", 1), ("tracking", "gate", 2)]})
    with pytest.raises(DomainError, match=r"has two values, 1\.0 and 2\.0"):
        tracker_settings(two)


def test_what_comes_from_other_facts_cannot_be_set():
    with pytest.raises(DomainError, match=r"bands, …\) is unknown"):
        perception_settings(facts("perception", bands=1))
    assert read_settings(TrackerSettings, rows_of({}), "tracking", gate=2.0).gate == 2.0


def test_a_name_is_no_number_and_a_number_no_name():
    with pytest.raises(DomainError, match="should be a name"):
        focus_settings(facts("focus", angle_unit=3))
    for value in ("x", True, None, math.nan):
        with pytest.raises(DomainError, match="should be a number"):
            number(value, "here")
    assert [number(value, "here") for value in (1, 2.5, "inf", "infinite")] == [1.0, 2.5, math.inf, math.inf]


def test_an_agent_that_was_seen_once_is_thought_to_stay_where_it_was():
    tracker = Tracker(TrackerSettings(agent_bridge=2.0))
    tracker.update(WorldState(0.0, {"ann": AgentState(1.0, 2.0, 0.5)}, {}))
    assert tracker.update(WorldState(1.0, {}, {})).agents == {"ann": AgentState(1.0, 2.0, 0.5)}
    assert tracker.update(WorldState(2.0, {}, {})).agents == {"ann": AgentState(1.0, 2.0, 0.5)}
    assert tracker.update(WorldState(2.5, {}, {})).agents == {}
