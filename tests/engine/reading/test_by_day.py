"""Segments by a day's hypotheses: the reading of an episode follows what the day takes to belong together."""

from dataclasses import dataclass

from casper.engine.reading.by_day import ByDay
from casper.engine.reading.course import Course
from casper.engine.reading.policy import best
from casper.engine.reading.reading import Reading
from casper.engine.verification.matching import NameMatcher
from casper.engine.verification.observation import Observation
from casper.kb.terms.terms import Compound
from casper.plans.library import PlanLibrary

HOME = PlanLibrary.from_text("goal(tea). tea --> boil, pour, drink, rinse. goal(toast). toast --> slice, grill, eat.")


@dataclass
class Part:
    observations: tuple[int, ...]


class Script:
    """A day whose best explanation after each observation is written down: groups of numbers that belong together."""

    def __init__(self, *answers):
        self.answers, self.count, self.heard = answers, 0, []

    def observe(self, observed, t=None, agent=None):
        self.count += 1
        self.heard.append((str(observed), t, agent))

    @property
    def episodes(self):
        return [Part(group) for group in self.answers[self.count - 1]]


def course(day, can=()):
    capability = lambda s, leaf, _: (s.leaves[leaf], s.leaves[leaf][0] in can)  # noqa: E731
    fresh = lambda: Reading(HOME, NameMatcher(HOME.ways), best, capability)  # noqa: E731
    return Course("ann", "bot", fresh, lambda agent, fresh: ByDay(day, agent, fresh))


def seen(course, *actions):
    return [e for t, a in enumerate(actions, 1) for e in course.read(Observation(a, ()), float(t))]


def read(course):
    return [str(seen) for seen in course.current.reading.observations]


def test_what_belongs_together_is_one_episode():
    day = Script([(1,)], [(1, 2)], [(1, 2, 3)])
    own = course(day)
    events = seen(own, "slice", "grill", "eat")
    assert [e.data["outcome"] for e in events if e.type == "episode"] == ["finished"]
    assert day.heard == [("slice", 1.0, "ann"), ("grill", 2.0, "ann"), ("eat", 3.0, "ann")]


def test_what_serves_no_goal_is_left_out():
    own = course(Script([(1,)], [(1,)], [(1, 3)]))
    events = seen(own, "slice", "eat", "grill")
    assert [e.data["message"] for e in events if e.type == "warning"] == ["eat serves no goal that is or could be pursued now and is left out"]
    assert read(own) == ["slice", "grill"]


def test_an_action_that_was_misread_falls_out_of_the_reading_once_the_day_says_so():
    own = course(Script([(1,)], [(1, 2)], [(1, 3)]))
    seen(own, "boil", "drink", "pour")
    assert read(own) == ["boil", "pour"]
    assert own.current.supervisor.commitment.goal == "tea"


def test_a_goal_that_the_partner_comes_back_to_is_read_with_all_that_was_seen_of_it():
    own = course(Script([(1,)], [(1,), (2,)], [(1, 3), (2,)]), can=("rinse",))
    events = seen(own, "boil", "slice", "pour")
    ended = [(e.data["goal"], e.data["outcome"]) for e in events if e.type == "episode"]
    assert ended == [("tea", "abandoned"), ("toast", "unclear")]
    assert read(own) == ["boil", "pour"]
    (withdrawn,) = [e for e in events if e.type == "withdrawn"]
    assert withdrawn.data["because"] == "ann went over to slice: tea has no slice"
    assert own.current.supervisor.commitment.goal == "tea"


def test_an_action_that_would_fit_and_that_the_day_gives_to_another_goal_begins_that():
    own = course(Script([(1,)], [(1,), (2,)]))
    seen(own, "boil", "drink")
    assert read(own) == ["drink"]
    assert own.rows[0]["observed"] == 1


def test_what_the_robot_did_is_heard_by_the_day():
    day = Script([(1,)], [(1, 2)], [(1, 2, 3)], [])
    own = course(day, can=("rinse",))
    seen(own, "boil", "pour", "drink")
    events = list(own.did(Compound(("rinse",)), 9.0))
    assert [e.data["outcome"] for e in events] == ["finished"]
    assert day.heard[-1] == ("rinse", 9.0, "bot")
