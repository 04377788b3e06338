"""What is measured of a day: how often it is right, and how long an observation takes (CPU time)."""

from __future__ import annotations

import gc
import random
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import kitchens
import recipes
import whole_days
from rivals import BayesianFilter, Listed, phatt_goals

from casper.engine.episodes.day import Day
from casper.engine.episodes.enumerated import Enumerated
from casper.engine.episodes.prices import Prices
from casper.engine.episodes.training import Recorded, learn
from casper.engine.live.memory import keep_loaded
from casper.engine.reading.reading import nobody_can
from casper.engine.verification.matching import ParameterMatcher
from casper.engine.verification.observation import Observation
from casper.plans.trees.plan import Plan

PHATT_EPISODES = 10  # of a kitchen, and of changes of mind: it takes long, and gives up most of them
PHATT_OBSERVATIONS = 60  # of a day
DEFAULTS = Prices()


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


def fresh(plans: Sequence[Plan], prices: Prices = DEFAULTS) -> Day:
    """A day with these prices, by parameters; what was loaded is kept for good, as the commands do."""
    keep_loaded()
    return Day(Enumerated(plans, ParameterMatcher(plans), nobody_can), prices)


def learned(plans: Sequence[Plan], recorded: int, needless: float, unseen: float, seed: int) -> Prices:
    """The prices that ``casper train --plans`` learns from so many recorded episodes of a kitchen, with their goals."""
    if not recorded:
        return DEFAULTS
    chance, days, growing = random.Random(seed), [], Enumerated(plans, ParameterMatcher(plans), nobody_can)
    for _ in range(recorded):
        seen = kitchens.cooked(plans, chance.randint(2, 5), chance, needless, unseen)
        served = [() if goal is None else (goal,) for goal in seen.goals]
        days.append([Recorded(str(done), goals=goals) for done, goals in zip(seen.observations, served)])
    return learn(lambda prices: Day(growing, prices), days, DEFAULTS).prices


def observe(day: Day, seen: Observation | str, score: Score) -> None:
    """Observe, ask what leads, and note how long that took."""
    began = time.process_time()
    day.observe(seen)
    _ = day.leading
    score.seconds.append(time.process_time() - began)


def kitchen(
    dishes: int,
    episodes: int,
    needless: float = 0.0,
    unseen: float = 0.0,
    rivals: bool = True,
    seed: int = 0,
    recorded: int = 0,
) -> tuple[Score, dict[str, Score]]:
    """Sets of two to five dishes: ours, and the rivals' scores by name.

    With ``recorded`` the prices are learned from so many other episodes of the same kitchen; 0: they are the defaults.
    """
    plans, chance = kitchens.library(dishes, seed).ways, random.Random(seed + 1)
    matcher, start = ParameterMatcher(plans), fresh(plans, learned(plans, recorded, needless, unseen, seed + 4))
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


@dataclass
class Changes:
    """Of cooks who change: how often the new goal leads in time; of those who do not: that no change is announced."""

    found: Score = field(default_factory=Score)
    quiet: Score = field(default_factory=Score)


def changes(episodes: int, seed: int = 0) -> tuple[Changes, dict[str, Changes]]:
    """Cooks who change their mind, and as many who do not: ours, and the rivals' scores by name."""
    rows, chance = recipes.recipes(seed), random.Random(seed + 2)
    plans = recipes.library(rows).ways
    start, matcher = fresh(plans), ParameterMatcher(plans)
    ours, filtered, listed = Changes(), Changes(), Changes()

    def leading(cook: recipes.Cook, score: Score, number: int) -> Iterator[tuple[Changes, Sequence[str | None]]]:
        yield ours, _leading(start.fork(), cook.actions, score)
        yield filtered, _leading(BayesianFilter(plans, matcher), cook.actions, None)
        if number < PHATT_EPISODES:
            yield listed, _leading(Listed(plans, matcher), cook.actions, None)

    while ours.found.of < episodes:
        cook = recipes.cook(rows, True, chance)
        if cook.telling is not None:
            for whose, led in leading(cook, ours.found, ours.found.of):
                whose.found.note(cook.goals[-1] in led[cook.telling : cook.telling + 3])
    for number in range(episodes):
        for whose, led in leading(recipes.cook(rows, False, chance), ours.quiet, number):
            whose.quiet.note(not _announces(led))
    return ours, {"Bayesian filter": filtered, "PHATT-style, two goals": listed}


def _leading(
    recogniser: Day | BayesianFilter | Listed, actions: Sequence[str], score: Score | None
) -> list[str | None]:
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
    led: dict[str, Score] = field(default_factory=dict)  # by recogniser: whether a goal leads at its last action
    gave_up: int = 0  # the observation at which the plain recogniser gave up
    kept: list[int] = field(default_factory=list)


def whole_day(goals: int, dishes: int = 20, seed: int = 0) -> DayScore:
    """A day of so many goals; one is right when an episode of its name has most of its observations."""
    plans, chance, score = kitchens.library(dishes, seed).ways, random.Random(seed + 3), DayScore()
    done = list(whole_days.day(plans, goals, chance))
    day, told = fresh(plans), []
    last = {action.number: at for at, action in enumerate(done)}
    matcher = ParameterMatcher(plans)
    bayes, listed = BayesianFilter(plans, matcher), Listed(plans, matcher)
    score.led = {"this one": Score(), "Bayesian filter": Score(), "PHATT-style, two goals": Score()}
    for at, action in enumerate(done):
        observe(day, action.observation, score)
        bayes.observe(action.observation)
        if at < PHATT_OBSERVATIONS:
            listed.observe(action.observation)
        if action.number is not None and last[action.number] == at:
            for recogniser, led in zip((day, bayes, listed), score.led.values()):
                if recogniser is not listed or at < PHATT_OBSERVATIONS:
                    led.note(recogniser.leading == action.goal)
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
    score.gave_up = listed.gave_up
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
