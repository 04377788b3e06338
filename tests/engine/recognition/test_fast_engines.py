"""The engines for plain plans by names, and that for several goals, against the counting engine and brute force."""

from __future__ import annotations

from collections import Counter
from itertools import product
from math import isclose

import pytest
from brute_force import explanations
from hypothesis import given
from hypothesis import strategies as st
from tellers import Arrays, Chains, Counting, Interleaving, Pairs, observed
from test_extensions import certain, chains, distinct, libraries, plans

from casper.engine.verification.matching import NameMatcher, ParameterMatcher
from casper.engine.verification.observation import Observation
from casper.kb.terms.terms import Compound
from casper.plans.trees.nodes import Action, Task
from casper.plans.trees.plan import Plan

pytest.importorskip("numpy")
NAMES = st.lists(st.sampled_from("abc").map(Observation), min_size=1, max_size=5)


def plain(label, *names):
    return Plan(label, Task(Compound((label,)), tuple(Action(Compound((name,))) for name in names)))


def complete(library):
    """With a plan that has every action, as a reading only passes on actions that some plan has."""
    return distinct((*library, plain("all", *"abcab")))


def told(found):
    return [(f.plan.label, f.plan.way, f.marks, f.score) for f in found]


@pytest.mark.parametrize("engine", [Chains, Arrays])
@given(libraries(chains, 4), NAMES, st.booleans())
def test_a_fast_engine_gives_the_answers_of_the_counting_engine(engine, library, seen, weighed):
    library = complete(library)
    priors = [0.1 * (1 + ord(plan.label[0]) % 3) for plan in library] if weighed else None
    fast = engine(library, NameMatcher(library), priors)
    slow = Counting(library, NameMatcher(library), priors=priors)
    for observation in seen:
        observed((fast, slow), [observation])
        assert fast.count == slow.count
        for ours, theirs in zip(fast.kernel.masses(fast.level), slow.kernel.masses(slow.level)):
            assert ours == theirs or (engine is Arrays and isclose(ours, theirs, rel_tol=1e-12))
        assert dict(fast.posterior()) == pytest.approx(slow.posterior(), rel=1e-12)
        assert fast.standing() == slow.standing()
        assert fast.alive(len(fast.observations)) == slow.alive(len(slow.observations))
        assert dict(fast.ends()) == pytest.approx(dict(slow.ends()), rel=1e-12)
    assert fast.first() == next(fast.explanations(), None)
    for goal in "ghk":
        ours, theirs = fast.first(goal), slow.first(goal)
        assert told([ours] if ours else []) == told([theirs] if theirs else [])
    assert told(fast.explanations()) == told(slow.explanations())
    assert fast.best() == slow.best()


@pytest.mark.parametrize("engine", [Chains, Arrays])
@given(libraries(chains, 3), NAMES, NAMES)
def test_undoing_and_forking_a_fast_engine(engine, library, seen, more):
    library = complete(library)
    fast = engine(library, NameMatcher(library))
    for observation in seen:
        fast.observe(observation)
    before = (fast.count, list(fast.kernel.masses(fast.level)), dict(fast.posterior()))
    other = fast.fork()
    for observation in more:
        other.observe(observation)
    assert (fast.count, list(fast.kernel.masses(fast.level)), dict(fast.posterior())) == before
    for _ in more:
        other.undo()
    assert (other.count, list(other.kernel.masses(other.level)), dict(other.posterior())) == before


@pytest.mark.parametrize("engine", [Chains, Arrays])
@pytest.mark.parametrize("length", [64, 66, 67, 90])
def test_counts_are_exact_where_they_no_longer_fit_into_64_bits(engine, length):
    from math import comb

    library = [plain(f"g{n}", *"a" * length) for n in range(3)]
    fast = engine(library, NameMatcher(library))
    for _ in range(length // 2):
        fast.observe(Observation("a"))
    assert fast.count == 3 * comb(length, length // 2)


def joint(library, seen, matcher, noise, goals):
    """Every way to share the observations out among up to so many goals, as (plans, marks) -> score."""
    found = Counter()
    by_subset = {}

    def alone(number, taken):
        if (number, taken) not in by_subset:
            part = certain([seen[at] for at in taken])
            by_subset[number, taken] = [
                t for t in explanations([library[number]], part, Renumbered(matcher, number), False) if t.observed
            ]
        return by_subset[number, taken]

    choices = [*range(len(library)), *([-1] if noise is not None else [])]
    for owners in product(choices, repeat=len(seen)):
        pursued = sorted(set(owners) - {-1})
        labels = [library[number].label for number in pursued]
        if not 0 < len(pursued) <= goals or len(set(labels)) < len(labels):
            continue
        taken = [tuple(at for at, owner in enumerate(owners) if owner == number) for number in pursued]
        for parts in product(*(alone(number, at) for number, at in zip(pursued, taken))):
            leaves, missed = sum(t.leaves for t in parts), sum(t.missed for t in parts)
            observed = sum(t.observed for t in parts)
            score = observed * (leaves - missed) / leaves**2 * (noise or 1.0) ** owners.count(-1)
            found[tuple(pursued), tuple(t.marks for t in parts), tuple(repr(t.binding) for t in parts), score] += 1
    return found


class Renumbered:
    """A matcher of one plan of a library, seen as the only one."""

    def __init__(self, matcher, number):
        self.matcher, self.number = matcher, number

    def initial(self, plan):
        return self.matcher.initial(self.number)

    def match(self, plan, leaf, observation, binding):
        return self.matcher.match(self.number, leaf, observation, binding)


@pytest.mark.parametrize("goals", [2, 3])
@given(
    libraries(lambda label: st.one_of(chains(label, 4), plans(label, 4)), 3),
    NAMES.map(lambda seen: seen[:4]),
    st.sampled_from([NameMatcher, ParameterMatcher]),
    st.sampled_from([None, 0.3]),
)
def test_goals_pursued_at_once_equal_brute_force(goals, library, seen, matcher, noise):
    library = distinct(library)
    engine = Interleaving(library, matcher(library), goals, noise, budget=100_000)
    for observation in seen:
        engine.observe(observation)
    specified = joint(library, seen, matcher(library), noise, goals)
    assert engine.is_exact
    assert engine.count == sum(specified.values())
    found = list(engine.explanations())
    by_plan = [sorted(f.parts, key=lambda part: library.index(part.plan)) for f in found]  # parts stand in the order of goals
    mine = Counter(
        (tuple(library.index(p.plan) for p in parts), tuple(p.marks for p in parts), tuple(repr(p.binding) for p in parts))
        for parts in by_plan
    )
    theirs = Counter()
    for (numbers, marks, bindings, _), times in specified.items():
        theirs[numbers, marks, bindings] += times
    assert mine == theirs
    scores = sorted((s for (_, _, _, s), times in specified.items() for _ in range(times)), reverse=True)
    assert [f.score for f in found] == pytest.approx(scores)
    whole = sum(scores)
    for label, share in engine.posterior().items():
        part = sum(s * n for (numbers, _, _, s), n in specified.items() if label in {library[p].label for p in numbers})
        assert share == pytest.approx(part / whole if whole else 0.0)


@given(libraries(lambda label: chains(label, 4), 3), NAMES, st.integers(1, 4))
def test_a_search_that_drops_hypotheses_says_so_and_gives_a_lower_bound(library, seen, budget):
    library = distinct(library)
    exact = Interleaving(library, NameMatcher(library), 3, budget=100_000)
    bounded = Interleaving(library, NameMatcher(library), 3, budget=budget)
    for observation in seen:
        observed((exact, bounded), [observation])
        assert bounded.count <= exact.count
        assert bounded.count == exact.count or not bounded.is_exact
    told = {(f.goals, f.marks) for f in exact.explanations()}
    assert {(f.goals, f.marks) for f in bounded.explanations()} <= told


@given(libraries(lambda label: plans(label, 5), 3), NAMES, st.integers(1, 4), st.sampled_from([None, 0.3]))
def test_a_count_that_drops_states_says_so_and_gives_a_lower_bound(library, seen, budget, noise):
    library = distinct(library)
    exact = Counting(library, NameMatcher(library), noise)
    bounded = Counting(library, NameMatcher(library), noise, budget=budget)
    for observation in seen:
        observed((exact, bounded), [observation])
        assert bounded.count <= exact.count
        assert bounded.count == exact.count or not bounded.is_exact
        assert sum(map(len, bounded.level.counts.values())) <= budget
    kept, told = list(bounded.explanations()), {(f.plan.way, f.marks, f.needless, f.score) for f in exact.explanations()}
    assert len(kept) == bounded.count
    assert {(f.plan.way, f.marks, f.needless, f.score) for f in kept} <= told
    bounded.undo()
    assert len(bounded.observations) == len(seen) - 1


@given(libraries(lambda label: chains(label, 4), 3), NAMES)
def test_one_goal_at_a_time_is_the_plain_recogniser(library, seen):
    library = distinct(library)
    several, one = Interleaving(library, NameMatcher(library), 1), Counting(library, NameMatcher(library))
    for observation in seen:
        observed((several, one), [observation])
        assert several.count == one.count
        assert several.posterior() == pytest.approx(one.posterior())


def by_end(engine):
    shares = {}
    for parts, share in engine.ends():
        shares[parts] = shares.get(parts, 0.0) + share
    return shares


@given(libraries(lambda label: chains(label, 4), 4), NAMES, st.booleans())
def test_all_pairs_in_an_array_equal_the_search_through_them(library, seen, weighed):
    library = complete(library)
    priors = [0.1 * (1 + ord(plan.label[0]) % 3) for plan in library] if weighed else None
    pairs, search = Pairs(library, NameMatcher(library), priors), Interleaving(library, NameMatcher(library), 2, priors=priors)
    for observation in seen:
        observed((pairs, search), [observation])
        assert pairs.count == search.count
        assert dict(pairs.posterior()) == pytest.approx(search.posterior())
        ours, theirs = pairs.standing(), search.standing()
        assert ours == theirs or (weighed and (ours is None) == (theirs is None))  # priors: ties up to rounding
        assert pairs.alive(len(seen[: len(pairs.observations)])) == search.alive(len(search.observations))
    assert [f.score for f in pairs.explanations()] == pytest.approx([f.score for f in search.explanations()]) or weighed
    assert by_end(pairs) == pytest.approx(by_end(search))
    other = pairs.fork()
    other.observe(seen[0])
    other.undo()
    assert (other.count, dict(other.posterior())) == (pairs.count, dict(pairs.posterior()))


@pytest.mark.parametrize("engine", [Chains, Arrays, Counting, Pairs, Interleaving])
def test_of_equally_good_ways_to_the_best_goal_the_one_that_misses_least_counts(engine):
    library = distinct([plain("g", *"ba"), plain("g", *"aaaa"), plain("h", *"bbbbbbba")])  # 1/2 * 1/2 and 1/4 * 1
    counts = engine(library, NameMatcher(library))
    counts.observe(Observation("a"))
    assert (counts.standing().best_goal, counts.standing().best_missed, counts.standing().ties) == ("g", 0, 2)


def test_hypotheses_that_can_begin_nothing_more_do_not_narrow_the_choice_of_what_others_begin():
    library = distinct([plain(f"g{n}", *"abcab") for n in range(12)])
    engine = Interleaving(library, NameMatcher(library), 2, budget=2_000)
    for name in "abca":
        engine.observe(Observation(name))
        if sum(map(len, engine.level.counts.values())) < 2_000:
            assert engine.is_exact
