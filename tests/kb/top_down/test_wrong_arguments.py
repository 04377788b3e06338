"""A built-in with an argument of the wrong kind is undefined, and its sentence says which built-in needs what."""

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.errors import Undefined
from casper.kb.top_down.builtins import numbers

BASE = KnowledgeBase.from_text("p(a).")
SENTENCES = {
    "atom_length/2 needs a whole number, not ": {"x": "atom_length(abc, x)", "3.0": "atom_length(abc, 3.0)"},
    "atom_length/2 needs an atom, not ": {"f(x)": "atom_length(f(x), N)"},
    "between/3 needs a whole number or inf, not ": {"x": "between(1, x, X)", "3.5": "between(1, 3.5, X)"},
    "between/3 needs a whole number, not ": {"x": "between(1, 3, x)", "1.0": "between(1.0, 3, X)"},
    "numlist/3 needs at most 1,000,000 numbers, not ": {"1000002": "numlist(1, 1000002, L)"},
    "numlist/3 needs whole numbers, not ": {"a": "numlist(a, 3, L)", "b": "numlist(1, b, L)"},
    "atom_number/2 needs a number, not ": {"x": "atom_number(A, x)", "y": "atom_number(a, y)"},
    "atom_number/2 needs an atom, not ": {"3": "atom_number(3, X)", "f(x)": "atom_number(f(x), 3)"},
    "atom_chars/2 needs a list, not ": {"[a | b]": "atom_chars(X, [a|b])"},
    "atom_chars/2 needs characters or codes, not ": {
        **{"ab": "atom_chars(X, [ab])", "1.5": "atom_chars(X, [1.5])", "-1": "atom_chars(X, [-1])"},
        "1114112": "atom_chars(X, [1114112])",
    },
    "number_codes/2 needs a number, not ": {"x": "number_codes(x, L)"},
    "number_codes/2 needs the codes of a number, not ": {"[97]": "number_codes(X, [97])"},
    "char_code/2 needs a character, not ": {"ab": "char_code(ab, X)", "7": "char_code(7, X)"},
    "char_code/2 needs the code of a character, not ": {"-1": "char_code(X, -1)", "a": "char_code(X, a)"},
    "length/2 needs a list, not ": {"[a | b]": "length([a|b], N)", "a": "length(a, N)"},
    "length/2 needs a whole number, not ": {"a": "length(L, a)"},
    "succ/2 needs whole numbers, not ": {"a": "succ(a, X)", "1.0": "succ(X, 1.0)"},
    "succ/2 needs numbers from 0 on, not ": {"-1": "succ(X, -1)", "-2": "succ(-2, X)"},
    "plus/3 needs whole numbers, not ": {"a": "plus(1, a, X)", "b": "plus(X, 1, b)", "0.5": "plus(0.5, X, 3)"},
    "sum_list/2 needs numbers, not ": {"a": "sum_list([a], X)"},
    "sum_list/2 needs a list, not ": {"[1 | b]": "sum_list([1|b], X)"},
    "nth0/3 needs a whole number, not ": {"a": "nth0(a, [b], X)"},
    "msort/2 needs a list, not ": {"a": "msort(a, X)"},
    "sort/2 needs a list, not ": {"[b | c]": "sort([b|c], X)"},
    "sub_atom/5 needs a number of characters, not ": {"-1": "sub_atom(abc, -1, L, A, S)", "x": "sub_atom(abc, B, x, A, S)"},
    "sub_atom/5 needs an atom, not ": {"f(x)": "sub_atom(f(x), B, L, A, S)", "g(x)": "sub_atom(abc, B, L, A, g(x))"},
    "upcase_atom/2 needs an atom, not ": {"f(x)": "upcase_atom(f(x), X)"},
    "atom_concat/3 needs an atom, not ": {"f(x)": "atom_concat(X, Y, f(x))", "g(x)": "atom_concat(g(x), b, X)"},
}
WRONG = [(goal, sentence + what) for sentence, goals in SENTENCES.items() for what, goal in goals.items()]


@pytest.mark.parametrize(("goal", "sentence"), WRONG)
def test_the_sentence_says_what_it_needs(goal, sentence):
    with pytest.raises(Undefined) as doubt:
        list(BASE.query(goal))
    assert doubt.value.sentence.endswith(f"is undefined: {sentence}")


@pytest.mark.parametrize(
    "goal",
    [
        *["length(L, -1)", "length([a, b | _], 1)", "succ(_, 0)", "max_list([], _)", "min_list([], _)", "nth0(-1, [a], _)"],
        *["nth1(0, [a], _)", "reverse([a | b], _)", "last([], _)", "select(a, b, _)", "memberchk(a, b)", "numlist(3, 1, _)"],
        *["between(3, 1, _)", "between(4, inf, 3)", "maplist(integer, a)", "atom_number(abc, _)", "include(integer, a, _)"],
    ],
)
def test_what_has_no_answer_is_false(goal):
    assert list(BASE.query(goal)) == []


def test_as_many_numbers_as_may_be_listed_are_listed(monkeypatch):
    monkeypatch.setattr(numbers, "MOST_LISTED", 5)
    assert list(BASE.query("numlist(1, 6, L), length(L, 6)"))
    with pytest.raises(Undefined, match="at most 5 numbers, not 7"):
        list(BASE.query("numlist(1, 7, L)"))


def test_a_length_that_is_open_counts_up_from_what_is_there():
    assert [a["N"] for a in BASE.query("length([a, b | _], N)", 3)] == [2, 3, 4]


def test_a_part_at_a_known_place_of_a_long_text_is_found_at_once():
    base = KnowledgeBase()
    base.facts("text", [("ab" * 50_000,)])
    assert [a["S"] for a in base.query("text(T), sub_atom(T, 99998, 1, A, S), A = 1")] == ["a"]
    assert [a["S"] for a in base.query("text(T), sub_atom(T, B, 2, 0, S), B > 3")] == ["ab"]
