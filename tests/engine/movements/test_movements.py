import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st
from low_level_kitchen import QDC, attending, five_clauses, rows_of, seen

from casper.engine.movements.features import HOLD, MOS, QTC, Features, features
from casper.engine.movements.movements import Movement, MovementClassifier, MovementFilter, movement_classifier
from casper.kb.errors import DomainError


def filtered(names, window=3):
    movement_filter = MovementFilter(window)
    kept = [movement_filter.update(Movement(float(t), name)) for t, name in enumerate(names)]
    return [None if movement is None else movement.name for movement in kept]


def test_the_features_are_those_of_the_target():
    relations = seen(3, {"a": "touch", "b": "far"}, qtc={"b": "+"}, moving=True, holding="a")
    assert features(relations, attending(3, "b")) == Features("moving", "holding", "far", "+")


@pytest.mark.parametrize("target", [None, "gone"])
def test_without_a_target_in_sight_distance_and_trajectory_are_ignored(target):
    relations = seen(3, {"a": "touch"})
    assert features(relations, attending(3, target)) == Features("still", "free", "ignore", "ignore")


def test_the_first_step_counts_as_still_and_its_trajectory_is_ignored():
    relations = seen(0, {"a": "near"}, qtc={"a": None}, moving=None)
    assert features(relations, attending(0, "a")) == Features("still", "free", "near", "ignore")


def test_a_movement_is_looked_up_in_the_domains_relation():
    classifier = MovementClassifier(five_clauses(), QDC)
    movement = classifier.update(seen(7, {"a": "touch"}, moving=True, holding="a"), attending(7, "a"))
    assert movement == Movement(7, "transport", Features("moving", "holding", "touch", "0"))


def test_what_is_held_may_be_perceived_differently_from_what_is_attended_to():
    classifier = MovementClassifier(five_clauses(), QDC)
    names = [
        classifier.update(seen(t, {"a": "near"}, moving=moving, holding=holding), attending(t, "a")).name
        for t, (moving, holding) in enumerate(itertools.product([True, False], ["b", None]))
    ]
    assert names == ["transport", "walk", "place", "pick"]


@given(st.sampled_from(list(itertools.product(MOS, HOLD, QDC, QTC))))
def test_a_combination_without_a_movement_is_refused_by_name(combination):
    table = [row for row in five_clauses() if row[:4] != combination]
    with pytest.raises(DomainError) as mistake:
        MovementClassifier(table, QDC)
    assert str(mistake.value) == f"movement has no answer for {', '.join(combination)}"


def test_a_combination_with_two_movements_is_refused():
    with pytest.raises(DomainError, match="still, free, touch, 0 is both pick and place"):
        MovementClassifier([*five_clauses(), ("still", "free", "touch", "0", "place")], QDC)


def test_the_relation_must_answer_for_every_band_of_the_perception():
    rows = rows_of({("movement", 5): five_clauses(), ("band", 2): [("touch", 0.6), ("miles", 900)]})
    with pytest.raises(DomainError, match=r"still, free, miles, - .and 15 more"):
        movement_classifier(rows)


def test_the_filter_is_silent_until_its_window_is_full():
    assert filtered(["walk", "walk", "walk"]) == [None, None, "walk"]


def test_the_filter_lets_changes_through_only_and_drops_a_single_odd_one():
    names = ["walk"] * 3 + ["pick"] + ["walk"] * 2 + ["place"] * 3
    assert filtered(names) == [None, None, "walk", None, None, None, None, "place", None]


def test_of_movements_that_are_equally_common_the_oldest_counts():
    assert filtered(["still", "walk", "pick", "transport", "place"]) == [None, None, "still", "walk", "pick"]


@given(st.lists(st.sampled_from(["still", "walk", "pick"]), max_size=30))
def test_the_filter_never_says_the_same_twice_running_nor_what_it_has_not_seen(names):
    kept = [name for name in filtered(names) if name is not None]
    assert all(one != other for one, other in itertools.pairwise(kept))
    assert set(kept) <= set(names)


def test_after_a_reset_the_filter_waits_again():
    movement_filter = MovementFilter(2)
    for t in range(3):
        movement_filter.update(Movement(t, "walk"))
    movement_filter.reset()
    assert [movement_filter.update(Movement(t, "walk")) is None for t in range(2)] == [True, False]
