"""Facts that come and go: what a change says of itself, and what is known afterwards."""

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.errors import ProgramError

TEXT = "human(ann). agent(X) :- human(X). never(\"nobody waves\") :- claim(wave(_)). wave(X) :- agent(X)."


def base():
    return KnowledgeBase.from_text(TEXT)


def test_a_change_says_whether_it_changed_anything():
    kb = base()
    assert kb.assert_("human(bob)") is True
    assert kb.assert_("human(bob)") is False
    assert kb.retract("human(bob)") is True
    assert kb.retract("human(bob)") is False
    assert kb.retract("human(nobody)") is False


def test_every_change_is_counted_and_none_that_changes_nothing():
    kb = base()
    before = kb.changes
    kb.assert_("human(bob)")
    assert kb.changes == before + 1
    kb.assert_("human(bob)")
    assert kb.changes == before + 1


def test_what_follows_from_a_fact_comes_and_goes_with_it():
    kb = base()
    assert not kb.ask("agent(bob)")
    kb.assert_("human(bob)")
    assert kb.ask("agent(bob)") and ("bob",) in set(kb.rows("agent", 1))
    kb.retract("human(bob)")
    assert not kb.ask("agent(bob)") and kb.ask("agent(ann)")


def test_a_fact_that_a_rule_gives_too_stays_when_it_is_taken_back():
    kb = KnowledgeBase.from_text("human(ann). agent(ann). agent(X) :- human(X).")
    kb.retract("agent(ann)")
    assert kb.ask("agent(ann)")


def test_a_fact_of_a_new_predicate_is_known_at_once():
    kb = base()
    assert kb.assert_("child(tom)") is True
    assert kb.ask("child(tom)")
    assert kb.retract("child(tom)") is True
    assert not kb.ask("child(tom)")  # and still a predicate that is known


def test_only_ground_facts_come_and_go():
    with pytest.raises(ProgramError, match="only ground facts can be changed"):
        base().assert_("human(X)")
    with pytest.raises(ProgramError, match="has a variable; state a rule"):
        base().fact("human(X)")


def test_rows_of_different_lengths_and_open_rows_are_refused():
    with pytest.raises(ProgramError, match="the rows of edge have 1 and 2 columns"):
        base().facts("edge", [("a", "b"), ("a",)])
    kb = base()
    kb.facts("edge", [("a", "b"), ("b", "c"), ("a", "b")])
    assert sorted(kb.rows("edge", 2)) == [("a", "b"), ("b", "c")]
    assert kb.retract("edge(a, b)") and not kb.ask("edge(a, b)")
    assert not kb.assert_("edge(b, c)")
    kb.facts("nothing", [])
    assert list(kb.rows("nothing", 1)) == []


def test_more_rows_of_a_predicate_join_those_that_were_loaded():
    kb = base()
    kb.facts("edge", [("a", "b")])
    assert kb.ask("edge(a, b)")
    kb.facts("edge", [("b", "c")])
    assert sorted(kb.rows("edge", 2)) == [("a", "b"), ("b", "c")]


def test_the_clauses_of_a_predicate_are_its_facts_and_its_rules():
    kb = KnowledgeBase.from_text("human(ann). human(X) :- robot(X). robot(rob).")
    assert [str(c.head) for c in kb.clauses_of(("human", 1))] == ["human(ann)", "human(X)"]
    assert list(kb.clauses_of(("nobody", 1))) == []
    assert kb.defines("human", 1) and not kb.defines("human", 2)


def test_a_rule_may_come_with_or_without_its_full_stop():
    kb = base()
    kb.rule("helper(X) :- agent(X)")
    kb.rule("friend(X) :- agent(X). ")
    assert kb.ask("helper(ann)") and kb.ask("friend(ann)")


def test_only_what_looks_back_depends_on_the_history():
    assert not base().depends_on_history
    assert KnowledgeBase.from_text("p :- did(wave(_), _).").depends_on_history


def test_a_base_is_as_long_as_it_has_clauses_and_says_so():
    assert len(base()) == 4
    assert repr(base()) == "<KnowledgeBase: 4 clauses>"


def test_declared_statements_are_what_valid_lists():
    kb = KnowledgeBase.from_text("human(ann). agent(X) :- human(X). wave(X) :- agent(X).")
    assert [str(a["S"]) for a in kb.query("valid(S)")] == ["agent(ann)", "wave(ann)"]
    kb.declare_statements([("wave", 1)])
    assert [str(a["S"]) for a in kb.query("valid(S)")] == ["wave(ann)"]


def test_a_broken_constraint_of_the_facts_is_a_row_of_never():
    kb = KnowledgeBase.from_text('food(mug). vessel(mug). never("not both") :- food(X), vessel(X).')
    assert [a["S"] for a in kb.query("never(S)")] == ["not both"]
    assert kb.ask('never("not both")') and not kb.ask("never(other)")
    assert [v.sentence for v in kb.broken()] == ["not both"]


@pytest.mark.parametrize("directive", ["dynamic(p)", "dynamic(p/x)", "dynamic(p/ -1)", "fast(p/1)", "dynamic(p/1, q)"])
def test_a_directive_nobody_knows_is_refused(directive):
    with pytest.raises(ProgramError, match="the only directive is"):
        KnowledgeBase.from_text(f":- {directive}.")


def test_a_predicate_without_arguments_may_be_dynamic():
    kb = KnowledgeBase.from_text(":- dynamic(rain/0). wet :- rain.")
    assert not kb.ask("wet")
    kb.assert_("rain")
    assert kb.ask("wet")
    assert kb.to_text() == ":- dynamic(rain / 0).\nwet :- rain.\nrain.\n"


def test_a_plan_belongs_elsewhere():
    with pytest.raises(ProgramError, match="belongs in a plan library"):
        KnowledgeBase.from_text("tea --> boil.")


def test_what_is_stated_later_is_counted_as_a_change():
    kb = base()
    before = kb.changes
    kb.fact("human(bob)")
    assert kb.changes == before + 1
    kb.facts("edge", [("a", "b")])
    assert kb.changes == before + 2
    kb.facts("edge", [])
    assert kb.changes == before + 2
