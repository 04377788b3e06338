"""Facts in bulk: they are facts like others, go to columns when they are many, and what follows from them is bounded."""

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.bottom_up import materialise as fixpoints
from casper.kb.errors import BudgetExceeded, ProgramError
from casper.kb.terms.terms import Compound


def ruled(*rules: str) -> KnowledgeBase:
    base = KnowledgeBase()
    for rule in rules:
        base.rule(rule)
    return base


def test_a_large_removal_is_recomputed_and_right(monkeypatch):
    from casper.kb.bottom_up import incremental

    monkeypatch.setattr(incremental, "LEAST_TO_RECOMPUTE", 10)
    base = ruled("path(X, Y) :- edge(X, Y).", "path(X, Y) :- path(X, Z), edge(Z, Y).")
    base.facts("edge", [(i, (i + 1) % 20) for i in range(20)])
    assert len(list(base.rows("path", 2))) == 400
    assert not base.depends_on_history  # worked out before, and not in the way of working out anew
    base.retract(("edge", 19, 0))
    assert len(list(base.rows("path", 2))) == 190


def test_bulk_facts_are_facts_like_others():
    base = ruled("path(X, Y) :- edge(X, Y)", "path(X, Y) :- path(X, Z), edge(Z, Y)")
    base.facts("edge", [("a", "b"), ("b", "c")])
    assert base.ask("path(a, c)")
    assert "edge(b, c)" in str(base.why("path(a, c)"))
    assert KnowledgeBase.from_text(base.to_text()).ask("path(a, c)")
    assert base.retract(("edge", "b", "c"))
    assert not base.ask("path(a, c)")


@pytest.mark.parametrize("rows", [[("a",), ("b", "c")], [(Compound(("f", "a")),), ()]])
def test_bulk_rows_of_different_lengths_are_refused(rows):
    with pytest.raises(ProgramError, match="columns"):
        KnowledgeBase().facts("p", rows)


def test_a_large_base_goes_to_columns_and_answers_without_decoding():
    base = ruled("path(X, Y) :- edge(X, Y).", "path(X, Y) :- path(X, Z), edge(Z, Y).")
    base.facts("edge", [(i, i + 1) for i in range(fixpoints.COLUMNS_FROM)])
    relation = base.stored(("path", 2))
    count = fixpoints.COLUMNS_FROM
    assert len(relation) == count * (count + 1) // 2
    assert base.ask(("path", 0, count)) and not base.ask(("path", count, 0)) and not base.ask(("path", 0, "nowhere"))
    assert relation._table is not None


def test_a_program_that_derives_too_much_is_stopped(monkeypatch):
    base = ruled("pair(X, Y) :- n(X), n(Y).")
    base.facts("n", [(i,) for i in range(3000)])
    monkeypatch.setattr(fixpoints.materialise, "__defaults__", (10_000,))
    with pytest.raises(BudgetExceeded, match="pair/2 has most of them"):
        base.compile()
