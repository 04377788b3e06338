"""Aggregates over one plain goal are worked out of its predicate's own rows, with the meaning of any other goal."""

from hypothesis import given
from hypothesis import strategies as st

from casper.kb.base import KnowledgeBase

WAYS = ["count", "sum(W)", "min(W)", "max(W)", "bag(W)", "set(X)", "bag(X)", "sum(W * 2)", "min(W, X)", "max(W, X)", "bag(f(X))", "sum(1)"]
GOALS = ["has(G, X, W)", "has(_, X, W)", "has(X, X, W)", "has(a, X, W)", "has(W, X, W)", "has(X, W, W)"]
rows = st.tuples(st.sampled_from("ab"), st.sampled_from([*"ab", 1]), st.sampled_from([0, 1, 2, -1, 2.5, "pi", "a"]))


def totals(kb, name):
    relation = kb.stored((name, 2))
    return {(row, *map(type, row)) for row in relation}, set(relation.undefined or ())


@given(st.sampled_from(WAYS), st.sampled_from(GOALS), st.lists(rows, max_size=6), rows)
def test_a_plain_goal_means_what_it_means_within_a_conjunction(way, goal, given_rows, changed):
    kb = KnowledgeBase.from_text(
        f":- dynamic(has/3). group(a). group(b). group(c). "
        f"plain(G, N) :- group(G), aggregate_all({way}, {goal}, N). "
        f"other(G, N) :- group(G), aggregate_all({way}, ({goal}, true), N)."
    )
    kb.facts("has", given_rows)
    assert totals(kb, "plain") == totals(kb, "other")
    (kb.retract if changed in given_rows else kb.assert_)(("has", *changed))
    assert totals(kb, "plain") == totals(kb, "other")


def test_a_plain_goal_copies_no_rows():
    kb = KnowledgeBase.from_text("has(a, 1). has(a, 2). total(N) :- aggregate_all(count, has(a, _), N). same(N) :- aggregate_all(count, has(X, X), N).")
    assert kb.ask("same(0)") and kb.ask("total(2)")
    made = [name for name, _ in kb._model.program.rules if name.startswith("goal: ")]
    assert len(made) == 1  # of the goal that compares two columns


def test_a_group_is_looked_at_once():
    kb = KnowledgeBase.from_text("total(G, N) :- group(G), aggregate_all(sum(W), has(G, _, W), N). :- dynamic([group/1, has/3]).")
    kb.facts("group", [(at,) for at in range(10)])
    kb.facts("has", [(at % 10, at, 1) for at in range(200)])
    assert sorted(kb.rows("total", 2)) == [(at, 20) for at in range(10)]
    assert kb.stored(("has", 3)).touched == 200
