"""Days of the kitchen, and of plans made up for a test."""

from __future__ import annotations

from readings import KITCHEN

from casper.engine.episodes.day import Day
from casper.engine.episodes.enumerated import Enumerated
from casper.engine.episodes.hypotheses.growth import Bounds
from casper.engine.episodes.prices import Prices
from casper.engine.reading.reading import nobody_can
from casper.engine.verification.matching import ParameterMatcher
from casper.plans.library import PlanLibrary

BREAKFAST = ["pick_and_place(biscuits, plate)", "eat(biscuits, plate)", "pick_and_place(plate, sink)", "wash(plate, sink)"]
DRINK = ["pick_and_place(bottle, glass)", "sip(bottle, glass)", "pick_and_place(glass, sink)", "wash(glass, sink)"]
LUNCH = ["pick_and_place(meal, hobs)", "cook(meal, hobs)", "pick_and_place(meal, plate)", "eat(meal, plate)", *BREAKFAST[2:]]
EVERYTHING = Bounds(keep=10**6, floor=0.0, entries=10**6, least=0.0, tries=10**9)


def lived(*observed, agent=None, **options):
    """A day of the kitchen that has observed these actions."""
    return observing(KITCHEN.day(**options), *observed, agent=agent)


def day_of(text, bounds=None, **prices):
    """A day of some plans."""
    plans = PlanLibrary.from_text(text).ways
    return Day(Enumerated(plans, ParameterMatcher(plans), nobody_can), Prices(**prices), bounds=bounds or Bounds())


def observing(day, *observed, agent=None):
    """The day after it has observed these actions."""
    for action in observed:
        day.observe(action, agent=agent)
    return day


def row(day):
    """Its episodes as pairs of goal and outcome."""
    return [(episode.goal, episode.outcome) for episode in day.episodes]
