"""What is measured of a day: how often it is right, and how long an observation takes (CPU time)."""

from __future__ import annotations

import gc
import random
import time
from collections.abc import Sequence
from dataclasses import dataclass, field

import kitchens
import recipes
import whole_days
from rivals import BayesianFilter, phatt_goals

from casper.engine.episodes.day import Day
from casper.engine.episodes.enumerated import Enumerated
from casper.engine.reading.reading import nobody_can
from casper.engine.verification.matching import ParameterMatcher
from casper.engine.verification.observation import Observation
from casper.plans.trees.plan import Plan

PHATT_EPISODES = 10  # of a kitchen: it takes long, and gives up most of them


@dataclass
class Score:
    """How many of how many were right; the seconds of each observation."""

    right: int = 0
    of: int = 0
    seconds: list[float] = field(default_factory=list)

    @property
    def share(self) -> float:
        """The part that was right."""
        return self.right / self.of if self.of else 0.0

    def note(self, is_right: bool) -> None:
        """One more."""
        self.right, self.of = self.right + is_right, self.of + 1

    def median(self) -> float:
        """Of the seconds."""
        return sorted(self.seconds)[len(self.seconds) // 2]


def fresh(plans: Sequence[Plan]) -> Day:
    """A day with the default prices, by parameters."""
    return Day(Enumerated(plans, ParameterMatcher(plans), nobody_can))


def observe(day: Day, seen: Observation | str, score: Score) -> None:
    """Observe, ask what leads, and note how long that took."""
    began = time.process_time()
    day.observe(seen)
    _ = day.leading
    score.seconds.append(time.process_time() - began)


def kitchen(
    dishes: int, episodes: int, needless: float = 0.0, unseen: float = 0.0, rivals: bool = True
) -> tuple[Score, dict[str, Score]]:
    """Sets of two to five dishes: ours, and the rivals' scores by name."""
    plans, chance = kitchens.library(dishes).ways, random.Random(1)
    matcher, start = ParameterMatcher(plans), fresh(plans)
    ours, theirs = Score(), {"Bayesian filter, told how many": Score(), "PHATT-style, told how many": Score()}
    for number in range(episodes):
        seen = kitchens.cooked(plans, chance.randint(2, 5), chance, needless, unseen)
        day = start.fork()
        for observation in seen.observations:
            observe(day, observation, ours)
        day.finish()
        ours.note(tuple(sorted(day.best()[0].goals)) == seen.pursued)
        if rivals:
            bayes = BayesianFilter(plans, matcher)
            for observation in seen.observations:
                bayes.observe(observation)
            filtered, listed = theirs.values()
            filtered.note(bayes.likeliest(len(seen.pursued)) == seen.pursued)
            if number < PHATT_EPISODES:
                noise = 0.1 if needless or unseen else None
                found = phatt_goals(plans, matcher, seen.observations, len(seen.pursued), noise)
                listed.note(found == seen.pursued)
    return ours, theirs


def changes(episodes: int) -> tuple[Score, Score, Score, Score]:
    """Cooks who change: the new goal leads in time, ours and the filter's. Who do not: no change announced, likewise"""
    rows, chance = recipes.recipes(), random.Random(2)
    plans = recipes.library(rows).ways
    start, matcher = fresh(plans), ParameterMatcher(plans)
    found, filtered, quiet, filtered_quiet = Score(), Score(), Score(), Score()
    while found.of < episodes:
        cook = recipes.cook(rows, True, chance)
        if cook.telling is None:
            continue
        leading = _leading(start.fork(), cook.actions, found)
        by_filter = _leading(BayesianFilter(plans, matcher), cook.actions, None)
        in_time = slice(cook.telling, cook.telling + 3)
        found.note(cook.goals[-1] in leading[in_time])
        filtered.note(cook.goals[-1] in by_filter[in_time])
    for _ in range(episodes):
        cook = recipes.cook(rows, False, chance)
        quiet.note(not _announces(_leading(start.fork(), cook.actions, quiet)))
        filtered_quiet.note(not _announces(_leading(BayesianFilter(plans, matcher), cook.actions, None)))
    return found, filtered, quiet, filtered_quiet


def _leading(recogniser: Day | BayesianFilter, actions: Sequence[str], score: Score | None) -> list[str | None]:
    leading = []
    for action in actions:
        if isinstance(recogniser, Day):
            assert score is not None
            observe(recogniser, action, score)
        else:
            recogniser.observe(Observation(action, ()))
        leading.append(recogniser.leading)
    return leading


def _announces(leading: Sequence[str | None]) -> bool:
    """Whether another goal leads after one did."""
    return len({goal for goal in leading if goal is not None}) > 1


@dataclass
class DayScore(Score):
    """Of a day also: episodes that were told and are no goal's, and objects kept at every quarter of the day."""

    invented: int = 0
    kept: list[int] = field(default_factory=list)


def whole_day(goals: int, dishes: int = 20, seed: int = 3) -> DayScore:
    """A day of so many goals; one is right when an episode of its name has most of its observations."""
    plans, chance, score = kitchens.library(dishes).ways, random.Random(seed), DayScore()
    done = list(whole_days.day(plans, goals, chance))
    day, told = fresh(plans), []
    for at, action in enumerate(done):
        observe(day, action.observation, score)
        told += day.closed()
        if (at + 1) % (len(done) // 4) == 0:
            score.kept.append(objects_of(day))
    day.finish()
    told += day.closed()
    used = set()
    for number in sorted({action.number for action in done if action.number is not None}):
        own = {at + 1 for at, action in enumerate(done) if action.number == number}
        label = next(action.goal for action in done if action.number == number)
        most = [e for e in told if e.goal == label and 2 * len(own.intersection(e.observations)) > len(own)]
        used.update(id(episode) for episode in most[:1])
        score.note(bool(most))
    score.invented = sum(id(episode) not in used for episode in told)
    return score


def objects_of(day: Day) -> int:
    """How many objects a day holds, what belongs to its plans aside."""
    seen, waiting = set[int](), [day._levels, day._told]
    while waiting:
        thing = waiting.pop()
        if id(thing) not in seen and not isinstance(thing, (type, Enumerated)):
            seen.add(id(thing))
            waiting.extend(gc.get_referents(thing))
    return len(seen)
