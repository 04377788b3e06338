"""Relations with their undefined rows laid in: what a negation must not find to be absent."""

from casper.kb.base import KnowledgeBase
from casper.kb.relations.undefined import Possible, UndefinedRows, are_settled, possible
from casper.kb.terms.unknown import UNKNOWN

TEXT = "e(a, b). e(c, c). w(X, Y) :- e(X, Y), \\+ w(Y, X). u(X) :- e(X, _), Y is 1 / 0, Y > 1."


def relations():
    return KnowledgeBase.from_text(TEXT)._model.relations


def test_what_holds_and_what_may_hold_is_there_and_nothing_else():
    found = possible(relations()["w", 2])
    assert list(found) == [("a", "b"), ("c", "c")] and len(found) == 2
    assert ("a", "b") in found and ("c", "c") in found and ("b", "a") not in found
    assert [list(found.matching((0,), (name,))) for name in "abc"] == [[("a", "b")], [], [("c", "c")]]


def test_a_relation_without_undefined_rows_stays_itself():
    known = relations()
    laid_in = Possible(known)
    assert laid_in["e", 2] is known["e", 2] and laid_in["w", 2] is laid_in["w", 2] is not known["w", 2]


def test_predicates_are_settled_that_have_no_undefined_row():
    known = relations()
    assert are_settled(known, [("e", 2), ("nobody", 1)]) and not are_settled(known, [("e", 2), ("u", 1)])


def test_a_row_with_an_unknown_part_may_be_any_that_fits():
    rows = UndefinedRows("p", 2, [("a", UNKNOWN), ("b", "c")])
    assert [rows.may_hold(row) for row in (("a", "x"), ("b", "c"), ("b", "x"), ("c", "c"))] == [
        True,
        True,
        False,
        False,
    ]
