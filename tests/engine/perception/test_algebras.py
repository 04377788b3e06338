"""The calculi as relations of the knowledge base: their laws, asked as questions, and what follows of what is said."""

import pytest

from casper import qsr
from casper.engine.perception.algebras import spatial_knowledge
from casper.kb.errors import TraceError


@pytest.fixture(scope="module")
def kb():
    return spatial_knowledge("allen", "rcc8", "cardinal", "qtc_b_line")


def answers(kb, question):
    return list(kb.query(question, limit=3))


LAWS = {
    "turning twice changes nothing": "converse(C, R, S), \\+ converse(C, S, R)",
    "composition turns round with its arguments": (
        "composition(C, R, S, T), converse(C, R, R1), converse(C, S, S1), converse(C, T, T1), \\+ composition(C, S1, R1, T1)"
    ),
    "every relation is a neighbour of its neighbours": "neighbour(C, R, S), \\+ neighbour(C, S, R)",
    "converses of neighbours are neighbours": (
        "neighbour(C, R, S), converse(C, R, R1), converse(C, S, S1), \\+ neighbour(C, R1, S1)"
    ),
    "no relation is a neighbour of itself": "neighbour(C, R, R)",
    "every relation has a converse": "relation(C, R), \\+ converse(C, R, _)",
    "if R and S leave T, then T and the converse of S leave R": (
        "composition(C, R, S, T), converse(C, S, S1), \\+ composition(C, T, S1, R)"
    ),
}


@pytest.mark.parametrize("law", LAWS)
def test_no_relation_breaks_a_law(kb, law):
    assert answers(kb, LAWS[law]) == []


@pytest.mark.parametrize(("calculus", "same"), [("allen", "equals"), ("rcc8", "eq"), ("cardinal", "eq")])
def test_by_way_of_what_is_the_same_a_relation_stays(kb, calculus, same):
    assert answers(kb, f"relation({calculus}, R), composition({calculus}, R, {same}, T), R \\= T") == []
    assert answers(kb, f"relation({calculus}, R), \\+ composition({calculus}, {same}, R, R)") == []


def test_tables_are_asked_in_every_direction(kb):
    assert {row["T"] for row in kb.query("composition(allen, during, overlaps, T)")} == qsr.algebra("allen").compose(
        "during", "overlaps"
    )
    assert {row["R"] for row in kb.query("neighbour(cardinal, R, ne)")} == {"n", "e", "eq"}


SAID = ("holds(rcc8, cup, ntpp, tray)", "holds(rcc8, tray, tpp, board)")


def test_what_follows_is_proved(kb):
    told = kb.assume(*SAID)
    assert told.ask("told(rcc8, board, ntppi, cup)")
    assert "composition(rcc8, ntpp, tpp, ntpp)" in str(told.why("told(rcc8, cup, ntpp, board)"))


def test_what_cannot_be_is_ruled_out_and_a_contradiction_breaks_a_constraint(kb):
    told = kb.assume("holds(allen, breakfast, meets, work)", "holds(allen, work, overlaps, lunch)")
    assert told.ask("ruled_out(allen, breakfast, after, lunch)") and not told.ask(
        "ruled_out(allen, breakfast, before, lunch)"
    )
    assert not told.broken()
    assert "cannot hold at once" in str(told.assume("holds(allen, lunch, before, breakfast)").broken())


def test_an_algebra_that_does_not_exist_is_refused_by_name():
    with pytest.raises(TraceError, match="there is no algebra 'rcc9'"):
        spatial_knowledge("rcc9")
