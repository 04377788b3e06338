"""What needs what, worked out in one pass, against the plain definitions: repeat until nothing changes."""

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper.kb.base import KnowledgeBase
from casper.kb.program.strata import circular, components, components_of, dependents, levels_of, needs, negative_circles
from casper.kb.terms.clauses import Clause, Literal
from casper.kb.terms.terms import Compound

NAMES = "abcdef"
conditions = st.builds(lambda name, negated: Literal(Compound((name,)), negated), st.sampled_from(NAMES + "x"), st.booleans())
mostly_positive = st.builds(lambda name: Literal(Compound((name,))), st.sampled_from(NAMES + "x"))
bodies = st.lists(st.one_of(mostly_positive, mostly_positive, conditions), max_size=2).map(tuple)
tables = st.dictionaries(
    st.sampled_from(NAMES).map(lambda name: (name, 0)),
    st.lists(bodies.map(lambda body: Clause(Compound(("head",)), body)), max_size=2).map(tuple),
    max_size=len(NAMES),
)


def dependents_by_definition(table, roots):
    reached = set()
    while True:
        new = {i for i, clauses in table.items() if any(n in roots or n in reached for n in needs(clauses))} - reached
        if not new:
            return reached
        reached |= new


def circles_by_definition(table):
    """The groups of predicates that need one another, where one negates one of its group."""
    above = {i: dependents_by_definition(table, {i}) for i in table}
    group = {i: frozenset({i} | {j for j in table if j in above[i] and i in above[j]}) for i in table}
    negations = [(i, x.needed) for i, clauses in table.items() for c in clauses for x in c.body if x.negated]
    return {group[i] for i, needed in negations if needed in group[i] and needed in above[i] | {i} and i in above[needed]}


def levels_by_definition(table):
    """The least levels that put negations above what they negate, and circles of negation apart from all else."""
    circles = circles_by_definition(table)
    circle_of = {i: circle for circle in circles for i in circle}
    levels = dict.fromkeys(table, 0)
    while True:
        before = dict(levels)
        for indicator, clauses in table.items():
            group = circle_of.get(indicator, {indicator})
            for literal in (x for clause in clauses for x in clause.body if x.needed in levels):
                inside = indicator in circle_of and literal.needed in group
                apart = not inside and (literal.negated or indicator in circle_of or literal.needed in circle_of)
                levels[indicator] = max(levels[indicator], levels[literal.needed] + apart)
            for other in group:
                levels[indicator] = max(levels[indicator], levels[other])
        if levels == before:
            return levels


@given(tables, st.sets(st.sampled_from(NAMES + "x").map(lambda name: (name, 0)), max_size=2))
def test_dependents_are_all_that_lead_to_a_root(table, roots):
    assert dependents(table, roots) == dependents_by_definition(table, roots)


@given(tables)
def test_what_is_circular_depends_on_itself(table):
    assert circular(table, components_of(table)) == {i for i in table if i in dependents_by_definition(table, {i})}


@given(tables)
def test_levels_are_the_least_that_put_negations_above_and_circles_apart(table):
    assert levels_of(table, components_of(table)) == levels_by_definition(table)


@given(tables)
def test_every_circle_of_negation_is_found_and_named_once(table):
    circles = negative_circles(table, components_of(table))
    assert {group for group, _, _ in circles} == circles_by_definition(table)
    assert len({group for group, _, _ in circles}) == len(circles)
    for group, literal, named in circles:
        way = [name.removeprefix("not ") for name in named.split(" needs ")]
        assert way[0] == way[-1] and way[1] == f"{literal.needed[0]}/0" and named.count("not ") == 1
        assert {(name.removesuffix("/0"), 0) for name in way} <= group
        for name, other in pairwise(way):
            assert (other.removesuffix("/0"), 0) in set(needs(table[(name.removesuffix("/0"), 0)]))


@given(st.dictionaries(st.integers(0, 7), st.lists(st.integers(0, 8), max_size=3), max_size=8))
def test_components_are_what_leads_to_one_another_after_what_they_lead_to(graph):
    def led_to(start):
        found, waiting = set(), [start]
        while waiting:
            new = {n for n in graph[waiting.pop()] if n in graph} - found
            found |= new
            waiting += new
        return found

    reach = {node: led_to(node) for node in graph}
    groups = components(graph)
    assert sorted(node for group in groups for node in group) == sorted(graph)
    for at, group in enumerate(groups):
        below = {node for earlier in groups[: at + 1] for node in earlier}
        for node in group:
            assert reach[node] <= below
            assert set(group) == {node} | {other for other in reach[node] if node in reach[other]}


@pytest.mark.parametrize("negation", ["", "\\+ "])
def test_a_chain_of_rules_means_the_same_forwards_and_backwards(negation):
    rules = [f"p{at + 1}(X) :- q(X), {negation}p{at}(X)." for at in range(2000)]
    for order in (rules, rules[::-1]):
        kb = KnowledgeBase.from_text("\n".join(["q(a).", "p0(a).", *order]))
        assert kb.ask("p2000(a)") and kb.ask("p1999(a)") is not bool(negation)
