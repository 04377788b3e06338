"""Movements: features of the target, looked up in the domain's relation (paper, Movement Classification)."""

from __future__ import annotations

import itertools
from collections import Counter, deque
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from casper.engine.perception.focus import Focus
from casper.engine.perception.perception import Relations, perception_settings
from casper.engine.settings import Rows, require
from casper.kb.errors import DomainError

MOS = ("still", "moving")
HOLD = ("free", "holding")
QTC = ("-", "0", "+", "ignore")


class Features(NamedTuple):
    """What a movement is told by: ``still`` or ``moving``, ``free`` or ``holding``, the target's QDC and QTC.

    Without a target the last two are ``ignore``. A tuple, so that it is the key of the relation's table.
    """

    mos: str
    hold: str
    qdc: str
    qtc: str


NOT_PERCEIVED = Features("ignore", "ignore", "ignore", "ignore")
"""The features of a movement that was not told by any, such as a simulated one."""


def features(relations: Relations, focus: Focus) -> Features:
    """The features at one moment; the first step, which has no MOS, counts as still."""
    mos = "moving" if relations.moving else "still"
    hold = "free" if relations.holding is None else "holding"
    target = focus.target
    if target is None or target not in relations.qdc:
        return Features(mos, hold, "ignore", "ignore")
    return Features(mos, hold, relations.qdc[target], relations.qtc[target] or "ignore")


@dataclass(frozen=True, slots=True)
class Movement:
    """The movement of one moment, and what it was told by.

    ``shares`` are the weights of all it may have been, where that is not sure; they add up to 1.
    """

    t: float
    name: str
    features: Features = NOT_PERCEIVED
    shares: Mapping[str, float] | None = None


class MovementClassifier:
    """The domain's relation ``movement(Mos, Hold, Qdc, Qtc, Movement)`` as a table.

    Raises:
        DomainError: at construction, when a combination of features has no movement, or two.
    """

    def __init__(self, table: Iterable[Sequence[str]], qdc_labels: Iterable[str]) -> None:
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
        if relations.grasp is None:
            return Movement(relations.t, name, seen)
        return Movement(relations.t, name, seen, self._shares(seen, relations.grasp))

    def _shares(self, seen: Features, grasp: float) -> Mapping[str, float]:
        """What it may be, when it is not sure whether the hand is free."""
        shares: dict[str, float] = {}
        for hold, share in zip(HOLD, (1.0 - grasp, grasp)):
            name = self._table[seen._replace(hold=hold)]
            shares[name] = shares.get(name, 0.0) + share
        return shares

    def reset(self) -> None:
        """Nothing is remembered from step to step."""


def movement_classifier(rows: Rows) -> MovementClassifier:
    """The classifier of a domain, from its ``movement/5`` and ``band/2``.

    Raises:
        DomainError: a combination without a movement, or with two.
    """
    return MovementClassifier(rows("movement", 5), [label for label, _ in perception_settings(rows).bands])


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
        name = Counter(m.name for m in self._window).most_common(1)[0][0]
        if name == self._kept:
            return None
        self._kept = name
        source = next(m for m in reversed(self._window) if m.name == name)
        return Movement(movement.t, name, source.features)


def _shown(key: Features) -> str:
    return f"{key.mos}, {key.hold}, {key.qdc}, {key.qtc}"
