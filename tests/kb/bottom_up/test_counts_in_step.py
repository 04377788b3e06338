"""Counts, sums and greatest rows in step with facts that come and go; a change looks at its own group alone."""

from hypothesis import given
from hypothesis import strategies as st
from programs import atoms_of, undefined_of

from casper.kb.base import KnowledgeBase

COUNTS = """
:- dynamic([works/2, room/1, pay/2, boss/2]).
n(R, N) :- room(R), aggregate_all(count, works(_, R), N).
paid(R, S) :- room(R), aggregate_all(sum(P), (works(X, R), pay(X, P)), S).
most(M) :- aggregate_all(max(N, R), n(R, N), M).
crowded(R) :- n(R, N), N > 1, \\+ boss(_, R).
above(X, Y) :- boss(X, Y).
above(X, Z) :- above(X, Y), boss(Y, Z), \\+ crowded(Z).
reach(X, C) :- boss(X, _), aggregate_all(count, above(X, _), C), \\+ room(X).
"""

names = st.sampled_from("abc")

counted = st.one_of(
    st.tuples(st.just("works"), names, names),
    st.tuples(st.just("room"), names),
    st.tuples(st.just("pay"), names, st.sampled_from([1, 2, "much"])),
    st.tuples(st.just("boss"), names, names),
)


@given(st.lists(counted, max_size=8), st.lists(st.tuples(st.booleans(), counted), max_size=8))
def test_counts_and_sums_in_step_with_changes_are_those_of_a_fresh_start(first, later):
    base = KnowledgeBase.from_text(COUNTS)
    for fact in first:
        base.assert_(fact)
    for comes, fact in later:
        base.assert_(fact) if comes else base.retract(fact)
        fresh = KnowledgeBase.from_text(base.to_text())
        assert atoms_of(base._model.relations) == atoms_of(fresh._model.relations)
        assert undefined_of(base._model.relations) == undefined_of(fresh._model.relations)


def test_a_change_of_one_group_looks_at_that_group_alone():
    base = KnowledgeBase.from_text(":- dynamic([works/2, room/1]). n(R, N) :- room(R), aggregate_all(count, works(_, R), N).")
    base.facts("room", [(at,) for at in range(1_000)])
    base.facts("works", [(who, at) for at in range(1_000) for who in "xyz"])
    assert base.assert_(("works", "w", 7)) and base.retract(("works", "x", 8))
    relations = base._model.relations
    before = sum(relation.touched for relation in relations.values())
    assert base.assert_(("works", "w", 17)) and base.retract(("works", "x", 18))
    assert sum(relation.touched for relation in relations.values()) - before < 50
    assert base.ask("n(17, 4)") and base.ask("n(18, 2)") and not base.ask("n(18, 3)")
