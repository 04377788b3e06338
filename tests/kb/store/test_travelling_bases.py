"""Bases that are copied or sent to other processes: the same is stated there, and both go their own ways."""

from __future__ import annotations

import copy
import pickle

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.store.model import Model

TEXT = """
:- table(far(_, min)).
:- stored(far/2).
:- dynamic([edge/3, seen/1]).
far(a, 0).
far(Y, D) :- far(X, C), edge(X, Y, W), D is C + W.
wave(X) :- far(X, _).
human(ann).
"""
WAYS = {
    "pickled": lambda base: pickle.loads(pickle.dumps(base)),
    "copied": copy.deepcopy,
    "of a snapshot": lambda base: pickle.loads(pickle.dumps(base.snapshot())),
}


def base():
    made = KnowledgeBase.from_text(TEXT)
    made.facts("edge", [("a", "b", 2)])
    made.declare_statements([("wave", 1)])
    return made


@pytest.mark.parametrize("way", WAYS.values(), ids=WAYS.keys())
def test_the_same_is_stated_there(way):
    here, there = base(), way(base())
    assert type(there) is KnowledgeBase and len(there) == len(here)
    assert set(there.rows("far", 2)) == {("a", 0), ("b", 2)}
    assert [str(answer["S"]) for answer in there.query("valid(S)")] == ["wave(a)", "wave(b)"]
    assert there.to_text() == here.to_text() and list(there.declared) == [("wave", 1)]


@pytest.mark.parametrize("way", WAYS.values(), ids=WAYS.keys())
def test_both_go_their_own_ways(way):
    here = base()
    there = way(here)
    assert there.retract("edge(a, b, 2)") and there.assert_("edge(a, c, 7)") and there.assert_("seen(b)")
    assert set(there.rows("far", 2)) == {("a", 0), ("c", 7)}
    assert set(here.rows("far", 2)) == {("a", 0), ("b", 2)} and not here.ask("seen(b)")
    assert here.assert_("edge(a, d, 1)") and not there.ask("far(d, 1)")


def test_facts_of_a_long_text_arrive_with_their_places():
    here = KnowledgeBase.from_text("\n".join(f"edge({at}, {at + 1})." for at in range(3_000)), "edges.pl")
    there = pickle.loads(pickle.dumps(here))
    assert str(there.why("edge(7, 8)")) == str(here.why("edge(7, 8)")) == "edge(7, 8)   [given]   [edges.pl:8]"


def test_what_is_declared_is_printed_before_the_clauses():
    assert base().to_text().splitlines()[:3] == [":- dynamic(edge / 3).", ":- dynamic(seen / 1).", ":- stored(far / 2)."]
    again = KnowledgeBase.from_text(base().to_text())
    assert set(again.rows("far", 2)) == {("a", 0), ("b", 2)}


def test_a_change_that_is_broken_off_half_way_leaves_no_half_known_rows(monkeypatch):
    made = base()
    assert set(made.rows("far", 2)) == {("a", 0), ("b", 2)}
    with monkeypatch.context() as patched:
        patched.setattr(Model, "change", broken_off)
        with pytest.raises(KeyboardInterrupt):
            made.assert_("edge(b, c, 1)")
    assert set(made.rows("far", 2)) == {("a", 0), ("b", 2), ("c", 3)}  # it was stated


def broken_off(model, indicator, row, clause, *, add):
    """A change that is interrupted when some rows are gone."""
    model.relations["far", 2].remove(("b", 2))
    raise KeyboardInterrupt
