"""What a base knows by heart decides only what it can: names and numbers that stand in its rows."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from programs import BASE, DERIVED, programs

from casper.kb.base import KnowledgeBase
from casper.kb.errors import Undefined
from casper.kb.store.known import known_of, looked_up
from casper.kb.terms.terms import Compound, Variable

VALUES = st.sampled_from(["a", "b", "c", "elsewhere", 0, 1, 1.0, True, ("f", "a"), Compound(("f", Variable("X"))), Variable("X")])


def asked_often(text):
    base = KnowledgeBase.from_text(text)
    for _ in range(3):
        base.ask("human(ann)")
    return base


def truth(base, statement):
    try:
        return base.ask(statement)
    except Undefined:
        return None


@given(programs(circles=True), st.lists(st.tuples(st.sampled_from([*BASE.items(), *DERIVED.items()]), st.tuples(VALUES, VALUES)), max_size=8))
def test_it_says_what_a_search_says(text, statements):
    base = KnowledgeBase.from_text(text)
    for _ in range(2):
        for (name, arity), values in statements:
            statement = (name, *values[:arity])
            expected = {"true": True, "false": False, "undefined": None}[base.truth(statement)]
            assert truth(base, statement) is expected
    assert base._known.lengths.keys() <= {name for name, _ in base._model.program.clauses}


def test_a_first_no_is_known_and_not_remembered():
    base = asked_often("human(ann). robot(tiago).")
    assert not base.ask(("human", "tiago")) and not base._false
    assert not base.ask(("human", "nobody")) and base._false == {("human", "nobody")}


def test_a_statement_with_something_open_is_not_decided_by_it():
    base = asked_often("human(ann). likes(ann, tea).")
    assert base.ask(("likes", "ann", Variable("What")))
    assert not base.ask(("likes", "tea", Variable("What")))


def test_one_look_at_the_rows_decides_what_has_nothing_open():
    at_hand = KnowledgeBase.from_text("size(1). size(f(a)). human(ann).")._model.at_hand
    stated = [("size", 1), ("size", ("f", "a")), ("human", "ann")]
    others = [("size", 2), ("size", ("f", "b")), ("human", "bob")]
    left = [("size", Variable("X")), ("size", ("f", Variable("X"))), ("human", Variable("X")), ("robot", "ann")]
    assert [looked_up(statement, at_hand) for statement in stated] == [True] * 3
    assert [looked_up(statement, at_hand) for statement in others] == [False] * 3
    assert [looked_up(statement, at_hand) for statement in left] == [None] * 4


def test_a_name_with_two_arities_is_not_decided_by_it():
    base = asked_often("human(ann). human(ann, bob).")
    assert base._known.lengths == {}
    assert not base.ask(("human", "bob")) and base.ask(("human", "ann", "bob"))


def test_a_text_is_never_taken_for_a_statement_of_signs():
    base = asked_often("human(ann). e(a, '(', 'x', ')').  e('e', '(', 'a', ')').")
    assert base.ask("e(a, '(', x, ')')") and not base.ask("e(x, '(', x, ')')")


def test_it_is_forgotten_with_every_change():
    base = asked_often("human(ann). :- dynamic(human/1). robot(tiago).")
    assert not base.ask(("human", "tiago"))
    base.assert_("human(tiago)")
    assert base.ask(("human", "tiago"))
    base.retract("human(tiago)")
    assert not base.ask(("human", "tiago"))


def test_undefined_rows_are_never_a_no():
    base = asked_often("human(ann). win(X) :- move(X, Y), \\+ win(Y). move(a, a). move(b, c).")
    assert "win" not in base._known.lengths and "move" in base._known.lengths
    with pytest.raises(Undefined):
        base.ask(("win", "a"))


@pytest.mark.parametrize("statement", [(), ("human", ["ann"]), ["human", "ann"], 7])
def test_what_is_no_statement_is_refused(statement):
    with pytest.raises(TypeError):
        asked_often("human(ann).").ask(statement)


def test_too_many_rows_are_not_kept_in_one_set(monkeypatch):
    base = KnowledgeBase.from_text("human(ann). human(bob).")
    assert len(known_of(base._model.relations).true) == 2
    monkeypatch.setattr("casper.kb.store.known.MOST_INDEXED", 2)
    assert len(known_of(base._model.relations).true) == 2
    monkeypatch.setattr("casper.kb.store.known.MOST_INDEXED", 1)
    assert not known_of(base._model.relations).true


def test_a_given_fact_of_a_predicate_with_rules_needs_no_search():
    base = KnowledgeBase()
    base.rule("p(X) :- q(X)")
    base.facts("q", [(at,) for at in range(6_000)])
    base.facts("p", [("a",)])
    at_hand = base._model.at_hand
    assert base._model.listed is None
    assert [looked_up(statement, at_hand) for statement in (("p", "a"), ("p", 3), ("q", 3), ("q", "a"))] == [True, None, True, False]
    assert base.ask(("p", 3)) and not base.ask(("p", "b"))


def test_a_query_is_read_and_checked_once_for_a_program():
    base = KnowledgeBase.from_text(":- dynamic(human/1). human(ann).")
    first = base._model.query("human(X)")
    base.assert_("human(bob)")
    assert base._model.query("human(X)") is first and base.snapshot()._model.query("human(X)") is first
    base.rule("robot(X) :- human(X)")
    assert base._model.query("human(X)") is not first
