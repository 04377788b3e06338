"""Readings beside one another: forks, several partners, a knowledge base that changes under them."""

from __future__ import annotations

import pytest
from readings import KITCHEN, domain, reading

from casper import Domain


def test_a_fork_asks_what_if():
    now = reading("pick_and_place")
    what_if = now.fork()
    what_if.observe("eat")
    assert (now.count, what_if.count) == (7, 3)
    assert what_if.rejected.keys() == {"drink"} and not now.rejected


def test_several_partners_share_a_library_and_not_a_reading():
    base = KITCHEN.reading()
    ann, bob = base.fork(), base.fork()
    ann.observe("sip")
    bob.observe("eat")
    assert (ann.outcome, base.observations) == ("drink", ())
    assert bob.posterior["breakfast"] > 0


def test_readings_of_one_domain_share_what_the_knowledge_base_said(monkeypatch):
    kitchen = Domain.load("kitchen")
    asked = []
    verify = kitchen.kb.verify
    monkeypatch.setattr(kitchen.kb, "verify", lambda *question: asked.append(question) or verify(*question))
    kitchen.reading().observe("pick_and_place(meal, hobs)")
    first = len(asked)
    kitchen.reading().observe("pick_and_place(meal, hobs)")
    assert first == len(asked) > 0


def test_a_change_of_the_knowledge_base_is_seen_by_readings_under_way_and_by_new_ones():
    kitchen = Domain.load("kitchen")
    before = kitchen.reading()
    before.observe("pick_and_place(biscuits, plate)")
    kitchen.reading().observe("eat(biscuits, plate)")
    kitchen.kb.retract("eatable(biscuits)")
    before.observe("eat(biscuits, plate)")
    after = kitchen.reading()
    after.observe("eat(biscuits, plate)")
    assert (before.count, after.count) == (0, 0)
    assert any("eatable" in reason for reason in after.rejected["breakfast"])


def test_where_verdicts_depend_on_the_past_each_reading_asks_for_its_own(tmp_path):
    (tmp_path / "ontology.pl").write_text(
        'human(ann).\nwarm(A) :- human(A).\neat(A) :- human(A).\nnever("first warm it") :- claim(eat(_)), \\+ did(warm(_), _).\n'
    )
    (tmp_path / "plans.pl").write_text("cold --> eat.\nhot --> warm, eat.\n")
    shared = Domain.load(tmp_path)
    hot, cold = shared.reading(), shared.reading()
    hot.observe("warm")
    hot.observe("eat")
    cold.observe("eat")
    assert (hot.count, cold.count) == (1, 0)


def test_a_goal_whose_condition_no_longer_holds_is_cut(tmp_path):
    (tmp_path / "ontology.pl").write_text("human(ann). open(kitchen). a(X) :- human(X). b(X) :- human(X).\n")
    here = domain(tmp_path, "goal(g) :- open(kitchen). goal(h). g --> a, b. h --> a, a, b.\n")
    seen = here.reading()
    seen.observe("a")
    here.kb.retract("open(kitchen)")
    seen.observe("b")
    assert dict(seen.posterior) == {"g": 0.0, "h": 1.0}


def test_an_observation_that_cannot_be_decided_is_taken_in_or_not(monkeypatch):
    seen = reading("pick_and_place")
    monkeypatch.setattr(seen._engine.matcher, "match", lambda *_: 1 / 0)
    before = seen.to_json()
    with pytest.raises(ZeroDivisionError):
        seen.observe("eat")
    monkeypatch.undo()
    assert seen.to_json() == before
    seen.observe("eat")
    assert seen.count == 3
