"""What the agent attends to: a target and a destination (paper, section Focus Estimation, equation focus)."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

from casper.engine.events.records import setters
from casper.engine.perception.perception import Relations
from casper.engine.perception.votes import NOBODY, Ballot, Votes, Windows
from casper.engine.settings import Rows, number, read_settings, require

DEGREES, RADIANS = 180.0 / math.pi, math.pi / 180.0


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


def windows(settings: FocusSettings) -> Windows:
    """The sliding windows."""
    return Windows(
        settings.target_window, settings.target_votes, settings.destination_window, settings.destination_votes
    )


def weigh(settings: FocusSettings, label: str, symbol: str | None) -> float:
    """The numerator of the focus equation: what a distance and a trajectory weigh together."""
    distance = settings.w_qdc * settings.qdc.get(label, 0.0)
    return distance + (settings.w_qtc * settings.qtc.get(symbol, 0.0) if symbol is not None else 0.0)


def encodings(settings: FocusSettings) -> dict[tuple[str, str | None], float]:
    """The numerators of all labels that are encoded."""
    return {
        (label, symbol): weigh(settings, label, symbol) for label in settings.qdc for symbol in ("-", "0", "+", None)
    }


@dataclass(frozen=True, slots=True, init=False)
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

    def __init__(
        self,
        t: float,
        target: str | None,
        destination: str | None,
        scores: Mapping[str, float],
        attended: tuple[str, ...] = (),
    ) -> None:
        _t(self, t)
        _target(self, target)
        _destination(self, destination)
        _scores(self, scores)
        _attended(self, attended)


_t, _target, _destination, _scores, _attended = setters(Focus)


_Seen: TypeAlias = tuple[list[tuple[str, str]], list[str | None], list[float]]
"""Names and QDC, QTC and angles (degrees) of one step."""


class FocusEstimator:
    """The focus equation on each step's relations, and the votes on its scores (`engine.perception.votes`)."""

    def __init__(self, settings: FocusSettings) -> None:
        self.settings = settings
        self._unit = 1.0 if settings.angle_unit == "degrees" else RADIANS
        self._encoded = encodings(settings)
        self._seen: _Seen | None = None
        self._said: tuple[Mapping[str, float], Ballot] = {}, NOBODY
        self.votes = Votes(windows(settings))

    def reset(self) -> None:
        """Forget the target, the destination and the votes."""
        self.votes.reset()

    def update(self, relations: Relations) -> Focus:
        """The focus after this step."""
        qdc, qtc = relations.qdc, relations.qtc
        seen = list(qdc.items()), [qtc[name] for name in qdc], self._angles(relations)
        if seen != self._seen:  # else scores and ballot are as they were, as for most states of a fast sensor
            anew = self._scores(seen)
            self._seen, self._said = seen, (anew, self._ballot(anew))
        (scores, ballot), votes = self._said, self.votes
        votes.cast(ballot)
        return Focus(relations.t, votes.target, votes.destination, scores, votes.attended)

    def _angles(self, relations: Relations) -> list[float]:
        """Degrees, rounded."""
        step, angle = self.settings.angle_resolution, relations.angle
        if step > 0.0:
            return [round(angle[name] * DEGREES / step) * step for name in relations.qdc]
        return [angle[name] * DEGREES for name in relations.qdc]

    def _scores(self, seen: _Seen) -> dict[str, float]:
        """Equation focus, normalised."""
        unit, encoded, raw, total = self._unit, self._encoded, dict[str, float](), 0.0
        for (name, label), symbol, theta in zip(*seen):
            weight = encoded.get((label, symbol))
            if weight is None:
                weight = weigh(self.settings, label, symbol)
            value = raw[name] = weight / (1.0 + theta * unit)
            total += value
        return {name: score / total for name, score in raw.items()} if total > 0.0 else raw

    def _ballot(self, scores: Mapping[str, float]) -> Ballot:
        """Who is best, and who comes next; equal ones in the order of their names."""
        settings, ordered = self.settings, sorted(scores.values())
        if not ordered or ordered[-1] <= 0.0:
            return NOBODY
        top, least, share = ordered[-1], settings.destination_minimum, 1.0 - settings.tie_tolerance
        best = _ranked([name for name, score in scores.items() if score >= top * share], scores)
        second: Sequence[str] = ()
        if len(best) == 1 and len(ordered) > 1 and ordered[-2] > least:
            next_, alone = ordered[-2] * share, best[0]
            front = [name for name, score in scores.items() if score >= next_ and score > least and name != alone]
            second = _ranked(front, scores)
        worthy = tuple([name for name in best if scores[name] > least])
        return Ballot(best, worthy, second, top > settings.threshold)


def _ranked(names: list[str], scores: Mapping[str, float]) -> Sequence[str]:
    if len(names) > 1:
        names.sort(key=lambda name: (-scores[name], name))
    return tuple(names)
