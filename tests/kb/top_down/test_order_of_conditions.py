"""In which order conditions are taken: what is decided at once first, then what has the fewest rows."""

import pytest

from casper.kb.terms.terms import Variable
from casper.kb.text.reader import read_query
from casper.kb.text.writer import literal_text
from casper.kb.top_down.planning import binds, estimate, is_bound, ordered

SIZES = {("few", 1): 2, ("few", 2): 4, ("many", 1): 1_000, ("many", 2): 10_000, ("none", 1): 0}
X, Y, Z = map(Variable, "XYZ")
INFINITE = float("inf")


def conditions(text):
    [body] = read_query(text)
    return list(body)


@pytest.mark.parametrize(
    ("body", "known", "order"),
    [
        ("many(X), few(X)", set(), "few(X), many(X)"),
        ("many(X, Y), few(X), X < Y", set(), "few(X), many(X, Y), X < Y"),
        ("many(X), X > 1", {X}, "X > 1, many(X)"),
        ("few(Z), many(X), few(Y)", {X}, "many(X), few(Z), few(Y)"),
        ("\\+ few(X), many(X)", set(), "many(X), \\+ few(X)"),
        ("many(X), Y is Z + 1, few(Z), few(X, Y)", set(), "few(Z), Y is Z + 1, few(X, Y), many(X)"),
        ("X < Y, X = 3, few(Y)", set(), "X = 3, few(Y), X < Y"),
        ("many(X, Y), few(X, Y)", {X}, "few(X, Y), many(X, Y)"),
        ("few(X), none(Y)", set(), "none(Y), few(X)"),
    ],
)
def test_what_is_known_is_decided_first_and_of_the_others_what_has_the_fewest_rows(body, known, order):
    found = ordered(conditions(body), known, SIZES.__getitem__)
    assert ", ".join(map(literal_text, found)) == order


@pytest.mark.parametrize(
    ("condition", "known", "cost"),
    [
        ("X = 3", set(), 0),
        ("3 = X", set(), 0),
        ("X = Y", set(), INFINITE),
        ("X is Y + 1", {Y}, 0),
        ("X is Y + 1", {X}, INFINITE),
        ("X < Y", {X}, INFINITE),
        ("X < Y", {X, Y}, 0),
        ("\\+ X = Y", {X}, INFINITE),
        ("\\+ few(X, _)", {X}, 0),
        ("\\+ few(X, Y)", {X}, INFINITE),
        ("X \\= _", {X}, INFINITE),
        ("few(X)", {X}, 0.5),
        ("few(X, Y)", {X}, 2),
        ("few(X, Y)", set(), 4),
        ("many(X, Y)", {Y}, 100),
        ("many(f(X, Z), Y)", {X, Y}, 100),
    ],
)
def test_a_condition_costs_about_as_many_rows_as_it_gives(condition, known, cost):
    assert estimate(conditions(condition)[0], known, SIZES.__getitem__) == cost


@pytest.mark.parametrize(
    ("condition", "known", "bound"),
    [
        ("few(X, Y)", set(), {X, Y}),
        ("\\+ few(X, Y)", set(), set()),
        ("X = f(Y)", {X}, {X, Y}),
        ("X = Y", set(), set()),
        ("X is Y + 1", {Y}, {X, Y}),
        ("X < Y", {X, Y}, set()),
        ("\\+ X = 3", set(), set()),
    ],
)
def test_what_is_known_once_a_condition_holds(condition, known, bound):
    assert binds(conditions(condition)[0], known) == bound


def test_a_term_is_bound_when_all_its_variables_are():
    [[literal]] = [conditions("few(f(X, g(Y)), a)")]
    assert is_bound(literal.atom, {X, Y}) and not is_bound(literal.atom, {X}) and is_bound(literal.atom[2], set())
