"""Recursive minima on columns at their bounds: what is refused there, and what a rule may ask of its premise's keys."""

from __future__ import annotations

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.bottom_up.circles import least_columns, minimum
from casper.kb.errors import BudgetExceeded, NotOnColumns, Undefined

FROM_A = ":- table(far(_, min)). far(a, 0). far(Y, D) :- far(X, C), edge(X, Y, W), D is C + W."
LINE = [("a", "b", 1), ("b", "c", 2), ("a", "c", 7), ("c", "d", 1)]
SHORTEST = {("a", 0), ("b", 1), ("c", 3), ("d", 4)}


def model(text, edges):
    base = KnowledgeBase.from_text(":- dynamic(edge/3).")
    base.facts("edge", edges)
    base.rule(text)
    return base._model


def on_columns(text, edges, most=10**6):
    """The rows by the function that works on columns only."""
    found = model(text, edges)
    relations = {i: relation for i, relation in found.relations.items() if i not in found.program.least}
    room = least_columns.Room(most, relations)
    least_columns.least_on_columns(found.program, frozenset(found.program.least), relations, room, 0)
    return {i: relations[i] for i in found.program.least}


def refused(text, edges, sentence):
    with pytest.raises(NotOnColumns, match=sentence):
        on_columns(text, edges)
    return True


def test_the_shortest_ways_have_rounds_in_the_order_of_their_lengths():
    found = on_columns(FROM_A, LINE)["far", 2]
    assert set(found) == SHORTEST
    assert [found.round_of(row) for row in sorted(found)] == [0, 2, 3, 4]  # after what is shorter


def test_what_is_made_of_terms_is_left_to_rows():
    assert refused(FROM_A.replace("far(Y, D) :-", "far(f(Y), D) :-"), LINE, r"the head of .* is made of terms")


def test_too_many_keys_for_an_array_are_left_to_rows(monkeypatch):
    constants = 8  # a to d, and 0, 1, 2, 7
    monkeypatch.setattr(least_columns, "MOST_KEYS", constants - 1)
    assert refused(FROM_A, LINE, "there are too many keys")
    monkeypatch.setattr(least_columns, "MOST_KEYS", constants)
    assert set(on_columns(FROM_A, LINE)["far", 2]) == SHORTEST


def test_a_key_that_is_computed_is_left_to_rows():
    text = ":- table(far(_, min)). far(0, 0). far(Y, D) :- far(X, C), edge(X, K, W), Y is K + 100, D is C + W."
    assert refused(text, [(0, 1, 1)], "a key is a computed number")


def test_rows_that_rest_on_one_another_alone_are_left_to_rows():
    text = ":- table(far(_, min)). far(a, 5). far(Y, D) :- far(X, C), edge(X, Y, W), D is min(C, W)."
    assert refused(text, [("a", "b", 3), ("b", "a", 9)], "some rows rest on one another alone")
    assert set(on_columns(text, [("a", "b", 6), ("b", "a", 9)])["far", 2]) == {("a", 5), ("b", 5)}


def test_values_of_two_kinds_are_left_to_rows():
    assert refused(FROM_A, [("a", "b", 0.5)], "some values are whole numbers and some are not")


def test_what_improves_without_end_is_told():
    with pytest.raises(BudgetExceeded, match=r"the rows of far/2 improve without end: the answer is unknown"):
        on_columns(FROM_A, [("a", "b", -1), ("b", "a", 0)])


def test_rows_are_bounded_by_the_room_beside_what_is_there():
    with pytest.raises(BudgetExceeded):
        on_columns(FROM_A, LINE, most=7)  # four edges and four rows
    assert set(on_columns(FROM_A, LINE, most=8)["far", 2]) == SHORTEST


@pytest.mark.parametrize(
    ("condition", "rows"),
    [
        ("far(X, X, C), edge(X, Y, W)", {("b", "b", 4), ("b", "c", 5)}),  # the same twice
        ("far(a, X, C), edge(X, Y, W)", {("a", "c", 3), ("b", "c", 3)}),  # of one
    ],
)
def test_a_premise_may_be_asked_for_one_key_or_equal_ones(condition, rows):
    text = f":- table(far(_, _, min)). far(X, Y, D) :- edge(X, Y, D). far(X, Y, D) :- {condition}, D is C + W."
    edges = [("a", "b", 2), ("b", "b", 4), ("b", "c", 1)]
    given = {("a", "b", 2), ("b", "b", 4), ("b", "c", 1)}
    expected = model(text, edges).relations["far", 3]
    assert set(on_columns(text, edges)["far", 3]) == set(expected) >= given


def test_of_many_keys_the_best_are_followed_first(monkeypatch):
    monkeypatch.setattr(least_columns, "AT_ONCE", 2)
    edges = [(at, (at * 7 + step) % 60, 1 + step * 5) for at in range(60) for step in (0, 1, 2)]
    text = FROM_A.replace("far(a, 0)", "far(0, 0)")
    assert set(on_columns(text, edges)["far", 2]) == set(model(text, edges).relations["far", 2])


def test_rows_that_have_no_common_code_are_kept_as_rows(monkeypatch):
    monkeypatch.setattr(least_columns, "MOST_CODES", 50)
    found = on_columns(FROM_A, LINE)["far", 2]
    assert set(found) == SHORTEST and found.round_of(("a", 0)) == 0 < found.round_of(("d", 4))
    assert not hasattr(found, "table")


def test_the_greatest_is_kept_on_columns_too():
    text = ":- table(wide(_, max)). wide(a, 9). wide(Y, D) :- wide(X, C), edge(X, Y, W), D is min(C, W)."
    assert set(on_columns(text, LINE)["wide", 2]) == {("a", 9), ("b", 1), ("c", 7), ("d", 1)}


def test_best_rows_that_have_lost_what_they_rest_on_are_undefined():
    text = ":- table(p(_, min)). p(a, 5). p(b, D) :- p(a, D). p(a, D) :- p(b, C), C > 4, D is C - 1."
    base = KnowledgeBase.from_text(text)
    for statement in ("p(a, 4)", "p(b, 4)", "p(a, 5)"):
        with pytest.raises(Undefined):
            base.ask(statement)


def test_a_minimum_goes_to_columns_from_so_many_rows_on(monkeypatch):
    tried = []
    monkeypatch.setattr(least_columns, "least_on_columns", lambda *_: tried.append(1) or (_ for _ in ()).throw(NotOnColumns("no")))
    for least, count in [(4, 1), (5, 0)]:
        monkeypatch.setattr(minimum, "COLUMNS_FROM", least)
        tried.clear()
        assert set(model(FROM_A, LINE).relations["far", 2]) == SHORTEST
        assert len(tried) == count
