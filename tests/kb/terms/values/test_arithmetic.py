"""Arithmetic: exact where integers are, SWI-Prolog's values where it has them, and a sentence where there is none."""

from __future__ import annotations

import math
import subprocess

import pytest
from hypothesis import given
from hypothesis import strategies as st
from swi import needs_swi

from casper.kb.terms.comparison import compare
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound
from casper.kb.terms.values.arithmetic import FUNCTIONS, MOST_BITS, EvaluationFailed, evaluate
from casper.kb.text.reader import read_query

OPERANDS = [-7, -2, -1, 0, 1, 2, 3, 10, 2**70, -(2**70), -2.5, -0.5, 0.0, 0.25, 1.0, 2.5, 1e300]


def value(text: str):
    ((literal,),) = read_query(f"X is {text}")
    return evaluate(literal.atom[2])


def written(term) -> str:
    """The term in a spelling without operators, for both readers."""
    return f"'{term[0]}'({', '.join(map(written, term[1:]))})" if isinstance(term, tuple) else repr(term)


@needs_swi
def test_every_function_has_swi_prologs_value_or_none_as_there(tmp_path):
    cases = [Compound((name, x)) for name, arity in FUNCTIONS if arity == 1 for x in OPERANDS]
    cases += [Compound((name, x, y)) for name, arity in FUNCTIONS if arity == 2 for x in OPERANDS for y in OPERANDS]
    huge = {"<<", ">>", "**", "^"}  # of these SWI-Prolog may try to hold the result
    cases = [case for case in cases if not (case[0] in huge and isinstance(case[2], int) and abs(case[2]) > 10**6)]
    file = tmp_path / "cases.pl"
    goal = "forall(case(E), (catch((X is E, format('~q~n', [X])), _, writeln(none))))"
    escaped = [written(case).replace("\\", "\\\\") for case in cases]
    file.write_text("".join(f"case({case}).\n" for case in escaped), encoding="utf-8")
    done = subprocess.run(["swipl", "-q", "-g", goal, "-t", "halt", str(file)], capture_output=True, text=True, check=True)
    lines = done.stdout.splitlines()
    assert len(lines) == len(cases)
    for case, line in zip(cases, lines):
        try:
            mine = evaluate(case)
        except EvaluationFailed:
            assert line == "none", (case, line)
            continue
        assert line != "none", (case, mine)
        theirs = int(line) if line.lstrip("-").isdigit() else float(line.replace("1.0Inf", "inf"))
        assert isinstance(mine, float) == isinstance(theirs, float), (case, mine, line)
        assert mine == theirs or math.isclose(mine, theirs, rel_tol=1e-14), (case, mine, line)


@given(st.integers(), st.integers().filter(bool))
def test_division_and_remainder_fit_together_both_ways(x, y):
    cut, rest, down, modulo = (evaluate(Compound((name, x, y))) for name in ("//", "rem", "div", "mod"))
    assert cut * y + rest == x == down * y + modulo
    assert abs(rest) < abs(y) and abs(modulo) < abs(y)
    assert rest * x >= 0 and modulo * y >= 0


@given(st.integers(), st.integers())
def test_integers_are_exact_whatever_their_size(x, y):
    for name, expected in {"+": x + y, "-": x - y, "*": x * y, "max": max(x, y), "xor": x ^ y}.items():
        assert evaluate(Compound((name, x, y))) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("4 / 2", 2), ("1 / 2", 0.5), ("-7 // 2", -3), ("-7 mod 2", 1), ("-7 rem 2", -1), ("2 ** 100", 2**100), ("2 ** -1", 0.5),
        ("2 ^ 3 ^ 2", 512), ("2 + 3 * 4", 14), ("1 << 3 + 1", 9), ("round(2.5)", 3), ("round(-2.5)", -3), ("truncate(-2.5)", -2),
        ("7 xor 2 \\/ 8", 13), ("pi", math.pi), ("max(2, inf)", math.inf), ("1 ** (10 ** 12)", 1), ("(-1) ** (10 ** 12 + 1)", -1), ("0 ** (10 ** 12)", 0), ("(-1) ** (-3)", -1),
        ("2 ** (-1)", 0.5), ("inf + 1", math.inf), ("2 * -inf", -math.inf), ("[5] + 1", 6), ("abs(-3)", 3), ("sign(-2.5)", -1.0),
    ],
)  # fmt: skip
def test_an_expression_has_its_value(text, expected):
    assert value(text) == expected
    assert type(value(text)) is type(expected)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("1 / 0", "1 / 0 has no value: division by zero"),
        ("1.0 / 0", "division by zero"),
        ("5 mod 0", "division by zero"),
        ("7.5 mod 2", "7.5 is not an integer"),
        ("sqrt(-1)", "sqrt(-1) has no value: it is undefined there"),
        ("exp(1000)", "too large for a float"),
        ("1.0e308 * 10", "too large for a float"),
        ("inf - inf", "undefined there"),
        ("2 ** (10 ** 12)", f"more than {MOST_BITS} bits"),
        ("(-2) ** (10 ** 12)", f"more than {MOST_BITS} bits"),
        ("3 ^ (10 ** 12)", f"more than {MOST_BITS} bits"),
        ("2 ** 10000000", f"more than {MOST_BITS} bits"),
        ("1 << 10000000", f"more than {MOST_BITS} bits"),
        ("msb(0)", "0 is not positive"),
        ("1 + ann", "ann is not a number"),
        ("1 + f(2)", "f(2) is not a number"),
    ],
)
def test_what_has_no_value_says_why(text, reason):
    with pytest.raises(EvaluationFailed) as caught:
        value(text)
    assert reason in caught.value.sentence


@pytest.mark.parametrize(("condition", "holds"), [("1 =:= 1.0", True), ("2 =\\= 1 + 1", False), ("2 ** 0.5 > 1", True), ("3 =:= abs(-3)", True)])
def test_numbers_compare_by_value(condition, holds):
    ((literal,),) = read_query(condition)
    assert (compare(literal, {}) is not None) is holds


@pytest.mark.parametrize("condition", ["1 / 0 > 1", "\\+ 1 / 0 > 1", "ann < 3", "\\+ X is foo(1)"])
def test_a_comparison_without_value_neither_holds_nor_fails(condition):
    ((literal,),) = read_query(condition)
    with pytest.raises(EvaluationFailed):
        compare(literal, {})


@given(st.integers(1, 4000), st.integers(-9, 9))
def test_integers_of_any_size_are_written_in_all_their_digits(exponent, last):
    number = 7 * 10 ** (exponent * 3) + last
    assert term_text(number) == f"{7 if last >= 0 else 6}{('0' if last >= 0 else '9') * (exponent * 3 - 1)}{number % 10}"
    assert term_text(-number) == f"-{term_text(number)}"
