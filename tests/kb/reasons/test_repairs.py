"""Repairs: the smallest changes, how they are ordered, and what is beyond mending."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from programs import programs

from casper.kb.base import KnowledgeBase
from casper.kb.reasons.repair import Repair
from casper.kb.terms.terms import Compound


def repairs(text, statement, limit=3, history=()):
    return [str(repair) for repair in KnowledgeBase.from_text(text).repair(statement, history, limit)]


HOME = "human(ann). robot(rob). cup(mug). agent(X) :- human(X). agent(X) :- robot(X). wash(A, V) :- agent(A), cup(V), \\+ broken(V). "


@pytest.mark.parametrize(
    ("text", "statement", "found"),
    [
        (HOME + "broken(jar).", "wash(ann, mug)", []),
        (HOME + "broken(mug).", "wash(ann, mug)", ["remove broken(mug)"]),
        (HOME + "broken(jar).", "wash(ann, jar)", ["add cup(jar) and remove broken(jar)"]),
        (HOME + "broken(jar).", "wash(tom, mug)", ["add human(tom)", "add robot(tom)"]),
        (HOME + "broken(jar).", "wash(tom, pot)", ["add cup(pot) and add human(tom)", "add cup(pot) and add robot(tom)"]),
        (HOME + "broken(jar). never(\"not ann\") :- claim(wash(A, _)), human(A).", "wash(ann, mug)", ["add robot(ann) and remove human(ann)"]),
        (HOME + "broken(jar). tired(ann). never(\"rest\") :- claim(wash(A, _)), tired(A).", "wash(ann, mug)", ["remove tired(ann)"]),
        (HOME + "broken(jar). ready(jar). never(\"get ready\") :- claim(wash(_, V)), \\+ ready(V).", "wash(ann, mug)", ["add ready(mug)"]),
        ("p :- 1 > 2.", "p", []),
        ("p(a).", "q(a)", []),
    ],
)
def test_the_smallest_changes_that_make_a_statement_valid(text, statement, found):
    assert repairs(text, statement) == found


@pytest.mark.parametrize("limit", [0, 1, 2])
def test_no_more_are_told_than_are_asked_for(limit):
    assert len(repairs(HOME + "broken(jar).", "wash(tom, mug)", limit)) == limit


def test_those_that_add_come_before_those_that_remove():
    text = 'p(a). q(a). r(b). go(X) :- p(X). never("clash") :- claim(go(X)), q(X), \\+ r(X).'
    assert repairs(text, "go(a)") == ["add r(a)", "remove q(a)"]


def test_a_repair_counts_and_joins_its_facts():
    a, b = Compound(("a",)), Compound(("b",))
    both = Repair(frozenset({a})).joined(Repair(frozenset(), frozenset({b})))
    assert both == Repair(frozenset({a}), frozenset({b}))
    assert both.size == 2 and Repair().size == 0
    assert both.to_json() == {"add": ["a"], "remove": ["b"]}
    assert str(both) == "add a and remove b"


def test_a_clash_with_a_comparison_ends_when_its_facts_go():
    text = 'far(a, 5). far(b, 1). spot(a). spot(b). go(X) :- spot(X). never("too far") :- claim(go(X)), far(X, N), N > 3.'
    assert repairs(text, "go(a)") == ["remove far(a, 5)"]
    assert repairs(text, "go(b)") == []


def test_changes_that_are_reached_in_two_orders_are_one_repair():
    assert repairs(":- dynamic([a/0, b/0]). go :- a, b. go :- b, a.", "go") == ["add a and add b"]


@given(programs(negation=False), st.sampled_from([("d0", "a"), ("d1", "a", 1), ("d2", "b"), ("d4", 1)]))
def test_a_repair_really_repairs_and_no_smaller_one_is_known(text, statement):
    base = KnowledgeBase.from_text(text)
    found = base.repair(statement)
    for repair in found:
        assert base.changed(repair).ask(statement)
        assert repair.size == found[0].size
        for fact in repair.add:
            assert not base.changed(type(repair)(repair.add - {fact}, repair.remove)).ask(statement)


def test_a_repair_respects_the_constraints():
    text = 'human(ann). robot(tia). eat(X) :- human(X). never("one or the other") :- human(X), robot(X).'
    (repair,) = KnowledgeBase.from_text(text).repair("eat(tia)")
    assert repair.to_json() == {"add": ["human(tia)"], "remove": ["robot(tia)"]}
