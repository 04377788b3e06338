"""Every extension of the paper's recogniser against brute force, on random plans and observations."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise
from math import isclose, prod

import pytest
from brute_force import Told, explanations, rows
from hypothesis import given
from hypothesis import strategies as st
from tellers import Counting

from casper.engine.explanation.explanation import Explanation
from casper.engine.verification.matching import NameMatcher, ParameterMatcher
from casper.engine.verification.observation import Observation, Uncertain
from casper.kb.terms.terms import Compound, Variable
from casper.plans.library import PlanLibrary
from casper.plans.trees.nodes import Action, Node, Shape, Task
from casper.plans.trees.plan import Plan

THINGS = ("cup", "pot", Variable("P"), Variable("Q"))
MATCHERS = st.sampled_from([NameMatcher, ParameterMatcher])
PRICES = st.sampled_from([0.1, 0.5, 1.0])


@st.composite
def nodes(draw: st.DrawFn, room: int, depth: int = 2) -> Node:
    """A node with at most ``room`` leaves, any shape allowed."""
    kind = draw(st.sampled_from(["action", "sequence", "optional", "choice", "unordered", "steps"])) if depth and room > 1 else "action"
    if kind == "action":
        return Action(Compound((draw(st.sampled_from("abc")), draw(st.sampled_from(THINGS)))))
    count = draw(st.integers(1, min(3, room)))
    children = tuple(draw(nodes(room // count, depth - 1)) for _ in range(count))
    pairs = [(a, b) for a in range(count) for b in range(a + 1, count)]
    order = draw(st.frozensets(st.sampled_from(pairs))) if kind == "steps" and pairs else frozenset()
    return Shape(kind, children, order)


@st.composite
def plans(draw: st.DrawFn, label: str, room: int = 5) -> Plan:
    """A plan that cannot be empty: its last leaf is always done."""
    first = draw(nodes(room - 1))
    last = Action(Compound((draw(st.sampled_from("abc")), draw(st.sampled_from(THINGS)))))
    return Plan(label, Task(Compound((label, Variable("P"))), (first, last)))


@st.composite
def chains(draw: st.DrawFn, label: str, room: int = 6) -> Plan:
    actions = st.builds(lambda n, t: Action(Compound((n, t))), st.sampled_from("abc"), st.sampled_from(THINGS))
    return Plan(label, Task(Compound((label, Variable("P"))), tuple(draw(st.lists(actions, min_size=1, max_size=room)))))


def libraries(of, most: int = 3):
    return st.lists(st.sampled_from("ghk"), min_size=1, max_size=most).flatmap(
        lambda labels: st.tuples(*(of(label) for label in labels))
    )


SEEN = st.builds(Observation, st.sampled_from("abc"), st.sampled_from([None, ("cup",), ("pot",), (Variable("Unknown"),)]))


def certain(seen):
    return [[(observation, 1.0)] for observation in seen]


def counted(library, seen, matcher, noise=None, priors=None):
    counting = Counting(library, matcher(library), noise, priors)
    for observation in seen:
        counting.observe(observation)
    return counting


def marks_of(found: Explanation, length: int) -> tuple[int, ...]:
    leaves = iter(found.marks)
    return tuple(-1 if at in found.needless else next(leaves) for at in range(length))


def weight(told: Told, noise=None, priors=None, options=None) -> float:
    needless = len(told.marks) - told.observed
    likelihood = prod(options[at][o][1] for at, o in enumerate(told.options) if told.marks[at] >= 0) if options else 1.0
    return told.score * (noise or 1.0) ** needless * likelihood * (priors[told.plan] if priors else 1.0)


def agree(counting: Counting, specified: list[Told], noise=None, priors=None, options=None) -> None:
    """Counts exactly; every explanation with its score; best first; posterior and standing."""
    weigh = lambda told: weight(told, noise, priors, options)  # noqa: E731
    length = len(counting.observations)
    found = list(counting.explanations())
    assert counting.count == len(specified) == len(found)
    key = lambda plan, marks, binding: (plan, marks, repr(binding))  # noqa: E731
    mine = Counter(key(counting.kernel.plans.index(f.plan), marks_of(f, length), f.binding) for f in found)
    assert mine == Counter(key(t.plan, t.marks, t.binding) for t in specified)
    weights = [f.score * counting.kernel.priors[counting.kernel.plans.index(f.plan)] for f in found]
    assert all(a > b - 1e-12 for a, b in pairwise(weights))
    for mine_weight, theirs in zip(weights, sorted(map(weigh, specified), reverse=True)):
        assert isclose(mine_weight, theirs, rel_tol=1e-9)
    whole = sum(map(weigh, specified))
    for label, share in counting.posterior().items():
        part = sum(weigh(t) for t in specified if counting.kernel.plans[t.plan].label == label)
        assert isclose(share, part / whole if whole else 0.0, rel_tol=1e-9, abs_tol=1e-12)
    standing = counting.standing()
    assert (standing is None) == (not specified)
    if standing is not None:
        top = max(map(weigh, specified))
        best = [t for t in specified if isclose(weigh(t), top, rel_tol=1e-12)]
        assert standing.best_goal in {counting.kernel.plans[t.plan].label for t in best}
        if options is None:
            assert standing.rivals == sum(counting.kernel.plans[t.plan].label != standing.best_goal for t in best)
            assert standing.ties == len(best)


def distinct(library):
    return tuple(Plan(plan.label, plan.root, way) for way, plan in enumerate(library))


@given(libraries(plans), st.lists(SEEN, min_size=1, max_size=4), MATCHERS)
def test_shapes_are_explained_as_the_orders_and_parts_they_allow(library, seen, matcher):
    library = distinct(library)
    agree(counted(library, seen, matcher), explanations(library, certain(seen), matcher(library), False))


@given(libraries(plans), st.lists(SEEN, min_size=1, max_size=3))
def test_the_leaves_of_an_explanation_have_the_statuses_that_its_score_says(library, seen):
    counting = counted(library, seen, NameMatcher)
    for found in counting.explanations():
        statuses = Counter(found.status)
        skipped = len(found.plan.leaves) - statuses["observed"] - statuses["missed"]
        assert statuses["observed"] == len(seen)
        sizes = range(len(found.plan.leaves) - skipped, len(found.plan.leaves) + 1)  # open optional parts may be left out
        assert any(isclose(found.score, len(seen) * (n - statuses["missed"]) / n**2) for n in sizes)


@given(libraries(chains), st.lists(SEEN, min_size=1, max_size=4), MATCHERS, PRICES)
def test_needless_observations_of_a_chain_cost_their_price(library, seen, matcher, price):
    library = distinct(library)
    agree(counted(library, seen, matcher, price), explanations(library, certain(seen), matcher(library), True), price)


@given(libraries(plans, 2), st.lists(SEEN, min_size=1, max_size=3), MATCHERS, PRICES)
def test_needless_observations_of_any_shape_cost_their_price(library, seen, matcher, price):
    library = distinct(library)
    agree(counted(library, seen, matcher, price), explanations(library, certain(seen), matcher(library), True), price)


@given(libraries(chains), st.lists(SEEN, min_size=1, max_size=4), st.data())
def test_priors_weigh_the_goals(library, seen, data):
    library = distinct(library)
    priors = {label: data.draw(st.sampled_from([0.1, 0.3, 0.6])) for label in {plan.label for plan in library}}
    by_plan = [priors[plan.label] for plan in library]
    specified = explanations(library, certain(seen), ParameterMatcher(library), False)
    agree(counted(library, seen, ParameterMatcher, priors=by_plan), specified, priors=by_plan)


OPTIONS = st.lists(st.tuples(SEEN, st.sampled_from([0.1, 0.25, 0.5])), min_size=1, max_size=2, unique_by=lambda o: o[0])


@given(libraries(plans, 2), st.lists(OPTIONS, min_size=1, max_size=3), st.sampled_from([None, 0.5]))
def test_uncertain_observations_weigh_by_the_likelihood_of_what_they_are_taken_for(library, options, noise):
    library = distinct(library)
    seen = [Uncertain(tuple(option)) for option in options]
    specified = explanations(library, options, ParameterMatcher(library), noise is not None)
    agree(counted(library, seen, ParameterMatcher, noise), specified, noise, options=options)


@given(libraries(chains), st.lists(SEEN, min_size=1, max_size=3), OPTIONS)
def test_an_uncertain_observation_after_certain_ones(library, seen, last):
    library = distinct(library)
    specified = explanations(library, [*certain(seen), last], ParameterMatcher(library), False)
    counting = counted(library, [*seen, Uncertain(tuple(last))], ParameterMatcher)
    agree(counting, specified, options=[*certain(seen), last])


BODIES = st.recursive(
    st.sampled_from(["a", "b", "c", "t"]),
    lambda inner: st.one_of(
        st.tuples(inner, inner).map("({0[0]}, {0[1]})".format),
        st.tuples(inner, inner).map("({0[0]} ; {0[1]})".format),
        inner.map("optional({})".format),
        st.tuples(inner, inner).map("unordered({0[0]}, {0[1]})".format),
        st.tuples(inner, inner, inner).map("steps([x: {0[0]}, y: {0[1]}, z: {0[2]}], [x < z])".format),
        st.tuples(inner, st.integers(0, 1), st.integers(1, 2)).map("repeat({0[0]}, {0[1]}, {0[2]})".format),
    ),
    max_leaves=4,
)


@given(BODIES)
def test_the_shapes_that_are_kept_stand_for_the_plans_that_are_spelled_out(body):
    library = PlanLibrary.from_text(f"goal(g). g --> {body}, d. t --> a, b. t --> c.")
    kept = Counter(
        " ".join(str(plan.leaves[leaf].functor) for leaf in leaves) for plan in library.ways for leaves, _ in rows(plan)[0]
    )
    assert kept == Counter(" ".join(leaf.functor for leaf in plan.leaves) for plan in library.plans)


@given(BODIES, st.lists(st.sampled_from("abcd").map(Observation), min_size=1, max_size=3))
def test_alternatives_and_repetition_equal_brute_force(body, seen):
    library = PlanLibrary.from_text(f"goal(g). g --> {body}, d. t --> a, b. t --> c.").ways
    agree(counted(library, seen, NameMatcher), explanations(library, certain(seen), NameMatcher(library), False))


@given(st.integers(0, 4), st.lists(st.sampled_from("ab").map(Observation), min_size=1, max_size=3))
def test_a_recursive_task_is_unrolled_as_deep_as_is_stated(depth, seen):
    text = f"setting(plans, recursion, {depth}). goal(g). g --> t, b. t --> a, t. t --> a."
    if depth == 0:
        return
    library = PlanLibrary.from_text(text)
    assert sorted(len(plan.leaves) for plan in library.plans) == list(range(2, depth + 3))
    agree(
        counted(library.ways, seen, NameMatcher),
        explanations(library.ways, certain(seen), NameMatcher(library.ways), False),
    )
    assert PlanLibrary.from_text(library.to_text()).plans == library.plans


@given(libraries(plans, 2), st.lists(SEEN, min_size=1, max_size=3), SEEN, st.sampled_from([None, 0.5]))
def test_a_fork_goes_its_own_way_and_undo_comes_back(library, seen, more, noise):
    counting = counted(library, seen, ParameterMatcher, noise)
    before = (counting.count, counting.posterior(), list(counting.explanations()))
    other = counting.fork()
    other.observe(more)
    assert (counting.count, counting.posterior(), list(counting.explanations())) == before
    other.undo()
    assert (other.count, other.posterior(), list(other.explanations())) == before


def test_seventeen_partly_ordered_steps_are_one_plan():
    names = [f"s{n}" for n in range(17)]
    pairs = ", ".join(f"{names[n]} < {names[n + 3]}" for n in range(14))
    text = f"goal(g). g --> steps([{', '.join(f'{n}: do_{n}' for n in names)}], [{pairs}])."
    (plan,) = PlanLibrary.from_text(text).ways
    counting = Counting([plan], NameMatcher([plan]))
    for name in ("s4", "s1"):
        counting.observe(Observation(f"do_{name}"))
    assert counting.count == 0  # s1 comes before s4
    counting = Counting([plan], NameMatcher([plan]))
    for name in ("s4", "s0", "s5"):
        counting.observe(Observation(f"do_{name}"))
    (found,) = counting.explanations()
    assert Counter(found.status) == {"observed": 3, "missed": 2, "unobserved": 12}


@pytest.mark.parametrize(
    ("body", "sentence"),
    [
        ("repeat(a, 2, 1)", "repeat takes an item and two whole numbers"),
        ("repeat(a, 0, 0)", "repeat takes an item and two whole numbers"),
        ("repeat(a)", "repeat takes an item and two whole numbers"),
        ("repeat(a, 1)", "repeat takes an item and two whole numbers"),
        ("repeat(a, x, 3)", "repeat takes an item and two whole numbers"),
        ("repeat(a, 0, 3)", "a plan of g has no action at all"),
    ],
)
def test_a_repetition_without_bounds_is_refused(body, sentence):
    from casper.kb.errors import PlanError

    with pytest.raises(PlanError, match=sentence):
        PlanLibrary.from_text(f"goal(g). g --> {body}.")
