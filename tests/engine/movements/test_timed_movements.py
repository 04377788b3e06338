"""Movements that are told by what went before: features of the past alone, leaves as clauses, likelihoods."""

import itertools
import math
import random
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from low_level_kitchen import attending, rows_of, seen

from casper.engine.movements.clauses import compile_tree, leaf_likelihoods
from casper.engine.movements.features import TIMED_ORDERS, Timed, TimedFeatures, features
from casper.engine.movements.leaves import TIMED, boxes_of, check_boxes
from casper.engine.movements.movements import TimedClassifier, movement_classifier
from casper.engine.movements.tree import Sample, encode, fit, leave_one_trial_out
from casper.engine.perception.world import Doubt
from casper.kb.base import KnowledgeBase
from casper.kb.errors import DomainError

LABELS = ("pick", "place", "still", "transport", "walk")
timed_features = st.tuples(*map(st.sampled_from, TIMED_ORDERS)).map(lambda values: TimedFeatures(*values))
samples_of_any_kind = st.lists(
    st.builds(Sample, st.integers(1, 3), timed_features, st.sampled_from(LABELS), st.sampled_from(["a", "b"])),
    min_size=2,
    max_size=40,
)


def told(steps, dt=0.5):
    """The timed features of steps of (moving, what is held)."""
    timed, found = Timed(), []
    for at, (moving, held) in enumerate(steps):
        relations = seen(at * dt, {"a": "touch"}, qtc={"a": "0"}, moving=moving, holding=held)
        found.append(timed.update(relations, attending(at * dt, "a")))
    return found


def base_of(text):
    return KnowledgeBase.from_text(text)


def classifier_of(text):
    kb = base_of(text)
    return boxes_of(kb.clauses_of(TIMED), kb.rows("likelihood", 3))


def test_the_papers_features_come_first():
    relations = seen(3, {"a": "near"}, qtc={"a": "+"}, moving=True)
    assert Timed().update(relations, attending(3, "a"))[:4] == features(relations, attending(3, "a"))


def test_what_is_taken_is_in_the_hand_for_a_moment_and_then_for_longer():
    held = [each.held for each in told([(False, None)] * 3 + [(False, "a")] * 10)]
    assert held[3:] == ["brief", "short", "while", "while", *["long"] * 4, *["longer"] * 2]


def test_what_is_taken_and_walked_with_has_been_carried_until_the_hand_changes():
    steps = [(True, None)] * 4 + [(False, "a")] * 2 + [(True, "a")] * 3 + [(False, "a")] * 2 + [(False, None)]
    assert [each.carried for each in told(steps)][4:] == ["no"] * 3 + ["yes"] * 4 + ["no"]


def test_an_unsure_eye_is_told_from_a_plain_one():
    relations = seen(3, {"a": "touch"}, moving=False)
    doubts = (None, *(Doubt(grasp=g, moves=0.0, spread=0.0) for g in (0.1, 0.6, 0.9)))
    unsure = [Timed().update(replace(relations, doubt=doubt), attending(3, "a")) for doubt in doubts]
    assert [(each.eye, each.grasp) for each in unsure] == [
        ("plain", "none"), ("filtered", "none"), ("filtered", "strong"), ("filtered", "sure"),
    ]  # fmt: skip


@given(st.lists(st.tuples(st.booleans(), st.sampled_from([None, "a"])), min_size=1, max_size=25), st.integers(1, 24))
def test_no_feature_knows_what_comes_later(steps, cut):
    assert told(steps[:cut]) == told(steps)[: min(cut, len(steps))]


@settings(max_examples=25, deadline=None)
@given(samples_of_any_kind, st.integers(2, 12), st.lists(timed_features, max_size=30))
def test_the_clauses_say_what_the_tree_says(samples, leaves, asked):
    pytest.importorskip("sklearn")
    tree = fit(samples, leaves, seed=3)
    boxes = classifier_of(compile_tree(tree))
    check_boxes(boxes)
    for each in (*asked, *(sample.features for sample in samples)):
        (box,) = [box for box in boxes if box.has(each)]
        assert box.label == tree.classify(each)


def test_the_clauses_can_be_asked_like_any_relation():
    pytest.importorskip("sklearn")
    texts = compile_tree(fit(learnable(), 5))
    question = "movement(still, holding, touch, '0', sure, brief, no, brief, plain, M)"
    assert [row["M"] for row in base_of(texts).query(question)] == ["pick"]


def learnable(wrong=0.0, levels=("",), trials=3):
    """Who has just taken it is still picking, who has held it for longer is placing; elsewhere by motion and hand."""
    source, found = random.Random(2), []
    for trial, level, values in itertools.product(range(trials), levels, itertools.product(*TIMED_ORDERS[:2], ["touch"], ["0"], ["sure"], TIMED_ORDERS[5], ["no"], ["brief"], ["plain"])):
        each = TimedFeatures(*values)
        label = {("moving", "free"): "walk", ("moving", "holding"): "transport", ("still", "free"): "pick"}.get(each[:2])
        label = label or ("pick" if each.held in ("brief", "short") else "place")
        found.append(Sample(trial, each, source.choice(LABELS) if source.random() < wrong else label, level))
    return found


def test_likelihoods_of_a_leaf_weigh_each_movement_by_how_often_it_is_made():
    pytest.importorskip("sklearn")
    tree = fit(learnable(0.3), 4)
    for leaf in tree.leaves:
        shares = leaf_likelihoods(leaf, dict(tree.totals))
        assert sum(shares.values()) == pytest.approx(1) and min(shares.values()) > 0
    kb = base_of(compile_tree(tree))
    assert {box.likelihoods.keys() == set(LABELS) for box in boxes_of(kb.clauses_of(TIMED), kb.rows("likelihood", 3))} == {True}


def test_a_movement_of_learned_leaves_has_likelihoods_and_shares_where_the_eye_is_unsure():
    pytest.importorskip("sklearn")
    kb = base_of(compile_tree(fit(learnable(0.2), 5)))
    relations = seen(3, {"a": "touch"}, moving=False, holding="a")
    classifier = movement_classifier(kb.rows, kb.clauses_of(TIMED))
    movement = classifier.update(relations, attending(3, "a"))
    assert movement.name == "pick" and movement.shares is None and sum(movement.likelihoods.values()) == pytest.approx(1, abs=0.01)
    unsure = replace(relations, doubt=Doubt(grasp=0.7, moves=0.0, spread=0.0))
    assert TimedClassifier(classifier._boxes).update(unsure, attending(3, "a")).shares is not None


def test_each_sensor_has_an_accuracy_also_where_nothing_was_learned_from_it():
    pytest.importorskip("sklearn")
    evaluation = leave_one_trial_out(learnable(0.0, ("1 cm", "6 cm")), 5)
    assert evaluation.per_level == {"1 cm": 1.0, "6 cm": 1.0} == evaluation.unseen
    assert "learned without it" in str(evaluation) and "6 cm" in compile_tree(fit(learnable(), 5), evaluation)
    assert leave_one_trial_out(learnable(), 5).per_level == {}


def test_a_sensor_that_is_left_out_teaches_nothing():
    pytest.importorskip("sklearn")
    good = learnable(0.0, ("good",))
    other = [Sample(s.trial, s.features, "still", "odd") for s in good]
    unseen = leave_one_trial_out(good + other, 8).unseen
    assert unseen == {"good": 0.0, "odd": 0.0}


EVERY = "movement(_, _, _, _, _, _, _, _, _, walk)."


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("movement(still, _, _, _, _, _, _, _, _, pick).", r"no answer for 16000 of 32000 combinations"),
        (f"{EVERY} movement(still, _, _, _, _, _, _, _, _, pick).", "is both walk and pick"),
        (f"{EVERY} movement(still, _, _, _, _, _, _, _, _, walk).", "with walk have features in common"),
        ("movement(_, _, yonder, _, _, _, _, _, _, walk).", "yonder is none of touch"),
        ("movement(A, _, _, _, _, _, _, _, _, walk) :- near(A). near(x).", "a condition lists values of a feature"),
        (f"{EVERY} likelihood(2, walk, 0.5).", "is of no clause"),
        (f"{EVERY} likelihood(1, walk, 0).", "a likelihood is above 0"),
    ],
)
def test_clauses_that_are_no_boxes_are_refused(text, sentence):
    with pytest.raises(DomainError, match=sentence):
        check_boxes(classifier_of(text))


def test_clauses_need_the_bands_they_were_learned_with():
    with pytest.raises(DomainError, match="use movement/5 with others"):
        movement_classifier(rows_of({("band", 2): [("arm", 1.0)]}), base_of(EVERY).clauses_of(TIMED))


def test_every_combination_is_counted():
    assert math.prod(map(len, TIMED_ORDERS)) == 32000
    assert encode(TimedFeatures(*(order[-1] for order in TIMED_ORDERS))) == [len(order) - 1 for order in TIMED_ORDERS]
