"""What the agent attends to: a target and a destination (paper, section Focus Estimation, equation focus)."""

from __future__ import annotations

import math
from collections import Counter, deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from casper.engine.perception.perception import Relations
from casper.engine.settings import Rows, number, read_settings, require


def _qdc() -> Mapping[str, float]:
    return {"touch": 0.5, "near": 0.25, "medium": 0.125, "far": 0.0, "ignore": 0.0}


def _qtc() -> Mapping[str, float]:
    return {"0": 0.5, "-": 0.25, "+": 0.0}


@dataclass(frozen=True, slots=True)
class FocusSettings:
    """The terms of the focus equation and of the two sliding windows.

    qdc, qtc: the paper's encodings; a label that is not there counts 0. w_qdc, w_qtc: their weights.
    angle_unit: ``degrees`` or ``radians`` of the angle in the denominator; angle_resolution: degrees to
    whose multiples it is rounded first (0 is none; at 1, as published, noise decides between things in one
    place). threshold: the share the best must surpass. A target needs target_votes of target_window steps, a
    destination destination_votes of destination_window, each with a share above destination_minimum.
    tie_tolerance: relative difference up to which two scores are equal. steady: a destination counts for an
    action only while it is attended to; off, as published, the last one does, however long ago it was.
    """

    qdc: Mapping[str, float] = field(default_factory=_qdc)
    qtc: Mapping[str, float] = field(default_factory=_qtc)
    w_qdc: float = 0.8
    w_qtc: float = 0.2
    angle_unit: str = "degrees"
    angle_resolution: float = 10.0
    threshold: float = 0.45
    target_window: int = 4
    target_votes: int = 3
    destination_window: int = 5
    destination_votes: int = 3
    destination_minimum: float = 0.05
    tie_tolerance: float = 0.0
    steady: bool = True

    def __post_init__(self) -> None:
        require(
            self.angle_unit in ("degrees", "radians"),
            f"angle_unit is degrees or radians, not {self.angle_unit}",
        )
        require(self.w_qdc >= 0 and self.w_qtc >= 0 and self.w_qdc + self.w_qtc > 0, "focus weights are positive")
        require(self.angle_resolution >= 0 and self.tie_tolerance >= 0, "focus tolerances are not negative")
        require(1 <= self.target_votes <= self.target_window, "target_votes lies between 1 and target_window")
        require(
            1 <= self.destination_votes <= self.destination_window,
            "destination_votes lies between 1 and destination_window",
        )


def focus_settings(rows: Rows) -> FocusSettings:
    """Settings from facts ``setting(focus, Name, Value)`` and ``encoding(qdc or qtc, Label, Number)``.

    Raises:
        DomainError: an unknown setting or relation, or a value of the wrong kind.
    """
    tables: dict[str, dict[str, float]] = {"qdc": {}, "qtc": {}}
    for relation, label, value in rows("encoding", 3):
        require(relation in tables, f"encoding({relation}, {label}, {value}): only qdc and qtc are encoded")
        tables[relation][label] = number(value, f"encoding({relation}, {label}, {value})")
    return read_settings(FocusSettings, rows, "focus", qdc=tables["qdc"] or _qdc(), qtc=tables["qtc"] or _qtc())


@dataclass(frozen=True, slots=True)
class Focus:
    """Target and destination at one moment; ``scores`` by object add up to 1, or are all 0.

    ``attended`` are the destinations that are looked at in this very step and have been for long enough, or were last
    where nothing but the target is looked at: several where one lies on the other.
    """

    t: float
    target: str | None
    destination: str | None
    scores: Mapping[str, float]
    attended: tuple[str, ...] = ()


class FocusEstimator:
    """Votes for the best object in a window of steps; a winner stays until another wins.

    A step in which nothing surpasses the threshold casts an empty vote. Ties: two equal best of which one
    is the target leave it the target and make the other a candidate for the destination; otherwise both are
    candidates for the target, in the same step. Three or more equal best vote for the target that is, the
    others for the destination. There is no destination without a target.
    """

    def __init__(self, settings: FocusSettings) -> None:
        self.settings = settings
        to_unit = 1.0 if settings.angle_unit == "degrees" else math.pi / 180.0
        self._unit, self._resolution = to_unit, settings.angle_resolution
        self.reset()

    def reset(self) -> None:
        """Forget the target, the destination and the votes."""
        self.target: str | None = None
        self.destination: str | None = None
        self._attended: tuple[str, ...] = ()
        self._targets: deque[Sequence[str]] = deque(maxlen=self.settings.target_window)
        self._destinations: deque[Sequence[str]] = deque(maxlen=self.settings.destination_window)

    def update(self, relations: Relations) -> Focus:
        """The focus after this step."""
        scores = self._scores(relations)
        ranked = sorted(scores, key=lambda name: (-scores[name], name))
        for_target, for_destination = self._candidates(ranked, scores)
        self._targets.append(for_target)
        self.target = _winner(self._targets, self.settings.target_votes, self.target, None)
        if self.destination == self.target:
            self.destination = None
        attended: tuple[str, ...] = ()
        if self.target is not None:
            now = [name for name in for_destination if name != self.target]
            self._destinations.append(now)
            needed = self.settings.destination_votes
            self.destination = _winner(self._destinations, needed, self.destination, self.target)
            attended = self._looked_at(now)
        return Focus(relations.t, self.target, self.destination, scores, attended)

    def _looked_at(self, now: Sequence[str]) -> tuple[str, ...]:
        """The destinations with enough votes, if one of them is voted for in this step; as before where nothing is."""
        votes = Counter(name for slot in self._destinations for name in slot)
        elected = tuple(name for name, count in votes.items() if count >= self.settings.destination_votes)
        if any(name in now for name in elected):
            self._attended = elected
        elif now:
            return ()
        return tuple(name for name in self._attended if name != self.target)

    def _scores(self, relations: Relations) -> dict[str, float]:
        """Equation focus, normalised."""
        settings, unit, step = self.settings, self._unit, self._resolution
        qdc, qtc, w_qdc, w_qtc = settings.qdc, settings.qtc, settings.w_qdc, settings.w_qtc
        raw = {}
        for name, label in relations.qdc.items():
            theta = math.degrees(relations.angle[name])
            if step > 0.0:
                theta = round(theta / step) * step
            symbol = relations.qtc[name]
            encoded = w_qdc * qdc.get(label, 0.0) + (w_qtc * qtc.get(symbol, 0.0) if symbol is not None else 0.0)
            raw[name] = encoded / (1.0 + theta * unit)
        total = sum(raw.values())
        return {name: score / total for name, score in raw.items()} if total > 0.0 else raw

    def _candidates(self, ranked: Sequence[str], scores: Mapping[str, float]) -> tuple[Sequence[str], Sequence[str]]:
        """Who this step votes for, as target and as destination."""
        if not ranked or scores[ranked[0]] <= 0.0:
            return (), ()
        best = self._tied(ranked, scores)
        clear = scores[best[0]] > self.settings.threshold
        if len(best) == 1:
            return best if clear else (), self._worth(self._tied(ranked[1:], scores), scores)
        others = [name for name in best if name != self.target]
        if len(best) > 2:
            return [name for name in best if name == self.target], self._worth(others, scores)
        if len(others) == 1:
            return [name for name in best if name == self.target and clear], self._worth(others, scores)
        return best if clear else (), ()

    def _tied(self, ranked: Sequence[str], scores: Mapping[str, float]) -> Sequence[str]:
        """The names at the front of the ranking whose scores are equal."""
        if not ranked:
            return ()
        least = scores[ranked[0]] * (1.0 - self.settings.tie_tolerance)
        n = 1
        while n < len(ranked) and scores[ranked[n]] >= least:
            n += 1
        return ranked[:n]

    def _worth(self, names: Sequence[str], scores: Mapping[str, float]) -> Sequence[str]:
        return [name for name in names if scores[name] > self.settings.destination_minimum]


def _winner(window: deque[Sequence[str]], needed: int, current: str | None, barred: str | None) -> str | None:
    """Who has the votes: the current one if it has, else whoever has most (the first named, if equal)."""
    votes: dict[str, int] = {}
    for slot in window:
        for name in slot:
            votes[name] = votes.get(name, 0) + 1
    winners = [name for name, count in votes.items() if count >= needed and name != barred]
    if not winners or current in winners:
        return current
    return max(winners, key=votes.__getitem__)
