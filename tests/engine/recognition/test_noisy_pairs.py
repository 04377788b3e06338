"""Two goals at once with needless observations, all pairs in arrays: against the search through hypotheses."""

from __future__ import annotations

import random
from collections import Counter
from itertools import islice, pairwise, zip_longest
from math import comb

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tellers import Interleaving, observed
from test_extensions import PRICES, chains, distinct, libraries
from test_fast_engines import NAMES, by_end, plain
from test_noisy_arrays import priors_of

from casper.engine.verification.matching import NameMatcher, ParameterMatcher
from casper.engine.verification.observation import Observation, Uncertain
from casper.kb.terms.terms import Compound, Variable
from casper.plans.trees.nodes import Action, Task
from casper.plans.trees.plan import Plan

pytest.importorskip("numpy")
from tellers import NoisyPairs

from casper.engine.recognition.arrays.pair_states import fits

LIBRARIES = libraries(lambda label: chains(label, 5), 4).map(distinct)  # of one goal there may be several plans
SMALL = st.sampled_from([1e-5, 1e-60, 1e-110, 1e-160, 1e-250, 5e-324])
NOTHING = 1e-200  # shares below this are what is left of prices that underflow


def both(library, price, priors=None):
    matcher = NameMatcher(library)
    return NoisyPairs(library, matcher, price, priors), Interleaving(library, matcher, 2, price, priors, budget=10**9)


def told(found):
    parts = tuple((part.plan.label, part.plan.way, part.marks, part.binding) for part in found.parts)
    return parts, found.needless, found.score


def state(engine):
    """All that an engine says, exactly."""
    says = (engine.count, dict(engine.posterior()), engine.standing(), engine.alive(len(engine.observations)))
    return (*says, engine.kernel.total(engine.level), by_end(engine), [(told(f), f.share) for f in islice(engine.explanations(), 20)])


def agree(fast, slow):
    assert fast.is_exact and slow.is_exact
    assert fast.count == slow.count
    assert list(fast.posterior()) == list(slow.posterior())
    assert dict(fast.posterior()) == pytest.approx(slow.posterior(), rel=1e-12, abs=NOTHING)
    assert fast.standing() == slow.standing()
    assert len(fast.mismatches) == len(slow.mismatches)
    for level in range(len(fast.observations) + 1):
        assert fast.alive(level) == slow.alive(level)


@given(LIBRARIES, NAMES, PRICES, st.booleans())
def test_all_pairs_in_arrays_give_the_answers_of_the_search(library, seen, price, weighed):
    fast, slow = both(library, price, priors_of(library) if weighed else None)
    agree(fast, slow)
    for observation in seen:
        observed((fast, slow), [observation])
        agree(fast, slow)


@given(LIBRARIES, NAMES, SMALL)
def test_a_price_that_underflows_leaves_counts_and_standing_as_they_are(library, seen, price):
    fast, slow = both(library, price)
    for observation in seen:
        observed((fast, slow), [observation])
        agree(fast, slow)


@given(LIBRARIES, NAMES, st.one_of(PRICES, st.sampled_from([1e-5, 1e-60])), st.booleans())
def test_all_explanations_are_listed_once_and_best_first(library, seen, price, weighed):
    priors = priors_of(library) if weighed else [1.0] * len(library)
    fast, slow = observed(both(library, price, priors), seen)
    ours, theirs = list(fast.explanations()), list(slow.explanations())
    assert len(ours) == fast.count
    scores = {told(f)[:2]: f.score for f in theirs}
    assert {told(f)[:2]: f.score for f in ours} == pytest.approx(scores, rel=1e-12, abs=0)
    shares = [f.share for f in ours]
    assert all(after <= share * (1 + 1e-12) for share, after in pairwise(shares))
    assert shares == pytest.approx([f.share for f in theirs], rel=1e-12, abs=NOTHING)
    assert all(part.share == f.share for f in ours for part in f.parts)
    assert Counter(f.missed for f in ours) == Counter(f.missed for f in theirs)


@given(LIBRARIES, NAMES, PRICES, st.booleans())
def test_the_first_is_the_best_of_the_plans_that_stand_first(library, seen, price, weighed):
    fast, slow = observed(both(library, price, priors_of(library) if weighed else None), seen)
    best, theirs = fast.first(), slow.first()
    assert best == next(fast.explanations(), None)
    assert (best is None) == (theirs is None)
    if best is not None:
        assert best.goal == fast.standing().best_goal
        assert best.share == pytest.approx(theirs.share, rel=1e-12, abs=0)


@given(LIBRARIES, NAMES, PRICES)
def test_the_first_of_some_goals_is_the_best_of_these(library, seen, price):
    fast, slow = observed(both(library, price, priors_of(library)), seen)
    shares = {}
    for found in slow.explanations():
        shares.setdefault(found.goal, found.share)
    for goal, share in shares.items():
        assert fast.first(goal).goal == goal
        assert fast.first(goal).share == pytest.approx(share, rel=1e-12, abs=0)
    assert fast.first("no goal") is None


@given(LIBRARIES, NAMES, PRICES, st.booleans())
def test_explanations_end_where_those_of_the_search_do(library, seen, price, weighed):
    fast, slow = observed(both(library, price, priors_of(library) if weighed else None), seen)
    assert by_end(fast) == pytest.approx(by_end(slow), rel=1e-12, abs=0)


@given(LIBRARIES, NAMES, NAMES, PRICES)
def test_undo_comes_back_to_the_very_same_figures(library, seen, more, price):
    fast = both(library, price)[0]
    states = [state(fast)]
    for observation in [*seen, *more]:
        fast.observe(observation)
        states.append(state(fast))
    for _ in more:
        states.pop()
        fast.undo()
        assert state(fast) == states[-1]
    observed([fast], reversed(more))
    (anew,) = observed([both(library, price)[0]], [*seen, *reversed(more)])
    assert state(fast) == state(anew)


@given(LIBRARIES, NAMES, NAMES, NAMES, PRICES)
def test_forks_that_take_turns_do_not_disturb_each_other(library, seen, mine, yours, price):
    (first,) = observed([both(library, price)[0]], seen)
    second = first.fork()
    for turn in zip_longest(mine, yours):
        for fork, observation in zip((first, second), turn):
            if observation is not None:
                fork.observe(observation)
    third = second.fork()
    while third.observations:
        third.undo()
    for fork, went in ((first, [*seen, *mine]), (second, [*seen, *yours]), (third, [])):
        (alone,) = observed([both(library, price)[0]], went)
        assert state(fork) == state(alone)


@pytest.mark.parametrize("seed", range(6))
def test_arrays_agree_with_the_search_on_more_goals_and_longer_readings(seed):
    chance = random.Random(seed)
    names = "abcdefgh"[: chance.randint(3, 8)]
    rows = [chance.choices(names, k=chance.randint(1, 8)) for _ in range(9)]
    library = distinct([plain(f"g{n % 7}", *row) for n, row in enumerate(rows)])
    fast, slow = both(library, chance.choice([0.05, 0.3, 1.0]), priors_of(library) if seed % 2 else None)
    for _ in range(7):
        observed((fast, slow), [Observation(chance.choice(names))])
        agree(fast, slow)
    assert by_end(fast) == pytest.approx(by_end(slow), rel=1e-12, abs=0)


def ways(length, k):
    """Of k observations, all of one name: ways to mark leaves of one of two such plans, or of both."""
    alone = comb(length + k, k) - 1
    shared = sum(
        comb(k, i) * comb(k - i, j) * comb(length, i) * comb(length, j)
        for i in range(1, k)
        for j in range(1, k - i + 1)
    )
    return 2 * alone + shared


@pytest.mark.parametrize("length", [1, 4, 9, 24])
def test_counts_are_exact_where_they_outgrow_every_kind_of_integer(length):
    library = [plain("g", *"a" * length), plain("h", *"a" * length)]
    fast, _ = both(library, 0.5)
    for k in range(1, 25):
        fast.observe(Observation("a"))
        assert fast.count == ways(length, k)
    assert sum(share for _, share in fast.ends()) == pytest.approx(1.0)
    standing = fast.standing()
    assert standing.best_missed == 0
    assert fast.first().missed == 0


def test_plans_of_very_different_lengths_agree_with_the_search():
    library = [plain("long", *"aab" * 6), plain("short", *"ab"), plain("other", *"b" * 9), plain("long", *"c")]
    fast, slow = both(distinct(library), 0.7, [0.2, 0.5, 0.3, 0.2])
    for name in "abaabcbb":
        observed((fast, slow), [Observation(name)])
        agree(fast, slow)


def test_one_goal_has_no_pairs():
    fast, slow = both(distinct([plain("g", *"ab"), plain("g", *"ba")]), 0.3)
    for name in "abab":
        observed((fast, slow), [Observation(name)])
        agree(fast, slow)


def test_an_action_that_no_plan_has_is_needless():
    fast, slow = both([plain("g", *"ab"), plain("h", *"b")], 0.1)
    observed((fast, slow), [Observation("unknown")])
    agree(fast, slow)
    assert (fast.count, fast.standing(), fast.first(), list(fast.explanations())) == (0, None, None, [])
    for name in ("b", "unknown", "a", "b"):
        observed((fast, slow), [Observation(name)])
        agree(fast, slow)
        assert by_end(fast) == pytest.approx(by_end(slow), rel=1e-12, abs=0)


def test_of_explanations_of_the_best_goals_that_tie_the_one_that_misses_least_counts():
    library = [plain("g", *"abxxcx"), plain("h", *"x" * 9)]  # price 1: a third mark may cost what it misses
    fast, slow = both(library, 1.0)
    for name in "abcb":
        observed((fast, slow), [Observation(name)])
        agree(fast, slow)
    standing = fast.standing()
    assert (standing.best_goal, standing.best_missed, standing.ties) == ("g", 0, 3)


def test_weights_that_differ_by_rounding_only_tie():
    library = [plain("g", *"aa"), plain("h", *"bba"), plain("k", "b")]
    fast, slow = both(library, 0.1, [0.3, 0.1, 0.9])
    for name in ("a", "b", "b", "unknown", "b"):
        observed((fast, slow), [Observation(name)])
        agree(fast, slow)
        if len(fast.observations) in (3, 4):
            assert (fast.standing().rivals, fast.standing().ties) == (1, 3)


def test_before_anything_is_observed_every_plan_counts():
    fast, slow = both([plain("g", *"ab"), plain("h", *"b")], 0.1)
    agree(fast, slow)
    assert (fast.count, fast.standing(), list(fast.explanations()), list(fast.ends())) == (2, None, [], [])


def test_parameters_that_only_the_goal_has_stay_unknown():
    leaves = tuple(Action(Compound((name,))) for name in "ab")
    library = [Plan("g", Task(Compound(("g", Variable("P"))), leaves)), plain("h", *"ba")]
    fast = NoisyPairs(library, ParameterMatcher(library), 0.1)
    slow = Interleaving(library, ParameterMatcher(library), 2, 0.1)
    observed((fast, slow), [Observation("b"), Observation("a")])
    assert Counter(map(told, fast.explanations())) == Counter(map(told, slow.explanations()))
    assert by_end(fast) == pytest.approx(by_end(slow), rel=1e-12, abs=0)


@given(LIBRARIES, NAMES, PRICES)
def test_what_is_handed_over_takes_uncertain_observations(library, seen, price):
    fast, slow = observed(both(library, price, priors_of(library)), seen)
    unsure = Uncertain(((Observation("a"), 0.6), (Observation("b"), 0.4)))
    observed((fast, slow), [unsure])
    assert (fast.count, fast.posterior(), fast.standing()) == (slow.count, slow.posterior(), slow.standing())


def test_libraries_whose_pairs_would_fill_the_memory_are_told_apart():
    library = [plain(f"g{n}", *"abcdefghij", "a", "b") for n in range(100)]
    assert fits(library, noisy=True)
    assert fits([plain("g", "a")], noisy=True)
    assert not fits([plain(f"g{n}", *"a" * 12) for n in range(100)], noisy=True)
    assert not fits(library * 100, noisy=True)
    assert fits([plain(f"g{n}", *"a" * 12) for n in range(100)], noisy=False)
