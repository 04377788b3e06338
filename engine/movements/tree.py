"""Learning the movements: a decision tree over qualitative features, judged by leaving one trial out.

(Paper, sections Movement Classification and Decision Tree Training.) The features are ordinal: each value counts
by its place in its order (`engine.movements.features`). What is learned is kept as leaves in the features' own words,
so that nothing behind this module needs scikit-learn.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from casper.engine.movements.features import Features, Seen, orders_of
from casper.engine.movements.printing import evaluation_lines, level_lines
from casper.engine.settings import check_seed, require
from casper.kb.text.lines import Line, one_line, text_of

LARGEST_SEED = 2**32 - 1  # that the library behind `fit` takes


@dataclass(frozen=True, slots=True)
class Sample:
    """One step of one trial: what was perceived, and the movement that was made.

    ``level`` is the sensor it was perceived by, such as its noise and its rate, where there are several.
    """

    trial: int
    features: Seen
    label: str
    level: str = ""


@dataclass(frozen=True, slots=True)
class Leaf:
    """The features allowed on the way to it (values of each, in their order), its movement, its samples.

    ``counts`` are the samples of each movement.
    """

    allowed: tuple[tuple[str, ...], ...]
    label: str
    samples: int
    counts: tuple[tuple[str, int], ...] = ()


@dataclass(frozen=True, slots=True)
class MovementTree:
    """A learned tree as its leaves from left to right; every combination of features is in exactly one.

    ``kind`` are the features it tells by, ``totals`` the samples of each movement.
    """

    leaves: tuple[Leaf, ...]
    samples: int
    trials: int
    max_leaf_nodes: int
    seed: int
    kind: type[Seen] = Features
    totals: tuple[tuple[str, int], ...] = ()

    def classify(self, features: Seen) -> str:
        """The movement of these features."""
        return next(
            leaf.label
            for leaf in self.leaves
            if all(value in values for value, values in zip(features, leaf.allowed, strict=True))
        )


@dataclass(frozen=True, slots=True)
class Evaluation:
    """A cross-validation by trial, and by sensor.

    accuracy: share of all samples right. per_trial: the same within each trial. confusion: how often a movement
    (first key) was taken for another (second key); labels: their order. per_level: the share of each sensor's
    samples, a trial left out; unseen: the same where the sensor was left out as well.
    """

    accuracy: float
    per_trial: Mapping[int, float]
    confusion: Mapping[str, Mapping[str, int]]
    labels: tuple[str, ...]
    per_level: Mapping[str, float] = field(default_factory=dict)
    unseen: Mapping[str, float] = field(default_factory=dict)

    def lines(self) -> Iterator[Line]:
        """What a person is shown."""
        yield from evaluation_lines(self.accuracy, self.labels, self.confusion)
        yield from level_lines(self.per_level, self.unseen)

    def __str__(self) -> str:
        return text_of(self.lines())

    def __repr__(self) -> str:
        return one_line(f"Evaluation: accuracy {self.accuracy:.3f} in {len(self.per_trial)} trials")


def check_learning(max_leaf_nodes: int, seed: int, kind: type[Seen] = Features) -> None:
    """Refuse what no tree can be learned with, before anything is worked out.

    Raises:
        DomainError: fewer than two leaves or more than there are combinations of features, or a seed out of range.
    """
    most = math.prod(map(len, orders_of(kind)))
    sentence = f"a movement tree has from 2 to {most} leaves, one for each combination of features at most"
    require(2 <= max_leaf_nodes <= most, f"{sentence}, not {max_leaf_nodes}")
    check_seed(seed)
    require(seed <= LARGEST_SEED, f"a seed to learn with is a whole number from 0 to {LARGEST_SEED}, not {seed}")


def fit(samples: Sequence[Sample], max_leaf_nodes: int = 5, seed: int = 0) -> MovementTree:
    """Learn a tree; the same samples in any order give the same tree.

    Raises:
        DomainError: no samples, a feature value that is in no order, or as `check_learning`.
    """
    from sklearn.tree import DecisionTreeClassifier

    require(bool(samples), "a movement tree cannot be learned from no samples")
    kind = type(samples[0].features)
    check_learning(max_leaf_nodes, seed, kind)
    alike = sorted(Counter((s.features, s.label) for s in samples).items())  # few: features are qualitative
    rows = [encode(seen) for (seen, _), _ in alike]
    model = DecisionTreeClassifier(max_leaf_nodes=max_leaf_nodes, random_state=seed)
    model.fit(rows, [label for (_, label), _ in alike], sample_weight=[count for _, count in alike])
    counts: dict[int, Counter[str]] = {}
    for leaf, ((_, label), count) in zip(model.apply(rows).tolist(), alike):
        counts.setdefault(leaf, Counter())[label] += count
    totals = tuple(sorted(Counter(s.label for s in samples).items()))
    leaves = tuple(_leaves(model, 0, orders_of(kind), orders_of(kind), counts))
    return MovementTree(leaves, len(samples), len({s.trial for s in samples}), max_leaf_nodes, seed, kind, totals)


def leave_one_trial_out(samples: Sequence[Sample], max_leaf_nodes: int = 5, seed: int = 0) -> Evaluation:
    """Each trial judged by a tree learned from all the others; of several sensors, also from other sensors only.

    Raises:
        DomainError: fewer than two trials, or as ``fit``.
    """
    trials = sorted({s.trial for s in samples})
    require(len(trials) >= 2, "leaving one trial out needs at least two trials")
    confusion: Counter[tuple[str, str]] = Counter()
    per_trial = {}
    right_of: Counter[str] = Counter()
    for trial in trials:
        judged = _judged(samples, max_leaf_nodes, seed, trial)
        confusion.update((sample.label, seen) for sample, seen in judged)
        right_of.update(sample.level for sample, seen in judged if sample.label == seen)
        per_trial[trial] = sum(sample.label == seen for sample, seen in judged) / len(judged)
    labels = tuple(sorted({s.label for s in samples}))
    right = sum(confusion[label, label] for label in labels)
    table = {true: {seen: confusion[true, seen] for seen in labels} for true in labels}
    all_of = Counter(s.level for s in samples)
    per_level = {level: right_of[level] / count for level, count in sorted(all_of.items())} if len(all_of) > 1 else {}
    shares = {level: _unseen(samples, max_leaf_nodes, seed, level) for level in per_level}
    unseen = {level: share for level, share in shares.items() if share is not None}
    return Evaluation(right / len(samples), per_trial, table, labels, per_level, unseen)


FOLDS = 5  # groups of trials of which one is left out with a sensor


def _unseen(samples: Sequence[Sample], max_leaf_nodes: int, seed: int, level: str) -> float | None:
    """The share right of one sensor's samples, learned from other sensors and other trials; None: there are none."""
    trials = sorted({s.trial for s in samples})
    judged = []
    for fold in range(min(FOLDS, len(trials))):
        group = set(trials[fold::FOLDS])
        asked = [s for s in samples if s.level == level and s.trial in group]
        others = [s for s in samples if s.level != level and s.trial not in group]
        if asked and others:
            judged += _answers(fit(others, max_leaf_nodes, seed), asked)
    return sum(sample.label == seen for sample, seen in judged) / len(judged) if judged else None


def _judged(samples: Sequence[Sample], max_leaf_nodes: int, seed: int, trial: int) -> list[tuple[Sample, str]]:
    tree = fit([s for s in samples if s.trial != trial], max_leaf_nodes, seed)
    return _answers(tree, [s for s in samples if s.trial == trial])


def _answers(tree: MovementTree, samples: Sequence[Sample]) -> list[tuple[Sample, str]]:
    known = {seen: tree.classify(seen) for seen in {s.features for s in samples}}
    return [(sample, known[sample.features]) for sample in samples]


def encode(features: Seen) -> list[int]:
    """The features as places in their orders.

    Raises:
        DomainError: a value that is in no order; the sentence names it.
    """
    orders = orders_of(type(features))
    for value, order in zip(features, orders, strict=True):
        require(value in order, f"the feature {value} is none of {', '.join(order)}")
    return [order.index(value) for value, order in zip(features, orders, strict=True)]


def _leaves(
    model: Any,
    node: int,
    allowed: tuple[tuple[str, ...], ...],
    orders: tuple[tuple[str, ...], ...],
    counts: Mapping[int, Counter[str]],
) -> list[Leaf]:
    tree = model.tree_
    left, right = int(tree.children_left[node]), int(tree.children_right[node])
    if left == right:
        label = str(model.classes_[tree.value[node][0].argmax()])
        return [Leaf(allowed, label, counts[node].total(), tuple(sorted(counts[node].items())))]
    feature, threshold = int(tree.feature[node]), float(tree.threshold[node])
    order = orders[feature]
    low = tuple(value for value in allowed[feature] if order.index(value) <= threshold)
    high = tuple(value for value in allowed[feature] if order.index(value) > threshold)
    return [
        *_leaves(model, left, (*allowed[:feature], low, *allowed[feature + 1 :]), orders, counts),
        *_leaves(model, right, (*allowed[:feature], high, *allowed[feature + 1 :]), orders, counts),
    ]
