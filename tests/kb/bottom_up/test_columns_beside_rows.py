"""Where columns and rows meet: undefined rows below, joins of derived columns with facts, memory that runs out."""

from __future__ import annotations

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.bottom_up import materialise
from casper.kb.bottom_up.columnar_fixpoint import columnar_fixpoint
from casper.kb.bottom_up.row_fixpoint import row_fixpoint
from casper.kb.errors import BudgetExceeded

GAME = """
e(a, a). e(b, c). e(c, d). e(f, b). k(a). k(b). k(c). k(f). given(d).
win(X) :- e(X, Y), \\+ win(Y).
good(X) :- win(X), k(X).
bad(X) :- k(X), \\+ win(X).
far(X, Z) :- good(X), e(X, Z).
"""


def fixpoints(text):
    program = KnowledgeBase.from_text(text)._model.program
    found = columnar_fixpoint(program, 10**6), row_fixpoint(program, 10**6)
    assert found[0] is not None
    return [{i: (set(relation), set(relation.undefined or ())) for i, relation in each.items()} for each in found]


def test_what_needs_undefined_rows_is_the_same_on_columns_and_on_rows():
    columns, rows = fixpoints(GAME)
    assert columns == rows
    assert columns["win", 1] == ({("c",), ("f",)}, {("a",)})
    assert columns["good", 1] == ({("c",), ("f",)}, {("a",)}) and columns["bad", 1] == ({("b",)}, {("a",)})
    assert columns["far", 2][1] == {("a", "a")}


def test_given_rows_of_a_predicate_in_a_circle_hold_and_come_first():
    columns, rows = fixpoints(GAME + "win(a). win(b).")
    assert columns == rows and columns["win", 1] == ({("a",), ("b",), ("c",)}, set())


def test_two_premises_of_one_rule_in_a_circle_are_both_needed():
    text = "n(1). a(X) :- n(X), \\+ b(X). b(X) :- n(X), \\+ a(X). c(X) :- a(X), d(X). d(X) :- c(X), \\+ b(X). d(X) :- m(X), \\+ c(X). m(2)."
    columns, rows = fixpoints(text)
    assert columns == rows
    assert columns["c", 1] == (set(), set()) and columns["d", 1] == ({(2,)}, set())
    assert columns["a", 1] == columns["b", 1] == (set(), {(1,)})


@pytest.mark.parametrize("size", [0, 10**9], ids=["columns", "rows"])
def test_derived_rows_are_joined_with_facts_of_other_numbers(monkeypatch, size):
    monkeypatch.setattr(materialise, "COLUMNS_FROM", size)
    base = KnowledgeBase.from_text(":- dynamic([e/2, name/2]). up(X, Y) :- e(X, Y). up(X, Z) :- up(X, Y), e(Y, Z).")
    base.facts("e", [(at, at + 1) for at in range(20)])
    base.facts("name", [(f"n{at}", at) for at in range(30, -1, -1)])
    table = base.table("name(N, X), up(X, Y), name(M, Y)")
    found = set(zip(*(table.columns[name] for name in "NM")))
    assert found == {(f"n{one}", f"n{other}") for one in range(21) for other in range(one + 1, 21)}


def test_where_memory_runs_out_the_answer_is_unknown(monkeypatch):
    def full(program, most_rows):
        raise MemoryError

    monkeypatch.setattr(materialise, "_materialised", full)
    with pytest.raises(BudgetExceeded, match="more facts follow than there is memory for: what follows is unknown"):
        KnowledgeBase.from_text("p(a). q(X) :- p(X).").rows("q", 1).__next__()
