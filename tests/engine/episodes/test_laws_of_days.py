"""What holds of every day: taking back, forks, the order of the library, bounded memory."""

import gc
import pickle
import random
from dataclasses import replace

import pytest
from days import BREAKFAST, DRINK, EVERYTHING, LUNCH, day_of, lived, observing, row
from hypothesis import given
from hypothesis import strategies as st

from casper.engine.episodes.day import Day
from casper.engine.episodes.enumerated import Enumerated
from casper.engine.episodes.hypotheses.growth import Bounds
from casper.engine.episodes.past import MOST, RECENT, with_statement
from casper.engine.reading.reading import nobody_can
from casper.engine.verification.matching import ParameterMatcher
from casper.engine.verification.vocabulary import Vocabulary
from casper.kb.errors import CasperError
from casper.kb.terms.terms import Compound
from casper.plans.library import PlanLibrary

GOALS = ["g --> a, b(X), c(X).", "h --> unordered(a, b(X)), d.", "i --> b(cup), (c(cup) ; d)."]
ACTIONS = st.lists(st.sampled_from(["a", "b(cup)", "b(pot)", "c(cup)", "c(pot)", "d", "unheard"]), max_size=7)


class Matching(ParameterMatcher):
    """One of which a day does not know that comparing arguments is all it does."""


class Counted(Enumerated):
    """It counts the states of goals under way that it is asked of."""

    tried = 0

    def steps(self, state, seen, agent):
        self.tried += state.plan is not None
        return super().steps(state, seen, agent)


def text(order):
    return "\n".join(f"goal({GOALS[at][0]}). {GOALS[at]}" for at in order)


def said(day):
    return dict(day.posterior), dict(day.current), day.leading, row(day), [n.number for n in day.needless], day.count


@given(ACTIONS, ACTIONS)
def test_taking_back_is_as_if_it_had_not_been(first, then):
    day = observing(day_of(text([0, 1, 2])), *first)
    before = said(day)
    observing(day, *then)
    for _ in then:
        day.undo()
    assert said(day) == before


@given(ACTIONS, ACTIONS, ACTIONS)
def test_a_fork_goes_its_own_way(first, one, other):
    day = observing(day_of(text([0, 1, 2])), *first)
    fork = observing(day.fork(), *other)
    observing(day, *one)
    assert said(day) == said(observing(day_of(text([0, 1, 2])), *first, *one))
    assert said(fork) == said(observing(day_of(text([0, 1, 2])), *first, *other))


@given(st.permutations([0, 1, 2]), ACTIONS)
def test_the_order_of_the_library_does_not_matter(order, actions):
    one, other = (observing(day_of(text(o), EVERYTHING), *actions) for o in ([0, 1, 2], order))
    assert other.posterior == pytest.approx(one.posterior) and other.current == pytest.approx(one.current)
    assert [a.share for a in other.best(9)] == pytest.approx([a.share for a in one.best(9)])


@given(ACTIONS, st.integers(1, 5))
def test_what_is_dropped_is_said(actions, keep):
    day = observing(day_of(text([0, 1, 2]), Bounds(keep=keep)), *actions)
    whole = observing(day_of(text([0, 1, 2]), EVERYTHING), *actions)
    assert day.states <= keep and whole.is_exact and whole.left_out == 0
    if day.is_exact:
        assert day.posterior == pytest.approx(whole.posterior)
    else:
        assert 0 < day.left_out <= 1


@given(ACTIONS, st.integers(1, 8))
def test_the_work_of_an_observation_is_bounded(actions, tries):
    plans = PlanLibrary.from_text(text([0, 1, 2])).ways
    growing = Counted(plans, ParameterMatcher(plans), nobody_can)
    day = Day(growing, bounds=Bounds(tries=tries))
    for action in actions:
        last = max(sum(len(body.entries) for body in h.key) for h in day._levels[-1].hypotheses)
        growing.tried = 0
        day.observe(action)
        assert growing.tried <= tries + last


@given(ACTIONS, st.integers(1, 8))
def test_what_no_tries_are_left_for_is_said(actions, tries):
    day = observing(day_of(text([0, 1, 2]), replace(EVERYTHING, tries=tries)), *actions)
    whole = observing(day_of(text([0, 1, 2]), EVERYTHING), *actions)
    if day.is_exact:
        assert day.posterior == pytest.approx(whole.posterior) and day.states == whole.states
    else:
        assert 0 < day.left_out <= 1
    assert sum(account.share for account in day.best(10**6)) == pytest.approx(1)


def test_the_lightest_hypotheses_are_dropped_when_no_tries_are_left():
    actions = ["a", "b(cup)", "b(pot)", "c(cup)", "d", "a", "b(cup)"]
    assert not observing(day_of(text([0, 1, 2]), replace(EVERYTHING, tries=1)), *actions).is_exact


@given(ACTIONS)
def test_comparing_arguments_is_matching_them(actions):
    plans = PlanLibrary.from_text(text([0, 1, 2])).ways
    fast, slow = (Enumerated(plans, kind(plans), nobody_can) for kind in (ParameterMatcher, Matching))
    states = [fast.begin(goal) for goal in range(len(fast.goals))]
    for action in actions:
        seen = Vocabulary(fast.leaves()).read(action)
        after = [list(fast.steps(state, seen, None)) for state in states]
        assert after == [list(slow.steps(state, seen, None)) for state in states]
        states = list(dict.fromkeys([*states, *(step.state for steps in after for step in steps)]))


def test_nothing_more_can_be_taken_back_than_is_remembered():
    day = observing(day_of(text([0]), Bounds(lag=3)), *"aaaaa")
    for _ in range(3):
        day.undo()
    with pytest.raises(CasperError, match="a day remembers its last 3"):
        day.undo()


def test_what_was_told_is_not_told_again_after_taking_back():
    day = lived(*BREAKFAST)
    day.undo()
    assert day.closed() == []
    day.observe(BREAKFAST[-1])
    assert [episode.goal for episode in day.closed()] == ["breakfast"]


@given(ACTIONS, ACTIONS)
def test_a_day_goes_on_where_it_arrives(first, then):
    day = observing(day_of(text([0, 1, 2])), *first)
    arrived = pickle.loads(pickle.dumps(day))
    assert said(arrived) == said(day)
    assert said(observing(arrived, *then)) == said(observing(day, *then))


def test_a_day_of_the_kitchen_is_sent_too():
    arrived = observing(pickle.loads(pickle.dumps(lived(*BREAKFAST[:2]))), *BREAKFAST[2:])
    assert row(arrived) == [("breakfast", "finished")]


def objects(day):
    seen, waiting = set(), [day._levels, day._told]
    while waiting:
        thing = waiting.pop()
        if id(thing) not in seen and not isinstance(thing, (type, Enumerated)):
            seen.add(id(thing))
            waiting.extend(gc.get_referents(thing))
    return len(seen)


def test_a_long_day_holds_no_more_than_a_short_one():
    day, chance, sizes, closed = lived(bounds=Bounds(lag=20)), random.Random(1), [], []
    for at in range(160):
        observing(day, *chance.choice([BREAKFAST, DRINK, LUNCH]), *(["dance"] if at % 5 == 0 else []))
        closed += day.closed()
        sizes.append(objects(day))
    assert len(closed) > 150 and max(sizes[80:]) < 1.5 * max(sizes[20:80])


def test_the_past_is_bounded_and_what_happened_stays_true():
    past = ()
    for at in range(3 * RECENT):
        past = with_statement(past, Compound(("eat", "human", "biscuits" if at == 0 else f"food{at % 7}")), float(at))
    assert len(past) <= RECENT + 8
    assert (Compound(("eat", "human", "biscuits")), 0.0) in past
    for at in range(2 * MOST):
        past = with_statement(past, Compound(("eat", "human", f"new{at}")), float(at))
    assert len(past) <= MOST
