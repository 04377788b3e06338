"""Conjunction and disjunction: fair, flat, and at home with kanren's own goals."""

from itertools import islice

from hypothesis import given
from hypothesis import strategies as st
from kanren import eq as kanren_eq
from kanren import lall as kanren_lall
from kanren import run as kanren_run
from kanren import var
from kanren.constraints import neq

from casper.kb.base import KnowledgeBase
from casper.kb.goals.streams import conde, delay, eq, lall, lany, run

X, Y = var(), var()


def ones(x):
    """x is 1, again and again without end."""
    return lany(eq(x, 1), delay(ones, x))


def natural(n):
    m = var()
    return conde([eq(n, "z")], [eq(n, ("s", m)), delay(natural, m)])


def test_without_goals_a_conjunction_holds_and_a_disjunction_does_not():
    assert run(0, X, lall(), eq(X, 1)) == (1,)
    assert run(0, X, lany(), eq(X, 1)) == ()


def test_an_endless_stream_starves_nobody():
    assert 2 in run(10, X, lany(ones(X), eq(X, 2)))
    assert run(1, X, lall(ones(Y), eq(X, 3))) == (3,)


def test_numbers_come_one_after_the_other():
    assert run(3, X, natural(X)) == ("z", ("s", "z"), ("s", ("s", "z")))


def test_a_long_chain_of_goals_is_no_matter():
    assert run(0, X, lall(*[eq(X, 1)] * 5000)) == (1,)


def test_a_long_recursion_is_no_matter():
    kb = KnowledgeBase.from_text(" ".join(f"e({i}, {i + 1})." for i in range(1500)))

    def path(a, b):
        z = var()
        return conde([kb.e(a, b)], [kb.e(a, z), delay(path, z, b)])

    assert len(run(0, X, path(0, X))) == 1500


def test_a_conjunction_touches_each_state_once_however_many_there_are():
    kb = KnowledgeBase.from_text(" ".join(f"e({i})." for i in range(3000)))
    calls = []

    def count(state):
        calls.append(1)
        return iter((state,))

    assert len(run(0, X, lall(kb.e(X), count))) == 3000
    assert len(calls) == 3000


def test_composed_goals_mix_with_kanrens():
    assert kanren_run(0, X, kanren_lall(lany(eq(X, 1), eq(X, 2)), kanren_eq(X, 2))) == (2,)
    assert run(0, X, kanren_lall(kanren_eq(X, 1)), lany(eq(X, 1), eq(X, 2))) == (1,)


def test_constraints_are_kept():
    assert run(0, X, neq(X, 1), lany(eq(X, 1), eq(X, 2))) == (2,)
    assert run(0, X, lany(eq(X, 1), eq(X, 2)), neq(X, 1)) == (2,)


def test_none_asks_lazily():
    assert list(islice(run(None, X, natural(X)), 2)) == ["z", ("s", "z")]


goals = st.recursive(
    st.builds(lambda variable, value: ("eq", variable, value), st.sampled_from([0, 1]), st.integers(0, 2)),
    lambda inner: st.tuples(st.sampled_from(["all", "any"]), st.lists(inner, max_size=3)),
    max_leaves=8,
)


def built(goal, eq_, lall_, lany_):
    if goal[0] == "eq":
        return eq_((X, Y)[goal[1]], goal[2])
    return (lall_ if goal[0] == "all" else lany_)(*(built(g, eq_, lall_, lany_) for g in goal[1]))


def meant(goal, x, y):
    if goal[0] == "eq":
        return (x, y)[goal[1]] == goal[2]
    return (all if goal[0] == "all" else any)(meant(g, x, y) for g in goal[1])


@given(goals)
def test_the_answers_are_those_that_logic_gives(goal):
    ground = lany(*(lall(eq(X, x), eq(Y, y)) for x in range(3) for y in range(3)))
    found = set(run(0, (X, Y), built(goal, eq, lall, lany), ground))
    assert found == {(x, y) for x in range(3) for y in range(3) if meant(goal, x, y)}


def test_the_relation_is_a_drop_in_that_keeps_disequalities_and_uses_its_index():
    from casper.kb.goals import minikanren as mk

    edge = mk.Relation("edge")
    mk.facts(edge, *[(i, i + 1) for i in range(500)])
    mk.fact(edge, 0, 7)
    assert set(mk.run(0, X, edge(0, X))) == {1, 7}
    assert mk.run(0, X, mk.neq(X, 1), edge(0, X)) == (7,)
    assert mk.run(0, X, edge(0, X), mk.neq(X, 1)) == (7,)
    rows = edge._rows(2)
    before = rows.touched
    assert mk.run(0, Y, mk.eq(X, 250), edge(X, Y)) == (251,)
    assert rows.touched - before == 1
    assert len(edge.facts) == 501
    assert kanren_run(0, X, edge(X, 7)) in ((0, 6), (6, 0))
