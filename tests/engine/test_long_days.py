"""A mind that watches for days: memory and work a step do not grow."""

import gc
import sys
from collections import Counter

import pytest

from casper import Domain, Mind
from casper.engine.actions.hmm import SHOWN
from casper.engine.perception.world import AgentState, ObjectState, WorldState
from casper.engine.verification.observation import Observation
from casper.kb.terms.terms import Compound

KITCHEN = Domain.load("kitchen")
BREAKFAST = (("pick_and_place", "biscuits", "plate"), ("eat", "biscuits", "plate"))
DRINK = (("pick_and_place", "bottle", "glass"), ("sip", "bottle", "glass"))
ABANDONED = (("pick_and_place", "meal", "hobs"),)
ODD = (("cook", "meal", "hobs"), ("wash", "glass", "sink"))


def day(mind, episodes, t=0.0):
    """Breakfast, a lunch that is given up, things that fit nothing, a drink; the robot helps with every second drink."""
    for number in range(episodes):
        for action in (*BREAKFAST, *ABANDONED, *ODD, *DRINK):
            t += 10.0
            for _ in mind._read(Observation(action[0], action[1:]), t):
                pass
        for thing in ("plate", "glass"):
            for action in ("pick_and_place", "wash") if number % 2 else ():
                mind.did(Compound((action, thing, "sink")), t)
    return t


def kept():
    """How many objects of each kind there are."""
    gc.collect()
    return Counter(type(thing).__name__ for thing in gc.get_objects())


def work(call):
    """How many functions were called."""
    calls = 0

    def count(frame, event, argument):
        nonlocal calls
        calls += event == "call"

    sys.setprofile(count)
    try:
        call()
    finally:
        sys.setprofile(None)
    return calls


@pytest.mark.parametrize("options", [{}, {"noise": 0.05}, {"goals": 2}, {"verification": False}], ids=str)
def test_memory_does_not_grow_over_a_day_of_many_goals(options):
    mind = Mind(KITCHEN, **options)
    t = day(mind, 30)
    before, rows = kept(), len(mind.course.rows)
    day(mind, 40, t)
    after, more = kept(), len(mind.course.rows) - rows
    assert more > 60
    grown = {kind: after[kind] - before[kind] for kind in after if after[kind] - before[kind] > 100}
    assert grown.keys() <= {"dict", "tuple", "Compound"}, grown
    assert grown.get("dict", 0) <= more + 100  # the row that the summary has for each episode
    assert sum(grown.values()) - grown.get("dict", 0) <= 2000  # did/2, up to its bound


@pytest.mark.parametrize("options", [{}, {"noise": 0.05}, {"goals": 2}], ids=str)
def test_the_work_of_an_episode_stays_the_same(options):
    mind = Mind(KITCHEN, **options)
    t = day(mind, 20)
    early = work(lambda: day(mind, 2, t))
    t = day(mind, 30, t + 1000.0)
    late = work(lambda: day(mind, 2, t))
    assert late <= 1.3 * early


def test_nothing_grows_while_hours_go_by_in_which_nobody_does_anything_that_counts():
    mind = Mind(KITCHEN)
    for step in range(1, 3001):
        x = 0.5 + (step // 40 % 2) * 0.15 * (step % 40)  # stands, walks, stands: movements that complete no action
        objects = {"plate": ObjectState(9.0, 0.0, 0.8), "sink": ObjectState(9.0, 9.0, 0.8)}
        mind.update(WorldState(0.5 * step, {"human": AgentState(x, 0.0, 3.0)}, objects))
    assert len(mind.actions.window) <= SHOWN
    assert len(mind.history) <= mind.history.most
