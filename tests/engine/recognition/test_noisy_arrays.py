"""Needless observations for large libraries of chains: arrays against the counting engine."""

from __future__ import annotations

import random
from itertools import islice, zip_longest
from math import comb

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tellers import Counting, observed
from test_extensions import PRICES, chains, distinct, libraries
from test_fast_engines import NAMES, plain

from casper.engine.recognition.scoring import least_tie
from casper.engine.verification.matching import NameMatcher, ParameterMatcher
from casper.engine.verification.observation import Observation, Uncertain
from casper.kb.terms.terms import Compound, Variable
from casper.plans.trees.nodes import Action, Task
from casper.plans.trees.plan import Plan

pytest.importorskip("numpy")
from tellers import NoisyArrays

LIBRARIES = libraries(chains, 4).map(distinct)  # of one goal there may be several plans, of any lengths


def priors_of(library):
    return [0.1 * (1 + ord(plan.label[0]) % 3) for plan in library]


def both(library, price, priors=None):
    matcher = NameMatcher(library)
    return NoisyArrays(library, matcher, price, priors), Counting(library, matcher, price, priors)


def told(found):
    return [(f.plan.label, f.plan.way, f.marks, f.needless, f.score, f.binding) for f in found]


def state(engine):
    """All that an engine says, exactly."""
    level = len(engine.observations)
    says = (engine.count, list(engine.kernel.masses(engine.level)), dict(engine.posterior()), engine.standing(), engine.best())
    return (*says, engine.alive(level), told(islice(engine.explanations(), 20)))


def masses(engine):
    return engine.kernel.masses(engine.level)


def agree(fast, slow):
    assert fast.count == slow.count
    assert list(masses(fast)) == pytest.approx(list(masses(slow)), rel=1e-12, abs=0)
    assert dict(fast.posterior()) == pytest.approx(slow.posterior(), rel=1e-12, abs=0)
    assert list(fast.posterior()) == list(slow.posterior())
    assert fast.standing() == slow.standing()
    for level in range(len(fast.observations) + 1):
        assert fast.alive(level) == slow.alive(level)


@given(LIBRARIES, NAMES, PRICES, st.booleans())
def test_arrays_give_the_answers_of_the_counting_engine(library, seen, price, weighed):
    fast, slow = both(library, price, priors_of(library) if weighed else None)
    for observation in seen:
        observed((fast, slow), [observation])
        agree(fast, slow)


@given(LIBRARIES, NAMES, PRICES, st.booleans())
def test_arrays_list_all_explanations_in_the_order_of_the_counting_engine(library, seen, price, weighed):
    fast, slow = observed(both(library, price, priors_of(library) if weighed else None), seen)
    ours, theirs = list(fast.explanations()), list(slow.explanations())
    assert told(ours) == told(theirs)
    assert [f.share for f in ours] == pytest.approx([f.share for f in theirs], rel=1e-12, abs=0)


@given(LIBRARIES, NAMES, PRICES, st.booleans())
def test_the_best_of_each_plan_and_of_all_is_the_heaviest_group_of_the_counting_engine(library, seen, price, weighed):
    fast, slow = observed(both(library, price, priors_of(library) if weighed else None), seen)
    tops, ties = {}, 0
    groups = sorted(slow.kernel.weighed(slow.level), key=lambda group: (-group[0], group[1]))
    for weight, plans, _, number, _ in groups:
        tops.setdefault(plans, weight)  # the heaviest come first
        ties += number if weight >= least_tie(groups[0][0]) else 0
    assert {plans: weight for weight, plans in fast.kernel.tops(fast.level)} == tops
    assert fast.best() == slow.best() == (None if not groups else groups[0][:2])
    assert ties == (fast.standing().ties if groups else 0)


@given(LIBRARIES, NAMES, PRICES, st.booleans())
def test_explanations_end_where_those_of_the_counting_engine_do(library, seen, price, weighed):
    fast, slow = observed(both(library, price, priors_of(library) if weighed else None), seen)
    ours, theirs = list(fast.ends()), list(slow.ends())
    assert [parts for parts, _ in ours] == [parts for parts, _ in theirs]
    assert sorted(share for _, share in ours) == pytest.approx(sorted(share for _, share in theirs), rel=1e-12, abs=0)


@given(LIBRARIES, NAMES, NAMES, PRICES)
def test_undo_comes_back_to_the_very_same_figures(library, seen, more, price):
    fast, _ = both(library, price)
    states = [state(fast)]
    for observation in [*seen, *more]:
        fast.observe(observation)
        states.append(state(fast))
    for _ in more:
        states.pop()
        fast.undo()
        assert state(fast) == states[-1]
    for observation in reversed(more):
        fast.observe(observation)
    anew, _ = both(library, price)
    for observation in [*seen, *reversed(more)]:
        anew.observe(observation)
    assert state(fast) == state(anew)


@given(LIBRARIES, NAMES, NAMES, NAMES, PRICES)
def test_forks_that_take_turns_do_not_disturb_each_other(library, seen, mine, yours, price):
    first, _ = both(library, price)
    for observation in seen:
        first.observe(observation)
    second = first.fork()
    for here, there in zip_longest(mine, yours):
        if here is not None:
            first.observe(here)
        if there is not None:
            second.observe(there)
    for fork, went in ((first, mine), (second, yours)):
        alone, _ = both(library, price)
        for observation in [*seen, *went]:
            alone.observe(observation)
        assert state(fork) == state(alone)


@pytest.mark.parametrize("seed", range(6))
def test_arrays_agree_with_the_counting_engine_on_many_goals_and_longer_readings(seed):
    chance = random.Random(seed)
    names = "abcdefgh"[: chance.randint(2, 8)]
    rows = [chance.choices(names, k=chance.randint(1, 14)) for _ in range(80)]
    library = distinct([plain(f"g{n % 60}", *row) for n, row in enumerate(rows)])
    fast, slow = both(library, chance.choice([0.05, 0.3, 1.0]), priors_of(library) if seed % 2 else None)
    for _ in range(9):
        observation = Observation(chance.choice(names))
        observed((fast, slow), [observation])
        agree(fast, slow)
    assert told(islice(fast.explanations(), 100)) == told(islice(slow.explanations(), 100))


@pytest.mark.parametrize("length", [5, 8, 16, 33, 34, 90])
def test_counts_are_exact_where_they_outgrow_every_kind_of_integer(length):
    library = [plain(f"g{n}", *"a" * length) for n in range(3)]
    fast, _ = both(library, 0.5)
    for k in range(1, length + 1):
        fast.observe(Observation("a"))
        assert fast.count == 3 * (comb(length + k, k) - 1)  # all needless is none


def test_a_long_plan_among_short_ones_agrees_with_the_counting_engine_beyond_64_bits():
    library = [plain("long", *"aab" * 30), plain("short", *"ab"), plain("other", *"ba" * 30), plain("long", *"a" * 70)]
    library = distinct(library)
    fast, slow = both(library, 0.7, [0.2, 0.5, 0.3, 0.2])
    for name in "abaab" * 8:
        observed((fast, slow), [Observation(name)])
    agree(fast, slow)
    assert fast.count > 2**64
    assert told(islice(fast.explanations(), 3)) == told(islice(slow.explanations(), 3))
    for _ in range(38):
        fast.undo()
        slow.undo()
    observed((fast, slow), [Observation("b")])
    agree(fast, slow)


@given(LIBRARIES, NAMES, st.sampled_from([1e-5, 1e-60, 1e-110, 1e-160, 1e-250, 5e-324]))
def test_a_price_that_underflows_leaves_everything_else_as_it_is(library, seen, price):
    fast, slow = both(library, price)
    for observation in seen:
        observed((fast, slow), [observation])
        assert (fast.count, fast.standing()) == (slow.count, slow.standing())
        assert dict(fast.posterior()) == pytest.approx(slow.posterior(), rel=1e-12, abs=1e-300)
        assert sum(fast.posterior().values()) == pytest.approx(1.0 if fast.count else 0.0)
    assert len(list(fast.explanations())) == fast.count


def test_weights_that_differ_by_rounding_only_tie():
    fast, slow = both([plain("g", *"ab"), plain("h", *"abb")], 0.7, [0.2, 0.3])  # 0.2 / 2 and 0.3 / 3: one bit apart
    for name in "accc":
        observed((fast, slow), [Observation(name)])
        assert fast.standing() == slow.standing()
        assert (fast.standing().rivals, fast.standing().ties) == (1, 2)


def test_unlike_weights_stay_unlike_however_many_observations_are_needless():
    library = [plain("g", *"abbb"), plain("h", *"abbbb")]
    fast, slow = both(library, 2**-8)
    for name in "a" + "c" * 160:  # 2 ** -1280 is no float
        observed((fast, slow), [Observation(name)])
        assert fast.standing() == slow.standing()
    assert (fast.standing().best_goal, fast.standing().rivals) == ("g", 0)
    assert dict(fast.posterior()) == pytest.approx(slow.posterior(), rel=1e-12)
    assert fast.posterior()["g"] == pytest.approx((1 / 4) / (1 / 4 + 1 / 5))
    assert told([fast.first()]) == told([slow.first()])


@given(LIBRARIES, NAMES, PRICES, st.booleans())
def test_the_first_explanation_is_found_without_listing_any(library, seen, price, weighed):
    fast, slow = both(library, price, priors_of(library) if weighed else None)
    for observation in seen:
        observed((fast, slow), [observation])
        assert fast.first() == next(fast.explanations(), None)
        for goal in "ghk":
            ours, theirs = fast.first(goal), slow.first(goal)
            assert (ours is None) == (theirs is None)
            if ours is not None:
                assert told([ours]) == told([theirs])


def test_an_action_that_no_plan_has_is_needless():
    library = [plain("g", *"ab"), plain("h", *"b")]
    fast, slow = both(library, 0.1)
    observed((fast, slow), [Observation("unknown")])
    agree(fast, slow)
    assert (fast.count, fast.standing(), fast.best(), list(fast.explanations())) == (0, None, None, [])
    for engine in (fast, slow):
        engine.observe(Observation("b"))
    agree(fast, slow)
    assert fast.count == 2


def test_before_anything_is_observed_every_plan_counts():
    fast, slow = both([plain("g", *"ab"), plain("h", *"b")], 0.1)
    agree_on = (fast.count, fast.alive(0), dict(fast.posterior()), list(masses(fast)))
    assert agree_on == (slow.count, slow.alive(0), slow.posterior(), masses(slow))
    assert (fast.standing(), list(fast.explanations()), list(fast.ends())) == (None, [], [])


def test_parameters_that_only_the_goal_has_stay_unknown():
    leaves = tuple(Action(Compound((name,))) for name in "ab")
    library = [Plan("g", Task(Compound(("g", Variable("P"))), leaves)), plain("h", *"ba")]
    fast, slow = (engine(library, ParameterMatcher(library), 0.1) for engine in (NoisyArrays, Counting))
    for engine in (fast, slow):
        engine.observe(Observation("b"))
    assert told(fast.explanations()) == told(slow.explanations())
    assert [parts for parts, _ in fast.ends()] == [parts for parts, _ in slow.ends()]


@given(LIBRARIES, NAMES, PRICES)
def test_an_uncertain_action_is_counted_with_the_same_price_and_priors(library, seen, price):
    fast, slow = both(library, price, priors_of(library))
    unsure = Uncertain(((Observation("a"), 0.6), (Observation("b"), 0.4)))
    observed((fast, slow), [*seen, unsure])
    assert fast.kernel.weighed(fast.level) == slow.kernel.weighed(slow.level)
