"""Directives: what they declare, in each of the ways to write a list, and what is refused."""

from __future__ import annotations

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.errors import ProgramError
from casper.kb.program.declarations import Declaration, Moded, declaration, tabled
from casper.kb.text.reader import read_text


def declared(text):
    found = [declaration(directive) for directive in read_text(text)]
    dynamic, stored = (tuple(i for each in found for i in getattr(each, kind)) for kind in ("dynamic", "stored"))
    return Declaration(dynamic, stored, {i: mode for each in found for i, mode in each.least.items()})


@pytest.mark.parametrize("listed", ["([a/1, b/2, c/0])", "((a/1, b/2, c/0))", "(((a/1, b/2), c/0))"])
@pytest.mark.parametrize("kind", ["dynamic", "stored"])
def test_predicates_are_listed_in_any_way(kind, listed):
    found = declared(f":- {kind}{listed}.")
    assert getattr(found, kind) == (("a", 1), ("b", 2), ("c", 0))
    assert found == Declaration(**{kind: getattr(found, kind)})


def test_dynamic_is_an_operator_too():
    assert declared(":- dynamic a/1, b/2.").dynamic == (("a", 1), ("b", 2))


def test_what_is_only_for_other_systems_declares_nothing():
    assert declared(":- discontiguous(a/1).") == declared(":- table(a/1).") == Declaration()


@pytest.mark.parametrize(
    ("term", "least"),
    [
        ("far(_, min)", {("far", 2): Moded(1, "min")}),
        ("far(max, _, _)", {("far", 3): Moded(0, "max")}),
        ("far(min)", {("far", 1): Moded(0, "min")}),
        ("[far(_, min), p/1, near(_, max)]", {("far", 2): Moded(1, "min"), ("near", 2): Moded(1, "max")}),
        ("(p/1, far(index, min))", {("far", 2): Moded(1, "min")}),
        ("far(_, _)", {}),
        ("far(index, _)", {}),
    ],
)
def test_a_table_may_keep_the_least_or_the_greatest(term, least):
    assert declared(f":- table({term}).") == Declaration(least=least)


@pytest.mark.parametrize("term", ["5", "x", "far(min, max)", "far(_, first)", "[p/1, x]", "far(_, 1)", "p/one", "[far(_, min), x]"])
def test_a_table_of_anything_else_is_refused(term):
    with pytest.raises(ProgramError, match=r"1:1: table needs name/arity or path\(_, _, min\)$"):
        declared(f":- table({term}).")


@pytest.mark.parametrize("kind", ["stored", "discontiguous"])
@pytest.mark.parametrize("term", ["5", "x", "a/b", "a/1.0", "a/(-1)", "1/1", "[a/1, b]", "far(_, min)"])
def test_what_is_no_predicate_is_refused(kind, term):
    with pytest.raises(ProgramError, match=f"1:1: {kind} needs name/arity$"):
        declared(f":- {kind}({term}).")


@pytest.mark.parametrize("text", [":- dynamic(a/(-1)).", ":- dynamic(x).", ":- module(a, b).", ":- dynamic(a/1, b/1, 2)."])
def test_other_directives_are_refused_with_the_one_that_is_meant(text):
    with pytest.raises(ProgramError, match=r"1:1: the only directive is :- dynamic\(name/arity\), not "):
        declared(text)


def test_a_moded_argument_is_declared_as_it_is_written():
    assert str(tabled(("far", 3), Moded(1, "max"))).replace("_#0", "_").replace("_#2", "_") == ":- table(far(_, max, _))."
    assert declaration(tabled(("far", 2), Moded(1, "min"))) == Declaration(least={("far", 2): Moded(1, "min")})


def test_the_best_row_of_each_key_is_kept():
    base = KnowledgeBase.from_text(":- table((p/1, far(_, min), near(max, _))). p(1). far(a, 1). far(a, 0). near(1, a). near(2, a).")
    assert (list(base.rows("far", 2)), list(base.rows("near", 2))) == ([("a", 0)], [(2, "a")])
