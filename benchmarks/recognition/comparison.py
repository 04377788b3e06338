"""An engine and the plain baseline on the same episodes: equal answers first, then their times and the ratio."""

from __future__ import annotations

import gc
import statistics
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from baseline import Baseline, TooMany
from engines import name_of
from timing import significant, told

from casper.engine.recognition.choice import recogniser
from casper.engine.recognition.options import Options
from casper.engine.recognition.teller import Teller
from casper.engine.verification.matching import Matcher
from casper.engine.verification.observation import Observation
from casper.plans.trees.plan import Plan

Episodes: TypeAlias = Sequence[Sequence[Observation]]


@dataclass(frozen=True, slots=True)
class Answer:
    """What is said after an observation; ``best`` is the score of the best explanation, 0 where there is none.

    What is not exact is a lower bound: an engine had to drop states.
    """

    count: int
    posterior: Mapping[str, float]
    best: float
    is_exact: bool = True


@dataclass(frozen=True, slots=True)
class Race:
    """What an engine and the baseline needed for an episode, in seconds, and how many explanations there were at most.

    ``gave_up`` says where the baseline did not go on; its time is what it needed until then.
    """

    ours: float
    theirs: float
    explanations: int
    is_exact: bool
    gave_up: str | None


def compared(
    what: str,
    plans: Sequence[Plan],
    matcher: Matcher,
    options: Options,
    episodes: Episodes,
    bound: float | None = None,
) -> int:
    """Tell the times of an episode with the engine that a reading picks, and with the baseline.

    Returns:
        The most explanations there were.
    """

    def engine() -> Teller:
        return recogniser(plans, matcher, options)

    def baseline() -> Baseline:
        return Baseline(plans, matcher, options.goals, options.noise)

    race = raced(engine, baseline, episodes)
    many = f"up to {race.explanations:,} explanations" if race.is_exact else f"{race.explanations:,} kept (not exact)"
    told(what, 1e3 * race.ours, "ms", bound, f"{many}, {name_of(engine())}")
    ratio = f"x {significant(race.theirs / race.ours)}"
    if race.gave_up is None:
        equal = "equal answers" if race.is_exact else "equal answers while exact"
        told(f"  plain baseline, {equal}", 1e3 * race.theirs, "ms", None, ratio)
    else:
        told(f"  plain baseline: {race.gave_up}", 1e3 * race.theirs, "ms", None, f"{ratio} and more")
    return race.explanations


def raced(make: Callable[[], Teller], baseline: Callable[[], Baseline], episodes: Episodes) -> Race:
    """The mean of the episodes, each the median of three runs of an engine that has seen no other.

    Answers are compared as far as the baseline goes. Tables of the library are made before the time is taken.
    """
    ours, theirs = list[float](), list[float]()
    most, is_exact, gave_up = 0, True, None
    for seen in episodes:
        found = list(answers(make(), seen))
        plain, expected = baseline(), list[Answer]()
        gc.collect()
        began = time.perf_counter()
        try:
            for answer in answers(plain, seen):
                expected.append(answer)
        except TooMany as reason:
            gave_up = f"{reason} at observation {plain.observed + 1}"
        theirs.append(time.perf_counter() - began)
        check(found, expected)
        most, is_exact = max(most, *(answer.count for answer in found)), is_exact and found[-1].is_exact
        del plain, expected
        gc.collect()
        ours.append(statistics.median(seconds(make(), seen) for _ in range(3)))
    return Race(statistics.mean(ours), statistics.mean(theirs), most, is_exact, gave_up)


def answers(recogniser: Teller | Baseline, seen: Sequence[Observation]) -> Iterator[Answer]:
    """What an engine or the baseline says after each observation."""
    for observation in seen:
        recogniser.observe(observation)
        if isinstance(recogniser, Baseline):
            yield Answer(recogniser.count, recogniser.posterior(), recogniser.best())
        else:
            best = recogniser.first()
            score = 0.0 if best is None else best.score
            yield Answer(recogniser.count, recogniser.posterior(), score, recogniser.is_exact)


def seconds(recogniser: Teller | Baseline, seen: Sequence[Observation]) -> float:
    """What an episode takes, with posterior and best explanation after each observation."""
    began = time.perf_counter()
    for _ in answers(recogniser, seen):
        pass
    return time.perf_counter() - began


def check(found: Sequence[Answer], expected: Sequence[Answer]) -> None:
    """Refuse answers that differ, as far as both go and the engine is exact; from there on its counts may be lower.

    Raises:
        AssertionError: with what differs.
    """
    for at, (ours, true) in enumerate(zip(found, expected), 1):
        if not ours.is_exact:
            assert ours.count <= true.count, f"observation {at}: {ours.count} explanations are more than {true.count}"
            continue
        assert ours.count == true.count, f"observation {at}: {ours.count} explanations, not {true.count}"
        for goal, share in true.posterior.items():
            said = ours.posterior[goal]
            assert abs(said - share) < 1e-9, f"observation {at}: {goal} has {said}, not {share}"
        assert abs(ours.best - true.best) < 1e-9, f"observation {at}: the best has {ours.best}, not {true.best}"
