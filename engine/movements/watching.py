"""Samples to learn movements from: recordings with labels, watched as the mind watches.

A recording is watched through the same tracker, perception and focus as in a running mind, so a poor sensor is filtered
as there, and what is told later is compared with what was done at the moment it tells of. No feature knows of a label,
nor of anything that the mind would not have known by then.
"""

from __future__ import annotations

from bisect import bisect_right
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from operator import itemgetter

from casper.engine.movements.features import Features, Seen, Timed, features
from casper.engine.movements.tree import Sample
from casper.engine.perception.focus import FocusEstimator, focus_settings
from casper.engine.perception.perception import Perception, perception_settings
from casper.engine.perception.tracking import Tracker, tracker_settings
from casper.engine.perception.world import WorldState
from casper.engine.settings import Rows

Labels = Sequence[tuple[float, str | None]]
"""What was done until each time (seconds, growing), since the one before; None: nobody says."""


@dataclass(frozen=True, slots=True)
class Recording:
    """One trial through one sensor: world states in the order of time, and what was done when."""

    trial: int
    states: Sequence[WorldState]
    labels: Labels
    level: str = ""


def samples_of(
    recordings: Iterable[Recording], rows: Rows, partner: str, kind: type[Seen] = Features
) -> Iterator[Sample]:
    """The samples of recordings, one a step that is told and whose label is known.

    Raises:
        WorldStateError: time that does not advance, or a coordinate that is not finite.
        DomainError: settings of the stages are wrong.
    """
    settings = tracker_settings(rows), perception_settings(rows), focus_settings(rows)
    for recording in recordings:
        tracker, perception, focus = Tracker(settings[0]), Perception(settings[1], partner), FocusEstimator(settings[2])
        timed = Timed()
        before: float | None = None
        for state in recording.states:
            for told in tracker.steps(state):
                relations = perception.update(told)
                moment = told.t - tracker.late
                since, before = before, moment
                if relations is None:
                    continue
                attended = focus.update(relations)
                seen: Seen = timed.update(relations, attended)
                if kind is Features:
                    seen = features(relations, attended)
                label = label_between(recording.labels, since, moment)
                if relations.moving is not None and label is not None:
                    yield Sample(recording.trial, seen, label, recording.level)


def label_between(labels: Labels, since: float | None, until: float) -> str | None:
    """What was done for most of the time after ``since`` up to ``until``: features speak of the whole step, too.

    None: that is not known.
    """
    last = bisect_right(labels, until + 1e-9, key=itemgetter(0))
    first = bisect_right(labels, since + 1e-9, key=itemgetter(0)) if since is not None else last - 1
    said = [label for _, label in labels[max(min(first, last - 1), 0) : last]]
    return Counter(said).most_common(1)[0][0] if said else None


def lasting(recordings: Iterable[Recording]) -> dict[str, list[float]]:
    """By movement, how long each lasted that was seen to begin and to end (seconds); each trial counts once."""
    found: dict[str, list[float]] = {}
    for labels in {recording.trial: recording.labels for recording in recordings}.values():
        runs = [(label, [t for t, _ in steps]) for label, steps in groupby(labels, key=itemgetter(1))]
        for (before, ends), (label, times), (after, _) in zip(runs, runs[1:], runs[2:]):
            if label is not None and None not in (before, after):
                found.setdefault(label, []).append(times[-1] - ends[-1])
    return found
