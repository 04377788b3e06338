"""Movements: features of the target, looked up in the domain's relation (paper, Movement Classification)."""

from __future__ import annotations

import itertools
import math
from collections import deque
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from casper.engine.events.records import setters
from casper.engine.movements.features import (
    HOLD,
    MOS,
    NOT_PERCEIVED,
    QDC,
    QTC,
    Features,
    Seen,
    Timed,
    TimedFeatures,
    features,
)
from casper.engine.movements.leaves import Box, boxes_of, check_boxes
from casper.engine.perception.focus import Focus
from casper.engine.perception.perception import Relations, perception_settings
from casper.engine.perception.world import Doubt
from casper.engine.settings import Rows, require
from casper.kb.errors import DomainError
from casper.kb.terms.clauses import Clause

NEGLIGIBLE = 1e-3  # share of a label that is not followed up


@dataclass(frozen=True, slots=True, init=False)
class Movement:
    """The movement of one moment, and what it was told by.

    ``shares`` are the weights of all it may have been, where that is not sure; they add up to 1. ``likelihoods`` are
    how likely what was perceived is for each movement, up to a factor, where that was learned.
    """

    t: float
    name: str
    features: Seen = NOT_PERCEIVED
    shares: Mapping[str, float] | None = None
    likelihoods: Mapping[str, float] | None = None

    def __init__(
        self,
        t: float,
        name: str,
        features: Seen = NOT_PERCEIVED,
        shares: Mapping[str, float] | None = None,
        likelihoods: Mapping[str, float] | None = None,
    ) -> None:
        _t(self, t)
        _name(self, name)
        _features(self, features)
        _shares(self, shares)
        _likelihoods(self, likelihoods)


_t, _name, _features, _shares, _likelihoods = setters(Movement)


class MovementClassifier:
    """The domain's relation ``movement(Mos, Hold, Qdc, Qtc, Movement)`` as a table.

    Raises:
        DomainError: at construction, when a combination of features has no movement, or two.
    """

    def __init__(
        self,
        table: Iterable[Sequence[str]],
        qdc_labels: Iterable[str],
        bands: Sequence[tuple[str, float]] = (),
    ) -> None:
        self._bands = bands
        self._table: dict[Features, str] = {}
        for *values, name in table:
            key = Features(*values)
            if self._table.setdefault(key, name) != name:
                raise DomainError(f"movement: {_shown(key)} is both {self._table[key]} and {name}")
        labels = dict.fromkeys((*qdc_labels, "ignore"))
        combinations = (Features(*values) for values in itertools.product(MOS, HOLD, labels, QTC))
        missing = [key for key in combinations if key not in self._table]
        if missing:
            more = f" (and {len(missing) - 1} more combinations)" if len(missing) > 1 else ""
            raise DomainError(f"movement has no answer for {_shown(missing[0])}{more}")

    def update(self, relations: Relations, focus: Focus) -> Movement:
        """The movement of this step.

        Raises:
            DomainError: the relations use a QDC label the classifier was not made for.
        """
        seen = features(relations, focus)
        name = self._table.get(seen)
        if name is None:
            raise DomainError(f"movement has no answer for {_shown(seen)}")
        if relations.doubt is None:
            return Movement(relations.t, name, seen)
        gap = (relations.gaps or {}).get(focus.target or "")
        return Movement(relations.t, name, seen, self._shares(seen, relations.doubt, gap))

    def _shares(self, seen: Features, doubt: Doubt, gap: float | None) -> Mapping[str, float]:
        """What it may be, when it is not sure whether the agent walks, whether the hand is free, how far the target is.

        Who stands neither comes nearer nor goes away.
        """
        shares: dict[str, float] = {}
        near = {seen.qdc: 1.0} if gap is None else self._near(gap - doubt.slack, doubt.spread)
        towards = "0" if seen.qtc in ("-", "+") else seen.qtc
        for mos, qtc, walks in (("still", towards, 1.0 - doubt.moves), ("moving", seen.qtc, doubt.moves)):
            for hold, holds in zip(HOLD, (1.0 - doubt.grasp, doubt.grasp)):
                for label, share in near.items():
                    name = self._table[Features(mos, hold, label, qtc)]
                    shares[name] = shares.get(name, 0.0) + walks * holds * share
        return shares

    def _near(self, gap: float, spread: float) -> Mapping[str, float]:
        """The QDC labels that a distance may have, whose error is normal."""
        shares, below = {}, 0.0
        for label, end in self._bands:
            upto = 0.5 + 0.5 * math.erf((end - gap) / (spread * math.sqrt(2.0))) if spread > 0.0 else float(end >= gap)
            if upto - below > NEGLIGIBLE:
                shares[label] = upto - below
            below = upto
        return shares

    def reset(self) -> None:
        """Nothing is remembered from step to step."""


class TimedClassifier:
    """The domain's ``movement/10``, learned from what went before, too: a movement and likelihoods for each leaf.

    Raises:
        DomainError: at construction, where clauses leave out a combination of features or two have one in common.
    """

    def __init__(self, boxes: Sequence[Box]) -> None:
        check_boxes(boxes)
        self._boxes, self._past = boxes, Timed()
        self._known: dict[TimedFeatures, Box] = {}

    def reset(self) -> None:
        """Forget what went before."""
        self._past.reset()

    def update(self, relations: Relations, focus: Focus) -> Movement:
        """The movement of this step."""
        seen = self._past.update(relations, focus)
        box = self._known.get(seen)
        if box is None:
            box = self._known[seen] = next(box for box in self._boxes if box.has(seen))
        shares = None if relations.doubt is None else box.likelihoods or {box.label: 1.0}
        return Movement(relations.t, box.label, seen, shares, box.likelihoods)


def movement_classifier(rows: Rows, clauses: Sequence[Clause] = ()) -> MovementClassifier | TimedClassifier:
    """The classifier of a domain, from its ``movement/5`` and ``band/2``, or from the clauses of ``movement/10``.

    Raises:
        DomainError: a combination without a movement, or with two.
    """
    bands = perception_settings(rows).bands
    if clauses:
        labels = {label for label, _ in bands}
        require(labels <= set(QDC), f"movement/10 knows the bands {', '.join(QDC)}; use movement/5 with others")
        return TimedClassifier(boxes_of(clauses, rows("likelihood", 3)))
    return MovementClassifier(rows("movement", 5), [label for label, _ in bands], bands)


class MovementFilter:
    """The commonest of the last few movements, and of those only the changes.

    Says nothing before the window is full. When no movement is the commonest the oldest of the equal ones
    counts: this is the reading of the published code that reproduces the paper's figure of the ensemble.
    """

    def __init__(self, window: int = 3) -> None:
        require(window >= 1, "the window of the movement filter starts at 1")
        self._window: deque[Movement] = deque(maxlen=window)
        self.reset()

    def reset(self) -> None:
        """Forget every movement."""
        self._window.clear()
        self._kept: str | None = None

    def update(self, movement: Movement) -> Movement | None:
        """The filtered movement of this step, and time, if it differs from the one before, else None."""
        self._window.append(movement)
        if len(self._window) < (self._window.maxlen or 1):
            return None
        names = [m.name for m in self._window]
        name = max(names, key=names.count)
        if name == self._kept:
            return None
        self._kept = name
        source = next(m for m in reversed(self._window) if m.name == name)
        return Movement(movement.t, name, source.features)


def _shown(key: Features) -> str:
    return f"{key.mos}, {key.hold}, {key.qdc}, {key.qtc}"
