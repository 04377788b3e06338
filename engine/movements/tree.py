"""Learning the movements: a decision tree over qualitative features, judged by leaving one trial out.

(Paper, sections Movement Classification and Decision Tree Training.) The features are ordinal: each value counts
by its place in ``ORDERS``. What is learned is kept as leaves in the features' own words, so that nothing behind
this module needs scikit-learn.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from casper.engine.movements.movements import HOLD, MOS, QTC, Features
from casper.engine.movements.printing import evaluation_lines
from casper.engine.settings import check_seed, require
from casper.kb.text.lines import Line, one_line, text_of

QDC = ("touch", "near", "medium", "far", "ignore")
ORDERS: tuple[tuple[str, ...], ...] = (MOS, HOLD, QDC, QTC)
"""The values of each feature in the order they count in: still 0, moving 1; free 0, holding 1; touch 0 …"""

MOST_LEAVES = math.prod(map(len, ORDERS))
LARGEST_SEED = 2**32 - 1  # that the library behind `fit` takes


@dataclass(frozen=True, slots=True)
class Sample:
    """One step of one trial: what was perceived, and the movement its script was making."""

    trial: int
    features: Features
    label: str


@dataclass(frozen=True, slots=True)
class Leaf:
    """The features allowed on the way to it (values of each, in their order), its movement, its samples."""

    allowed: tuple[tuple[str, ...], ...]
    label: str
    samples: int


@dataclass(frozen=True, slots=True)
class MovementTree:
    """A learned tree as its leaves from left to right; every combination of features is in exactly one."""

    leaves: tuple[Leaf, ...]
    samples: int
    trials: int
    max_leaf_nodes: int
    seed: int

    def classify(self, features: Features) -> str:
        """The movement of these features."""
        return next(
            leaf.label
            for leaf in self.leaves
            if all(value in values for value, values in zip(features, leaf.allowed, strict=True))
        )


@dataclass(frozen=True, slots=True)
class Evaluation:
    """A cross-validation by trial.

    accuracy: share of all samples right. per_trial: the same within each trial. confusion: how often a movement
    (first key) was taken for another (second key); labels: their order.
    """

    accuracy: float
    per_trial: Mapping[int, float]
    confusion: Mapping[str, Mapping[str, int]]
    labels: tuple[str, ...]

    def lines(self) -> Iterator[Line]:
        """What a person is shown."""
        return evaluation_lines(self.accuracy, self.labels, self.confusion)

    def __str__(self) -> str:
        return text_of(self.lines())

    def __repr__(self) -> str:
        return one_line(f"Evaluation: accuracy {self.accuracy:.3f} in {len(self.per_trial)} trials")


def check_learning(max_leaf_nodes: int, seed: int) -> None:
    """Refuse what no tree can be learned with, before anything is worked out.

    Raises:
        DomainError: fewer than two leaves or more than there are combinations of features, or a seed out of range.
    """
    sentence = f"a movement tree has from 2 to {MOST_LEAVES} leaves, one for each combination of features at most"
    require(2 <= max_leaf_nodes <= MOST_LEAVES, f"{sentence}, not {max_leaf_nodes}")
    check_seed(seed)
    require(seed <= LARGEST_SEED, f"a seed to learn with is a whole number from 0 to {LARGEST_SEED}, not {seed}")


def fit(samples: Sequence[Sample], max_leaf_nodes: int = 5, seed: int = 0) -> MovementTree:
    """Learn a tree; the same samples in any order give the same tree.

    Raises:
        DomainError: no samples, a feature value that is in no order, or as `check_learning`.
    """
    from sklearn.tree import DecisionTreeClassifier

    require(bool(samples), "a movement tree cannot be learned from no samples")
    check_learning(max_leaf_nodes, seed)
    ordered = sorted(samples, key=lambda s: (s.trial, s.features, s.label))
    model = DecisionTreeClassifier(max_leaf_nodes=max_leaf_nodes, random_state=seed)
    model.fit([encode(s.features) for s in ordered], [s.label for s in ordered])
    trials = len({s.trial for s in samples})
    return MovementTree(tuple(_leaves(model, 0, ORDERS)), len(samples), trials, max_leaf_nodes, seed)


def leave_one_trial_out(samples: Sequence[Sample], max_leaf_nodes: int = 5, seed: int = 0) -> Evaluation:
    """Each trial judged by a tree learned from all the others.

    Raises:
        DomainError: fewer than two trials, or as ``fit``.
    """
    trials = sorted({s.trial for s in samples})
    require(len(trials) >= 2, "leaving one trial out needs at least two trials")
    confusion: Counter[tuple[str, str]] = Counter()
    per_trial = {}
    for trial in trials:
        tree = fit([s for s in samples if s.trial != trial], max_leaf_nodes, seed)
        judged = [(s.label, tree.classify(s.features)) for s in samples if s.trial == trial]
        confusion.update(judged)
        per_trial[trial] = sum(true == seen for true, seen in judged) / len(judged)
    labels = tuple(sorted({s.label for s in samples}))
    right = sum(confusion[label, label] for label in labels)
    table = {true: {seen: confusion[true, seen] for seen in labels} for true in labels}
    return Evaluation(right / len(samples), per_trial, table, labels)


def encode(features: Features) -> list[int]:
    """The features as places in their orders.

    Raises:
        DomainError: a value that is in no order; the sentence names it.
    """
    for value, order in zip(features, ORDERS, strict=True):
        require(value in order, f"the feature {value} is none of {', '.join(order)}")
    return [order.index(value) for value, order in zip(features, ORDERS, strict=True)]


def _leaves(model: Any, node: int, allowed: tuple[tuple[str, ...], ...]) -> list[Leaf]:
    tree = model.tree_
    left, right = int(tree.children_left[node]), int(tree.children_right[node])
    if left == right:
        label = str(model.classes_[tree.value[node][0].argmax()])
        return [Leaf(allowed, label, int(tree.n_node_samples[node]))]
    feature, threshold = int(tree.feature[node]), float(tree.threshold[node])
    order = ORDERS[feature]
    low = tuple(value for value in allowed[feature] if order.index(value) <= threshold)
    high = tuple(value for value in allowed[feature] if order.index(value) > threshold)
    return [
        *_leaves(model, left, (*allowed[:feature], low, *allowed[feature + 1 :])),
        *_leaves(model, right, (*allowed[:feature], high, *allowed[feature + 1 :])),
    ]
