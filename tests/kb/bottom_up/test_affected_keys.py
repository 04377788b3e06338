"""A recursive minimum in which something has no value: the keys that it may reach are undefined, the others are not."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from test_least_columns import PROGRAMS, columns_from

from casper.kb.base import KnowledgeBase
from casper.kb.errors import BudgetExceeded
from casper.kb.terms.terms import Compound

UNCERTAIN = "shut(X) :- maybe(X), \\+ shut(X)."  # neither true nor false
NAMES = ["from one", "bounded", "value first", "two", "widest", "two recursive", "turned by a test"]
nodes = st.sampled_from("abcde")
edges = st.lists(st.tuples(nodes, nodes, st.sampled_from([1, 2, 3, "far"])), max_size=8)


def model(text, found, more=""):
    base = KnowledgeBase.from_text(f":- dynamic([edge/3, shut/1, maybe/1]). {more}")
    base.facts("edge", found)
    base.rule(text)
    return base._model


@pytest.mark.parametrize("name", NAMES)
@given(found=edges, instead=st.sampled_from([0, 1, 7, None]), maybe=st.sets(nodes, max_size=2), shut=st.booleans())
def test_what_holds_holds_whatever_the_undefined_turns_out_to_be(name, found, instead, maybe, shut):
    text = PROGRAMS[name]
    if name == "two" and instead is None:
        instead = 2  # it also asks for edges whatever their weight is, so none may be taken away
    if name in ("value first", "widest"):  # in which an edge is a row of its own: there "far" is a value like others
        text = text.replace("edge(X, Y, D).", "edge(X, Y, W), D is W + 0.").replace("edge(a, Y, D).", "edge(a, Y, W), D is W + 0.")
    if name == "two recursive":
        text = text.replace("far(X, Y, D) :- edge(X, Y, D).", "far(X, Y, D) :- edge(X, Y, W), D is W + 0.")
    doubtful = " ".join([UNCERTAIN, *(f"maybe({node})." for node in sorted(maybe))])
    settled = [(x, y, instead if w == "far" else w) for x, y, w in found if w != "far" or instead is not None]
    with columns_from(10**9):
        try:
            uncertain = model(text, found, doubtful)
            certain = model(text, settled, " ".join(f"shut({node})." for node in sorted(maybe) if shut))
            rows = certain.relations
        except BudgetExceeded:
            return
    for indicator in uncertain.program.least:
        doubts = uncertain.relations[indicator].undefined
        for row in uncertain.relations[indicator]:
            assert row in rows[indicator], "certain although it depends"
            assert doubts is None or not doubts.may_hold(row)
        for row in rows[indicator]:
            assert row in uncertain.relations[indicator] or (doubts is not None and doubts.may_hold(row)), "a silent no"


def test_only_what_the_failure_leads_to_is_undefined():
    text = "edge(a, b, 1). edge(b, c, far). edge(c, d, 1). edge(a, e, 5). edge(a, c, 9)."
    base = KnowledgeBase.from_text(f":- dynamic(shut/1). {PROGRAMS['from one']} {text}")
    assert [base.truth(Compound(("far", node, value))) for node, value in (("b", 1), ("e", 5))] == ["true", "true"]
    assert [base.truth(Compound(("far", node, 9))) for node in "cd"] == ["undefined", "undefined"]
    assert base.truth("far(b, 2)") == "false"
