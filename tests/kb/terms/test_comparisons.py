"""Comparisons and arithmetic on values that are known."""

import pytest

from casper.kb.terms.comparison import compare, evaluate, is_ready
from casper.kb.terms.terms import Compound, Variable
from casper.kb.terms.values.arithmetic import EvaluationFailed
from casper.kb.text.reader import read_query, read_statement

X, Y = Variable("X"), Variable("Y")


def body(text):
    (found,) = read_query(text)
    return found


@pytest.mark.parametrize(
    ("text", "holds"),
    [
        ("1 < 2", True), ("2 < 2", False), ("2 =< 2", True), ("3 =< 2", False), ("2 > 1", True), ("2 > 2", False),
        ("2 >= 2", True), ("1 >= 2", False), ("a = a", True), ("a = b", False),
        ("a \\= b", True), ("a \\= a", False), ("a == a", True), ("a == b", False), ("a \\== b", True), ("a \\== a", False),
        ("3 is 1 + 2", True), ("4 is 1 + 2", False), ("1 + 2 < 2 * 2", True), ("\\+ 1 < 2", False), ("\\+ 2 < 1", True),
        ("1 + 1 = 2", False), ("f(1) = f(1.0)", True), ("1 + 1 =:= 2.0", True), ("1 =\\= 1", False),
    ],
)  # fmt: skip
def test_a_comparison_of_values_holds_or_does_not(text, holds):
    (literal,) = body(text)
    assert is_ready(literal, {})
    assert (compare(literal, {}) is not None) is holds


@pytest.mark.parametrize("text", ["a < b", "1 < b", "\\+ a < b", "1 is 1 / 0", "\\+ 1 is 1 / 0", "a =:= a"])
def test_a_comparison_of_what_has_no_value_is_undefined(text):
    (literal,) = body(text)
    assert is_ready(literal, {})
    with pytest.raises(EvaluationFailed):
        compare(literal, {})


@pytest.mark.parametrize(
    ("term", "value"),
    [
        ("2 + 3 * 4", 14), ("7 - 2 - 1", 4), ("7 / 2", 3.5), ("1000000000000000000", 10**18), ("999999999999999999 + 1", 10**18),
        ("1000000000000000000 + 1", 10**18 + 1), ("0 - 1000000000000000000 - 1", -(10**18) - 1), ("3", 3),
    ],
)  # fmt: skip
def test_arithmetic_has_a_value(term, value):
    assert evaluate(read_statement(f"p({term})")[1]) == value


@pytest.mark.parametrize("term", ["1 / 0", "1 / 0.0", "a + 1", "1 + a", "f(1, 2)", "a"])
def test_arithmetic_has_no_value(term):
    with pytest.raises(EvaluationFailed):
        evaluate(read_statement(f"p({term})")[1])


def test_numbers_too_large_for_a_fraction_have_no_value():
    with pytest.raises(EvaluationFailed):
        evaluate(Compound(("/", 10**400, 3)))


def test_what_is_bound_by_a_comparison_is_known_afterwards():
    (literal,) = body("X = f(Y)")
    assert compare(literal, {Y: "a"}) == {Y: "a", X: Compound(("f", Y))}
    (value,) = body("X is 1 + Y")
    assert compare(value, {Y: 2}) == {Y: 2, X: 3}


@pytest.mark.parametrize(
    ("text", "bindings", "ready"),
    [
        ("X = Y", {}, True),
        ("\\+ X = Y", {}, False),
        ("\\+ X = Y", {X: 1, Y: 2}, True),
        ("X is Y", {}, False),
        ("X is Y", {Y: 1}, True),
        ("\\+ X is Y", {Y: 1}, False),
        ("X < Y", {X: 1}, False),
        ("X < Y", {Y: 1}, False),
        ("X < Y", {X: 1, Y: 2}, True),
        ("X \\= Y", {X: 1}, False),
        ("X == Y", {X: 1, Y: 1}, True),
    ],
)
def test_a_comparison_waits_until_its_sides_are_known(text, bindings, ready):
    (literal,) = body(text)
    assert is_ready(literal, bindings) is ready


def test_a_negated_comparison_binds_nothing():
    (literal,) = body("\\+ X = b")
    assert compare(literal, {X: "a"}) == {X: "a"}
    assert compare(literal, {X: "b"}) is None
