"""One fact more or less: what follows from it, from something else, or from itself, and what may not be changed."""

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.errors import ProgramError


def test_a_fact_given_twice_is_given_once():
    base = KnowledgeBase.from_text("food(tea).")
    assert not base.assert_("food(tea)")
    assert base.retract("food(tea)")
    assert not base.ask("food(tea)")


def test_what_still_follows_from_something_else_stays():
    base = KnowledgeBase.from_text("hot(X) :- boiled(X). hot(X) :- baked(X). boiled(pie). baked(pie).")
    base.retract("boiled(pie)")
    assert base.ask("hot(pie)")
    assert "baked(pie)" in str(base.why("hot(pie)"))


def test_a_loop_does_not_keep_itself_alive():
    base = KnowledgeBase.from_text("on(X) :- wired(Y, X), on(Y). on(X) :- plug(X). plug(a). wired(a, b). wired(b, a).")
    base.retract("plug(a)")
    assert list(base.query("on(X)")) == []


def test_a_derived_fact_is_not_a_given_one_and_cannot_be_retracted():
    base = KnowledgeBase.from_text("agent(X) :- human(X). human(ann).")
    assert not base.retract("agent(ann)")
    assert base.ask("agent(ann)")


def test_a_new_predicate_can_be_asserted():
    base = KnowledgeBase.from_text("human(ann).")
    assert base.assert_("tired(ann)")
    assert base.ask("tired(ann)")


def test_only_ground_facts_can_be_changed():
    with pytest.raises(ProgramError, match="has a variable"):
        KnowledgeBase.from_text("human(ann).").assert_("human(X)")


def test_a_constraint_is_judged_anew_after_a_change():
    base = KnowledgeBase.from_text('never("both") :- food(X), vessel(X). food(a). vessel(b). eat(X) :- food(X).')
    assert base.verify("eat(a)").valid
    base.assert_("vessel(a)")
    assert base.verify("eat(a)").reasons == ("both",)
    base.retract("vessel(a)")
    assert base.verify("eat(a)").valid
