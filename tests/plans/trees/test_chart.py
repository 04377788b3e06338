"""Charts: what an observation closes, against all the plain plans that a plan stands for."""

from itertools import count

import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper.plans.library import PlanLibrary
from casper.plans.trees.chart import bits, children_before, draw_chart, union
from casper.plans.trees.nodes import actions_below

bodies = st.recursive(
    st.just("action"),
    lambda inner: st.one_of(
        st.tuples(st.sampled_from(["sequence", "choice", "unordered"]), st.lists(inner, min_size=2, max_size=3)),
        st.tuples(st.just("optional"), st.lists(inner, min_size=1, max_size=2)),
        st.tuples(st.just("steps"), st.lists(inner, min_size=2, max_size=3), st.sampled_from(["", "s0 < s1", "s1 < s0"])),
    ),
    max_leaves=6,
)


def text_of(body, names):
    if body == "action":
        return f"a{next(names)}"
    kind, children, *order = body
    parts = [text_of(child, names) for child in children]
    if kind == "steps":
        return f"steps([{', '.join(f's{n}: {part}' for n, part in enumerate(parts))}], [{order[0]}])"
    joined = (" ; " if kind == "choice" else ", ").join(parts)
    return f"({joined})" if kind in ("sequence", "choice") else f"{kind}({joined})"


def library(body):
    return PlanLibrary.from_text(f"goal(g). g --> {body}.")


def plan_of(body):
    (plan,) = library(body).ways
    return plan


def rows_of(plan_library):
    """Every plain plan, as numbers of leaves."""
    numbers = {leaf: at for at, leaf in enumerate(plan_library.ways[0].leaves)}
    return [[numbers[leaf] for leaf in plan.leaves] for plan in plan_library.plans]


def is_part(observed, row):
    rest = iter(row)
    return all(leaf in rest for leaf in observed)


@given(bodies, st.lists(st.integers(0, 100), max_size=4))
def test_what_is_observed_is_explained_by_the_plain_plans_that_hold_it(body, turns):
    found = library("first, " + text_of(body, count()))
    chart, rows = found.ways[0].chart, rows_of(found)
    progress, observed = chart.start, []
    assert progress == (0, 0, min(map(len, rows)), 0)
    for turn in turns:
        still_open = [leaf for leaf in range(chart.leaves) if not progress[0] >> leaf & 1]
        if not still_open:
            break
        observed.append(still_open[turn % len(still_open)])
        progress = chart.close(progress, observed[-1])
        closed, entered, size, missed = progress
        holding = [row for row in rows if is_part(observed, row)]
        assert size == min(map(len, holding))
        assert missed == min(row.index(observed[-1]) + 1 - len(observed) for row in holding)
        assert entered == chart.entered(closed)
        assert {leaf for leaf in bits(chart.certain(closed)) if not closed >> leaf & 1} == {
            leaf for leaf in range(chart.leaves) if not closed >> leaf & 1 and all(leaf in row for row in holding)
        }


@given(bodies, st.lists(st.integers(0, 100), max_size=4))
def test_the_next_leaves_are_those_of_the_plain_plans_that_begin_so(body, turns):
    found = library("first, " + text_of(body, count()))
    chart, rows = found.ways[0].chart, rows_of(found)
    progress, observed = chart.start, []
    for turn in turns:
        following = sorted({row[len(observed)] for row in rows if row[: len(observed)] == observed and len(row) > len(observed)})
        assert chart.next_leaves(progress[0]) == following
        if not following:
            break
        observed.append(following[turn % len(following)])
        progress = chart.close(progress, observed[-1])


@given(bodies)
def test_before_a_leaf_come_those_that_every_plain_plan_with_both_puts_before_it(body):
    found = library("first, " + text_of(body, count()))
    chart, rows = found.ways[0].chart, rows_of(found)
    for leaf in range(chart.leaves):
        for other in range(chart.leaves):
            both = [row for row in rows if leaf in row and other in row and leaf != other]
            if both:
                assert bool(chart.before[leaf] >> other & 1) == all(row.index(other) < row.index(leaf) for row in both)


@given(bodies)
def test_what_comes_directly_before_leads_back_to_all_that_comes_before(body):
    chart = library("first, " + text_of(body, count())).ways[0].chart
    for leaf in range(chart.leaves):
        direct = chart.directly_before(leaf)
        assert union(1 << j | chart.before[j] for j in direct) == chart.before[leaf]
        assert not any(chart.before[j] >> other & 1 for j in direct for other in direct)


@pytest.mark.parametrize(
    ("body", "observed", "coming"),
    [
        ("a, b, c", [], "a b c"),
        ("a, b, c", ["b"], "c"),
        ("a, optional(b), c", [], "a b c"),
        ("a, (b, c ; d), e", [], "a d e"),
        ("a, (b, c ; d), e", ["b"], "c e"),
        ("a, (b, c ; d), e", ["d"], "e"),
        ("a, (b ; d), e", [], "a b e"),
        ("unordered(a, b), c", ["b"], "a c"),
    ],
)
def test_yet_to_come_is_what_stays_open_and_of_a_choice_its_smallest_alternative(body, observed, coming):
    plan = plan_of(body)
    names = [leaf.functor for leaf in plan.leaves]
    progress = plan.chart.start
    for name in observed:
        progress = plan.chart.close(progress, names.index(name))
    assert [names[leaf] for leaf in plan.chart.coming_leaves(progress[0])] == coming.split()


def test_choices_and_their_alternatives_are_numbered_from_zero():
    chart = plan_of("(a ; b ; c), optional(d), (e ; f)").chart
    assert list(chart.choices.values()) == [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1)]
    assert [chart.parts[at].leaves.bit_length() - 1 for at in chart.choices] == [0, 1, 2, 4, 5]


def test_only_leaves_that_stand_in_no_part_are_mandatory():
    chart = plan_of("a, optional(b), (c ; d), e").chart
    assert list(bits(chart.mandatory)) == [0, 4]
    assert list(bits(chart.expected)) == [0, 2, 4]


def test_an_alternative_for_which_another_one_stands_is_spare():
    chart = plan_of("(a, b ; c)").chart
    assert [part.is_spare for part in chart.parts] == [True, False]


def test_plans_without_shapes_share_the_chart_of_their_length():
    assert draw_chart(plan_of("a, b").root) is draw_chart(plan_of("c, d").root)
    assert plan_of("a, b").chart.is_chain
    assert not plan_of("unordered(a, b)").chart.is_chain


def test_every_child_of_steps_knows_all_that_come_before_it():
    (steps,) = plan_of("steps([x: a, y: b, z: c, u: d], [x < y, y < z])").root.children
    assert [leaf.term.functor for leaf in actions_below(steps)] == ["a", "b", "c", "d"]
    assert children_before(steps) == [set(), {0}, {0, 1}, set()]
