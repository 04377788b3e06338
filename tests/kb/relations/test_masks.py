"""Which comparisons can be worked out on columns, and of which kind the constants are that they compare."""

import math

import pytest

from casper.kb.errors import NotOnColumns
from casper.kb.relations.constants import LONG, OTHER, REAL, STRANGE, WHOLE, kind_of
from casper.kb.relations.tables.masks import check_condition
from casper.kb.terms.terms import Compound, Variable
from casper.kb.text.reader import read_query

X = Variable("X")


def literal(text):
    [[found]] = read_query(text)
    return found


@pytest.mark.parametrize("text", ["X = Z", "Z = X", "X = a", "X == a", "X \\= 1", "\\+ X = a", "X < 1", "W is X + 1", "X = f(a)", "1 is X"])
def test_a_comparison_is_worked_out_on_columns_when_it_needs_only_what_is_known(text):
    check_condition(literal(text), {X})


@pytest.mark.parametrize(
    "text", ["X == Z", "X \\= Z", "X \\== Z", "\\+ X = Z", "\\+ X == Z", "Z = W", "X < Z", "W is Z + 1", "\\+ W is X + 1"]
)
def test_one_with_a_variable_that_nothing_binds_is_not(text):
    with pytest.raises(NotOnColumns, match="has a variable that nothing binds"):
        check_condition(literal(text), {X})


@pytest.mark.parametrize("text", ["X = f(Z)", "f(X) == a", "f(X) is X + 1"])
def test_one_that_looks_into_terms_is_not(text):
    with pytest.raises(NotOnColumns, match="looks into terms"):
        check_condition(literal(text), {X})


@pytest.mark.parametrize("text", ["X < a", "W is X ** 2", f"W is X + {2**53 + 1}", "W is foo(X)"])
def test_one_of_other_expressions_is_not(text):
    with pytest.raises(NotOnColumns, match="is worked out row by row"):
        check_condition(literal(text), {X})


@pytest.mark.parametrize(
    ("value", "kind"),
    [
        ("a", OTHER),
        (Compound(("f", 1)), OTHER),
        (0.5, REAL),
        (math.inf, STRANGE),
        (0, WHOLE),
        (2**53, WHOLE),
        (-(2**53), WHOLE),
        (2**53 + 1, LONG),
        (-(2**53) - 1, LONG),
        (2**63 - 1, LONG),
        (-(2**63), LONG),
        (2**63, STRANGE),
        (-(2**63) - 1, STRANGE),
    ],
)
def test_a_constant_is_of_one_kind(value, kind):
    assert kind_of(value) == kind
