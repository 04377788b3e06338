import itertools
import random
from collections import Counter

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from low_level_kitchen import QDC, five_clauses

from casper.engine.movements.clauses import compile_tree
from casper.engine.movements.features import HOLD, MOS, ORDERS, QTC, Features
from casper.engine.movements.movements import MovementClassifier
from casper.engine.movements.tree import Sample, encode, fit, leave_one_trial_out
from casper.kb.base import KnowledgeBase
from casper.kb.errors import DomainError

pytest.importorskip("sklearn")

COMBINATIONS = [Features(*values) for values in itertools.product(MOS, HOLD, QDC, QTC)]
TRUE = {Features(*row[:4]): row[4] for row in five_clauses()}
samples_of_any_kind = st.lists(
    st.builds(
        Sample,
        st.integers(1, 4),
        st.sampled_from(COMBINATIONS),
        st.sampled_from(["still", "walk", "transport", "pick", "place"]),
    ),
    min_size=1,
    max_size=40,
)


def noisy_samples(error, trials=6, each=60, seed=1):
    """Steps of the paper's five clauses, with some labels wrong."""
    source, labels = random.Random(seed), sorted(set(TRUE.values()))
    samples = []
    for trial, _ in itertools.product(range(trials), range(each)):
        seen = source.choice(COMBINATIONS)
        label = source.choice(labels) if source.random() < error else TRUE[seen]
        samples.append(Sample(trial, seen, label))
    return samples


def rows_in(text):
    return list(KnowledgeBase.from_text(text).rows("movement", 5))


def test_five_leaves_learn_the_papers_five_clauses():
    tree = fit(noisy_samples(0.0), max_leaf_nodes=5)
    assert {seen: tree.classify(seen) for seen in COMBINATIONS} == TRUE


@settings(max_examples=25, deadline=None)
@given(samples_of_any_kind, st.integers(2, 12))
def test_the_clauses_say_of_every_combination_what_the_tree_says(samples, leaves):
    from sklearn.tree import DecisionTreeClassifier

    text = compile_tree(fit(samples, leaves, seed=3))
    answers = {Features(*row[:4]): row[4] for row in rows_in(text)}
    alike = sorted(Counter((s.features, s.label) for s in samples).items())
    model = DecisionTreeClassifier(max_leaf_nodes=leaves, random_state=3)
    rows, labels = [encode(each) for (each, _), _ in alike], [label for (_, label), _ in alike]
    model.fit(rows, labels, sample_weight=[count for _, count in alike])
    assert [answers[seen] for seen in COMBINATIONS] == list(model.predict([encode(seen) for seen in COMBINATIONS]))
    assert len(rows_in(text)) == len(COMBINATIONS)


def test_the_clauses_are_a_complete_relation_for_the_classifier():
    rows = rows_in(compile_tree(fit(noisy_samples(0.1))))
    assert MovementClassifier(rows, QDC)


def test_there_is_one_readable_clause_per_leaf():
    tree = fit(noisy_samples(0.0))
    text = compile_tree(tree)
    assert text.count("movement(Mos, Hold, Qdc, Qtc, ") == len(tree.leaves) + 1  # and once in the heading
    assert "Hold = holding" in text and "Mos = moving" in text
    assert "(Qtc = '-' ; Qtc = '0')" in text


def test_all_but_one_value_is_written_as_unequal():
    samples = [Sample(0, seen, "pick" if seen.qdc == "touch" else "still") for seen in COMBINATIONS]
    assert "Qdc = touch" in compile_tree(fit(samples)) and "Qdc \\= touch" in compile_tree(fit(samples))


def test_the_same_samples_in_any_order_give_the_same_bytes():
    samples = noisy_samples(0.3)
    shuffled = random.Random(5).sample(samples, len(samples))
    texts = [compile_tree(fit(s, 8, 2), leave_one_trial_out(s, 8, 2)) for s in (samples, shuffled)]
    assert texts[0] == texts[1]


def test_the_heading_says_from_what_it_was_learned_and_how_well():
    samples = noisy_samples(0.2)
    evaluation = leave_one_trial_out(samples)
    heading = compile_tree(fit(samples), evaluation).split("\n\n")[0]
    assert "360 samples of 6 trials, at most 5 leaves, seed 0" in heading
    assert f"accuracy {evaluation.accuracy:.4f}" in heading
    assert all(line.startswith("%") for line in heading.splitlines())


def test_the_confusion_becomes_emission_facts_that_add_up_to_one():
    samples = noisy_samples(0.2)
    text = compile_tree(fit(samples), leave_one_trial_out(samples))
    rows = list(KnowledgeBase.from_text(text).rows("emission", 3))
    for movement in sorted(set(TRUE.values())):
        assert sum(p for true, _, p in rows if true == movement) == pytest.approx(1, abs=1e-3)
        assert all(p > 0 for true, _, p in rows if true == movement)


def test_leaving_one_trial_out_is_perfect_without_noise_and_counts_every_sample_once():
    samples = noisy_samples(0.0)
    evaluation = leave_one_trial_out(samples)
    assert evaluation.accuracy == 1.0
    assert sum(sum(row.values()) for row in evaluation.confusion.values()) == len(samples)


def test_a_trial_is_judged_by_trees_that_have_not_seen_it():
    holding = [Sample(9, seen, "place") for seen in COMBINATIONS if seen.hold == "holding"]
    others = [Sample(trial, seen, TRUE[seen]) for trial in range(3) for seen in COMBINATIONS if seen.hold == "free"]
    per_trial = leave_one_trial_out(holding + others).per_trial
    assert per_trial == {0: 1.0, 1: 1.0, 2: 1.0, 9: 0.0}


def test_accuracy_is_the_share_of_the_confusions_diagonal():
    evaluation = leave_one_trial_out(noisy_samples(0.25))
    right = sum(evaluation.confusion[label][label] for label in evaluation.labels)
    assert evaluation.accuracy == right / 360 < 0.9


@pytest.mark.parametrize(
    ("samples", "sentence"),
    [([], "no samples"), ([Sample(0, Features("still", "free", "yonder", "0"), "walk")], "yonder is none of touch")],
)
def test_samples_that_cannot_be_learned_from_are_refused(samples, sentence):
    with pytest.raises(DomainError, match=sentence):
        fit(samples)


def test_one_trial_cannot_be_left_out_of_itself():
    with pytest.raises(DomainError, match="at least two trials"):
        leave_one_trial_out(noisy_samples(0.0, trials=1))


def test_every_feature_counts_in_the_order_the_text_lists_its_values():
    assert encode(Features("moving", "free", "far", "ignore")) == [1, 0, 3, 3]
    text = compile_tree(fit(noisy_samples(0.0)))
    for name, order in zip(("mos", "hold", "qdc", "qtc"), ORDERS, strict=True):
        assert [value for (value,) in KnowledgeBase.from_text(text).rows(name, 1)] == list(order)
