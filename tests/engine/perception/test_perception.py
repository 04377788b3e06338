import math

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from low_level_kitchen import kitchen_rows, rows_of

from casper.engine.perception.perception import Perception, PerceptionSettings, perception_settings
from casper.engine.perception.world import AgentState, ObjectState, WorldState
from casper.kb.errors import DomainError, WorldStateError

coordinate = st.floats(-6, 6, allow_nan=False)
point = st.tuples(coordinate, coordinate)
angle = st.floats(-10, 10)


def world(t, agent, objects=None, heading=0.0, holding=None):
    places = {name: ObjectState(*place) for name, place in (objects or {}).items()}
    return WorldState(t, {"human": AgentState(*agent, heading, holding)}, places)


def relations_of(*worlds, settings=None):
    perception = Perception(settings or PerceptionSettings(), "human")
    return [perception.update(w) for w in worlds]


def two_steps(before, now, target, **kwargs):
    return relations_of(world(0, before, {"o": target}), world(1, now, {"o": target}), **kwargs)[1]


# --- distance


@pytest.mark.parametrize(
    ("metres", "label"),
    [
        (0, "touch"),
        (0.6, "touch"),
        (0.6001, "near"),
        (2, "near"),
        (3, "medium"),
        (5, "far"),
        (5.1, "ignore"),
        (90, "ignore"),
    ],
)
def test_a_distance_has_the_first_label_whose_closed_end_it_does_not_exceed(metres, label):
    assert relations_of(world(0, (0, 0), {"o": (metres, 0)}))[0].qdc["o"] == label


@given(st.floats(0, 10), st.floats(0, 10))
def test_a_greater_distance_never_has_a_nearer_label(one, other):
    labels = [label for label, _ in PerceptionSettings().bands]
    near, far = relations_of(world(0, (0, 0), {"near": (min(one, other), 0), "far": (0, max(one, other))}))[
        0
    ].qdc.values()
    assert labels.index(near) <= labels.index(far)


def test_height_does_not_count_since_an_agent_has_none():
    assert relations_of(world(0, (0, 0), {"o": (0.5, 0, 40.0)}))[0].qdc["o"] == "touch"


def test_hysteresis_keeps_a_distance_label_until_the_band_is_left_by_the_margin():
    at = [world(t, (0, 0), {"o": (d, 0)}) for t, d in enumerate((0.59, 0.64, 0.66, 0.56, 0.54))]
    seen = [r.qdc["o"] for r in relations_of(*at, settings=PerceptionSettings(qdc_margin=0.05))]
    assert seen == ["touch", "touch", "near", "near", "touch"]


# --- motion


def test_the_first_step_has_neither_motion_nor_trajectory():
    first = relations_of(world(0, (0, 0), {"o": (1, 0)}))[0]
    assert first.moving is None and first.qtc == {"o": None}


@pytest.mark.parametrize(("metres", "moving"), [(0.0899, False), (0.09, False), (0.0901, True)])
def test_moving_needs_strictly_more_than_the_threshold(metres, moving):
    assert two_steps((0, 0), (metres, 0), (3, 3)).moving is moving


def test_thresholds_are_speeds_so_half_the_step_needs_half_the_way():
    half = relations_of(world(0, (0, 0), {"o": (1, 0)}), world(0.5, (0.05, 0), {"o": (1, 0)}))[1]
    assert half.moving and half.qtc["o"] == "-"
    assert not two_steps((0, 0), (0.05, 0), (1, 0)).moving


@pytest.mark.parametrize(
    ("now", "symbol"), [((1, 0), "-"), ((-1, 0), "+"), ((0, 1), "0"), ((0.05, 1), "0"), ((0.1, 1), "-")]
)
def test_trajectory_is_the_displacement_projected_on_the_line_to_where_the_object_was(now, symbol):
    assert two_steps((0, 0), now, (4, 0)).qtc["o"] == symbol


def test_the_textbook_variant_compares_distances_instead():
    sideways = two_steps((0, 0), (0, 1), (1, 0), settings=PerceptionSettings(qtc="distance"))
    assert sideways.qtc["o"] == "+"
    assert two_steps((0, 0), (0, 1), (1, 0)).qtc["o"] == "0"


def test_who_was_where_the_object_was_has_trajectory_zero():
    assert two_steps((1, 1), (2, 2), (1, 1)).qtc["o"] == "0"


def test_the_motion_of_the_object_does_not_enter_the_agents_symbol():
    moved = relations_of(world(0, (0, 0), {"o": (2, 0)}), world(1, (1, 0), {"o": (-5, 0)}))[1]
    assert moved.qtc["o"] == "-"


@given(point, point, point)
def test_who_stands_still_has_trajectory_zero_to_everything(before, now, target):
    relations = two_steps(before, now, target)
    assert relations.moving or relations.qtc["o"] == "0"


@given(point, st.floats(0.2, 2), st.floats(2.5, 5), angle)
def test_walking_straight_back_reverses_the_symbol(start, way, distance, direction):
    ux, uy = math.cos(direction), math.sin(direction)
    there = (start[0] + way * ux, start[1] + way * uy)
    target = (start[0] + distance * ux, start[1] + distance * uy)
    assert two_steps(start, there, target).qtc["o"] == "-"
    assert two_steps(there, start, target).qtc["o"] == "+"


@given(point, point, point, angle, angle, point)
def test_relations_do_not_change_when_the_room_is_turned_and_shifted(before, now, target, heading, turn, shift):
    def moved(p):
        c, s = math.cos(turn), math.sin(turn)
        return (p[0] * c - p[1] * s + shift[0], p[0] * s + p[1] * c + shift[1])

    here = relations_of(world(0, before, {"o": target}), world(1, now, {"o": target}, heading))[1]
    there = relations_of(
        world(0, moved(before), {"o": moved(target)}), world(1, moved(now), {"o": moved(target)}, heading + turn)
    )[1]
    # rounding may tip what lies exactly on a threshold
    distance, displacement = math.dist(now, target), math.dist(before, now)
    assume(min(abs(distance - end) for _, end in PerceptionSettings().bands) > 1e-6 and abs(displacement - 0.09) > 1e-6)
    assume(math.dist(before, target) > 1e-3 and distance > 1e-3)
    along = sum((n - b) * (o - b) for n, b, o in zip(now, before, target, strict=True)) / math.dist(before, target)
    assume(abs(abs(along) - 0.09) > 1e-6)
    assert (here.qdc, here.qtc, here.moving) == (there.qdc, there.qtc, there.moving)
    assert here.angle["o"] == pytest.approx(there.angle["o"], abs=1e-5)


def test_hysteresis_keeps_one_moving_through_a_slower_step():
    at = [world(t, (x, 0)) for t, x in enumerate((0, 0.2, 0.28, 0.35, 0.42, 0.53))]
    seen = [r.moving for r in relations_of(*at, settings=PerceptionSettings(moving_margin=0.015))]
    assert seen == [None, True, True, False, False, True]


# --- angle and hand


@given(point, point, angle)
def test_the_angle_lies_between_zero_and_a_half_turn(agent, target, heading):
    seen = relations_of(world(0, agent, {"o": target}, heading))[0].angle["o"]
    assert 0.0 <= seen <= math.pi


def test_the_angle_is_the_one_between_heading_and_line():
    seen = relations_of(world(0, (0, 0), {"ahead": (0, 2), "left": (-1, 0), "back": (0, -1)}, math.pi / 2))[0].angle
    assert seen == pytest.approx({"ahead": 0, "left": math.pi / 2, "back": math.pi})


def test_a_held_object_is_where_its_holder_is():
    carried = relations_of(world(0, (0, 0), {"cup": (0.4, 0)}), world(1, (1, 0), {"cup": (1.4, 0)}, math.pi, "cup"))[1]
    assert (carried.qdc["cup"], carried.qtc["cup"], carried.angle["cup"]) == ("touch", "0", 0.0)
    assert carried.holding == "cup"


def test_without_snapping_a_carried_object_seems_to_be_approached():
    carried = relations_of(
        world(0, (0, 0), {"cup": (0.4, 0)}, 0, "cup"),
        world(1, (1, 0), {"cup": (1.4, 0)}, 0, "cup"),
        settings=PerceptionSettings(snap_held=False),
    )[1]
    assert carried.qtc["cup"] == "-"


def test_an_object_in_the_hand_counts_as_present_though_unseen():
    assert relations_of(world(0, (0, 0), {}, holding="cup"))[0].qdc == {"cup": "touch"}


# --- what is missing, what is wrong


def test_a_pair_has_a_trajectory_only_when_the_object_was_there_a_step_before():
    both = relations_of(world(0, (0, 0), {"a": (1, 0)}), world(1, (1, 0), {"a": (1, 0), "b": (2, 0)}))[1]
    assert both.qtc == {"a": "-", "b": None}


def test_an_absent_agent_gives_nothing_and_the_step_after_is_a_first_step():
    gone = WorldState(1, {}, {"o": ObjectState(1, 0)})
    first, absent, again = relations_of(world(0, (0, 0), {"o": (1, 0)}), gone, world(2, (1, 0), {"o": (1, 0)}))
    assert absent is None
    assert first is not None and again.moving is None and again.qtc == {"o": None}


@pytest.mark.parametrize("later", [3.0, 2.5])
def test_time_that_does_not_advance_is_an_error_that_names_both_times(later):
    with pytest.raises(WorldStateError, match=f"t={later:g} came after t=3"):
        relations_of(world(3, (0, 0)), world(later, (0, 0)))


@pytest.mark.parametrize("place", [(math.nan, 0), (0, math.inf), (0, 0, math.nan)])
def test_a_coordinate_that_is_not_finite_is_an_error_that_names_object_and_time(place):
    with pytest.raises(WorldStateError, match=r"cup .* t=4"):
        relations_of(world(4, (0, 0), {"cup": place}))


def test_an_agent_that_is_nowhere_is_an_error_that_names_it():
    with pytest.raises(WorldStateError, match=r"human .* t=4"):
        relations_of(world(4, (0, math.nan)))


def test_a_refused_world_state_leaves_no_trace():
    perception = Perception(PerceptionSettings(), "human")
    perception.update(world(0, (0, 0), {"cup": (1, 0)}))
    with pytest.raises(WorldStateError):
        perception.update(world(1, (5, 0), {"cup": (math.nan, 0)}))
    assert perception.update(world(1, (0.5, 0), {"cup": (1, 0)})).qtc == {"cup": "-"}


def test_after_a_reset_time_may_start_again():
    perception = Perception(PerceptionSettings(), "human")
    perception.update(world(5, (0, 0)))
    perception.reset()
    assert perception.update(world(1, (0, 0))).moving is None


# --- settings


def test_the_kitchens_facts_are_the_papers_bands_and_thresholds():
    assert perception_settings(kitchen_rows()) == PerceptionSettings()


def test_bands_are_ordered_by_their_ends_and_end_in_ignore():
    settings = perception_settings(rows_of({("band", 2): [("there", 4), ("here", 1.0)]}))
    assert settings.bands == (("here", 1.0), ("there", 4.0), ("ignore", math.inf))


@pytest.mark.parametrize(
    ("fact", "sentence"),
    [
        (("perception", "speed", 1), "setting.perception, speed, …. is unknown"),
        (("perception", "qtc", "neither"), "projection or distance, not neither"),
        (("perception", "snap_held", 3), "should be true or false"),
        (("perception", "moving_speed", "fast"), "should be a number"),
        (("perception", "moving_speed", -1), "must not be negative"),
    ],
)
def test_a_setting_that_makes_no_sense_is_refused_with_a_sentence(fact, sentence):
    with pytest.raises(DomainError, match=sentence):
        perception_settings(rows_of({("setting", 3): [fact]}))


def test_a_setting_with_two_values_is_refused():
    facts = [("perception", "moving_speed", 0.1), ("perception", "moving_speed", 0.2)]
    with pytest.raises(DomainError, match="two values"):
        perception_settings(rows_of({("setting", 3): facts}))
