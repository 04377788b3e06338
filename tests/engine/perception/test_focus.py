import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from low_level_kitchen import QDC, kitchen_rows, rows_of, seen

from casper.engine.perception.focus import FocusEstimator, FocusSettings, focus_settings
from casper.kb.errors import DomainError

WHOLE_DEGREES = FocusSettings(angle_resolution=1.0)


def focuses(*relations, settings=WHOLE_DEGREES):
    estimator = FocusEstimator(settings)
    return [estimator.update(r) for r in relations]


def repeated(n, qdc, **kwargs):
    return [seen(t, qdc, **kwargs) for t in range(n)]


# --- scores


def test_the_score_is_the_papers_equation_normalised():
    relations = seen(0, {"a": "near", "b": "touch"}, qtc={"a": "-", "b": "+"}, angle={"b": math.radians(9)})
    a, b = 0.8 * 0.25 + 0.2 * 0.25, 0.8 * 0.5 / 10
    assert focuses(relations)[0].scores == pytest.approx({"a": a / (a + b), "b": b / (a + b)})


def test_the_angle_may_be_taken_in_radians():
    relations = seen(0, {"a": "touch", "b": "touch"}, angle={"b": math.pi / 2})
    scores = focuses(relations, settings=FocusSettings(angle_unit="radians"))[0].scores
    assert scores["a"] / scores["b"] == pytest.approx(1 + math.pi / 2)


def test_without_a_trajectory_the_distance_alone_counts():
    relations = seen(0, {"a": "touch", "b": "near"}, qtc={"a": None, "b": None})
    assert focuses(relations)[0].scores == pytest.approx({"a": 2 / 3, "b": 1 / 3})


def test_what_is_to_be_ignored_scores_nothing():
    assert focuses(seen(0, {"a": "ignore"}, qtc={"a": "+"}))[0].scores == {"a": 0.0}


labels = st.sampled_from(QDC)
things = st.dictionaries(
    st.sampled_from("abcde"), st.tuples(labels, st.sampled_from(["-", "0", "+", None]), st.floats(0, math.pi))
)


@given(st.lists(things, max_size=12))
def test_scores_add_up_to_one_or_are_all_zero_and_a_destination_is_never_the_target(steps):
    estimator = FocusEstimator(FocusSettings())
    for t, step in enumerate(steps):
        qdc = {name: values[0] for name, values in step.items()}
        qtc = {name: values[1] for name, values in step.items()}
        focus = estimator.update(seen(t, qdc, qtc, {name: values[2] for name, values in step.items()}))
        assert sum(focus.scores.values()) == pytest.approx(1) or not any(focus.scores.values())
        assert all(score >= 0 for score in focus.scores.values())
        assert focus.target is not None or focus.destination is None
        assert focus.destination is None or focus.destination != focus.target


def test_a_coarse_angle_makes_two_things_in_one_place_tie_exactly():
    relations = seen(0, {"a": "touch", "b": "touch"}, angle={"a": math.radians(1.2), "b": math.radians(2.9)})
    fine, coarse = (focuses(relations, settings=FocusSettings(angle_resolution=step))[0].scores for step in (1.0, 10.0))
    assert fine["a"] > fine["b"]
    assert coarse["a"] == coarse["b"]


# --- target


def test_a_target_needs_three_of_four_steps():
    targets = [f.target for f in focuses(*repeated(3, {"a": "touch"}))]
    assert targets == [None, None, "a"]


def test_a_step_without_a_clear_best_is_an_empty_vote():
    unclear = {"a": "touch"} | {name: "near" for name in "bcdefgh"}
    steps = [{"a": "touch"}, unclear, {"a": "touch"}, {"a": "touch"}]
    assert [f.target for f in focuses(*(seen(t, qdc) for t, qdc in enumerate(steps)))] == [None, None, None, "a"]


def test_a_share_below_the_threshold_elects_nobody():
    crowd = {"a": "touch"} | {name: "near" for name in "bcdefgh"}
    assert focuses(*repeated(6, crowd))[-1].target is None


def test_a_target_stays_until_another_wins():
    steps = [{"a": "touch", "b": "far"}] * 3 + [{"a": "far", "b": "touch"}] * 3 + [{"c": "ignore"}] * 3
    qtc = {"a": "+", "b": "+", "c": "+"}
    found = [f.target for f in focuses(*(seen(t, qdc, {n: qtc[n] for n in qdc}) for t, qdc in enumerate(steps)))]
    assert found == [None, None, "a", "a", "a", "b", "b", "b", "b"]


# --- destination


def test_the_second_best_becomes_the_destination_when_it_is_worth_something():
    both = focuses(*repeated(6, {"a": "touch", "b": "near", "c": "far"}, qtc={"c": "+"}))
    assert [(f.target, f.destination) for f in both][-1] == ("a", "b")
    assert [f.destination for f in both][:5] == [None] * 4 + ["b"]


def test_a_second_best_with_a_twentieth_or_less_is_no_destination():
    far = {"angle": {"b": math.radians(60)}}
    assert focuses(*repeated(9, {"a": "touch", "b": "near"}, **far))[-1].destination is None


def test_when_the_destination_becomes_the_target_it_is_no_longer_the_destination():
    steps = repeated(5, {"a": "touch", "b": "near"}) + [seen(t, {"a": "near", "b": "touch"}) for t in range(5, 8)]
    slow_to_forget = FocusSettings(destination_window=9)
    assert all(f.destination != f.target for f in focuses(*steps, settings=slow_to_forget)[2:])
    assert focuses(*steps, settings=slow_to_forget)[-1].target == "b"


def test_a_destination_stays_while_it_has_the_votes_though_another_has_more():
    second = [("b",)] * 5 + [("b", "c")] * 3 + [("c",)] * 2 + [("c",)]
    steps = [seen(t, {"a": "touch"} | {name: "near" for name in names}) for t, names in enumerate(second)]
    assert [f.destination for f in focuses(*steps)][-3:] == ["b", "b", "c"]


# --- ties


def test_of_two_equal_best_the_target_stays_target_and_the_other_is_the_destination():
    steps = repeated(3, {"b": "touch", "a": "near"}) + [seen(t, {"a": "touch", "b": "touch"}) for t in range(3, 9)]
    assert (focuses(*steps)[-1].target, focuses(*steps)[-1].destination) == ("b", "a")


def test_without_a_target_two_equal_best_both_stand_for_it():
    last = focuses(*repeated(6, {"b": "touch", "a": "touch"}))[-1]
    assert (last.target, last.destination) == ("a", "b")


def test_three_equal_best_keep_the_target_and_stand_for_the_destination():
    steps = repeated(3, {"c": "touch"}) + [seen(t, {name: "touch" for name in "abc"}) for t in range(3, 9)]
    last = focuses(*steps)[-1]
    assert last.target == "c" and last.destination in ("a", "b")


def test_three_equal_best_none_of_which_is_the_target_all_stand_for_it():
    steps = repeated(3, {"d": "touch"}) + [seen(t, {name: "touch" for name in "abc"} | {"d": "far"}) for t in range(3, 9)]
    last = focuses(*steps)[-1]
    assert last.target == "a" and last.destination in ("b", "c")


def test_a_place_that_was_passed_by_is_attended_to_no_more():
    taken = repeated(3, {"cup": "touch"})
    passing = [seen(t, {"cup": "touch", "mat": "touch", "tray": "medium"}) for t in range(3, 8)]
    behind = {"angle": {"mat": math.pi}}
    arrived = [seen(t, {"cup": "touch", "mat": "near", "tray": "touch"}, **behind) for t in range(8, 13)]
    told = focuses(*taken, *passing, *arrived)
    assert [(f.destination, f.attended) for f in told[7:]] == [
        ("mat", ("mat",)),
        *[("mat", ())] * 2,
        *[("tray", ("tray",))] * 3,
    ]


def test_of_two_places_where_one_lies_on_the_other_both_are_attended_to():
    together = [seen(t, {"cup": "touch", "bowl": "touch", "mat": "touch"}) for t in range(3, 9)]
    told = focuses(*repeated(3, {"cup": "touch"}), *together)
    assert set(told[-1].attended) == {"bowl", "mat"}


def test_a_tie_tolerance_makes_nearly_equal_scores_equal():
    close = {"angle": {"b": math.radians(1)}}
    steps = repeated(3, {"b": "touch"}) + [seen(t, {"a": "touch", "b": "touch"}, **close) for t in range(3, 9)]
    assert focuses(*steps)[-1].target == "a"
    assert focuses(*steps, settings=FocusSettings(angle_resolution=1.0, tie_tolerance=0.6))[-1].target == "b"


def test_after_a_reset_nobody_is_attended_to():
    estimator = FocusEstimator(FocusSettings())
    for relations in repeated(5, {"a": "touch"}):
        estimator.update(relations)
    estimator.reset()
    assert estimator.update(seen(9, {"a": "touch"})).target is None


# --- settings


def test_the_kitchens_facts_are_the_papers_encodings_and_the_published_weights():
    kitchen, default = focus_settings(kitchen_rows()), FocusSettings()
    assert (kitchen.qdc, kitchen.qtc) == (default.qdc, default.qtc)
    assert (kitchen.w_qdc, kitchen.w_qtc, kitchen.threshold) == (0.8, 0.2, 0.45)


@pytest.mark.parametrize(
    ("facts", "sentence"),
    [
        ({("encoding", 3): [("rcc", "ec", 1)]}, "only qdc and qtc"),
        ({("setting", 3): [("focus", "angle_unit", "gradians")]}, "degrees or radians"),
        ({("setting", 3): [("focus", "target_votes", 9)]}, "target_votes lies between"),
        ({("setting", 3): [("focus", "target_votes", 2.5)]}, "whole number"),
    ],
)
def test_a_setting_that_makes_no_sense_is_refused_with_a_sentence(facts, sentence):
    with pytest.raises(DomainError, match=sentence):
        focus_settings(rows_of(facts))


STEPS = st.lists(
    st.tuples(*[st.sampled_from(QDC)] * 2, st.sampled_from("-0+"), st.sampled_from((0.0, 0.01, 0.5)), st.booleans()),
    min_size=1,
    max_size=12,
)


@given(STEPS, st.sampled_from((0.0, 10.0)))
def test_scores_are_those_of_the_step_alone_whatever_came_before(steps, resolution):
    settings = FocusSettings(angle_resolution=resolution)
    relations = []
    for t, (one, other, symbol, angle, turned) in enumerate(steps):
        names = ("b", "a") if turned else ("a", "b")
        relations.append(seen(t, dict(zip(names, (one, other))), qtc={"a": symbol}, angle={"b": angle}))
    for each, focus in zip(relations, focuses(*relations, settings=settings)):
        alone = focuses(each, settings=settings)[0].scores
        assert list(focus.scores.items()) == list(alone.items())
