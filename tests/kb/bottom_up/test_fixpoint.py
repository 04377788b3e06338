"""Materialisation against its specification and against brute force."""

import pytest
from hypothesis import given
from programs import atoms_of, match, model, program_of, programs, put, solutions, undefined_of

from casper.kb.base import KnowledgeBase
from casper.kb.bottom_up import columnar
from casper.kb.bottom_up.circles import alternating
from casper.kb.bottom_up.columnar_fixpoint import columnar_fixpoint
from casper.kb.bottom_up.materialise import materialise
from casper.kb.bottom_up.size import MOST_ROWS
from casper.kb.bottom_up.specification import naive_fixpoint
from casper.kb.errors import BudgetExceeded
from casper.kb.program.program import analyse
from casper.kb.terms.terms import Compound
from casper.kb.text.reader import read_text


def clauses_of(program):
    facts = [clause for found in program.given.values() for clause in found.values()]
    return [*facts, *(rule for found in program.rules.values() for rule in found)]


def meaning(relations):
    return atoms_of(relations), undefined_of(relations)


@given(programs(circles=True))
def test_materialisation_equals_the_naive_fixpoint(text):
    program = program_of(text)
    assert meaning(materialise(program)) == meaning(naive_fixpoint(program))


@given(programs(circles=True))
def test_materialisation_equals_brute_force(text):
    program = program_of(text)
    assert not program.top_down
    certain, possible = model(clauses_of(program))
    assert meaning(materialise(program)) == (certain, possible - certain)


@given(programs(circles=True))
def test_settling_ground_rules_equals_alternation(text):
    program, alternation = program_of(text), alternating.alternate
    before, alternating.settle = alternating.settle, None
    try:
        alternating.are_settled, settled = lambda *_: False, alternating.are_settled
        plain = meaning(materialise(program))
    finally:
        alternating.settle, alternating.are_settled = before, settled
    assert alternation is alternating.alternate
    assert meaning(materialise(program)) == plain


@given(programs())
def test_stratified_programs_without_failures_have_nothing_undefined(text):
    program = program_of(text)
    if not any(x.atom[0] in ("<", ">=", "=:=") for c in clauses_of(program) for x in c.body):
        assert all(relation.undefined is None for relation in materialise(program).values())


@given(programs(circles=True))
def test_every_row_is_a_fact_or_follows_from_rows_of_earlier_rounds(text):
    program = program_of(text)
    relations = materialise(program)
    rounds = {Compound((i[0], *row)): at for i, r in relations.items() for row, at in r.rows.items()}
    possible = {*rounds, *undefined_of(relations)}
    rules = clauses_of(program)
    for atom, at in rounds.items():
        earlier = {other for other, when in rounds.items() if when < at}
        heads = ((c, match(c.head, atom, {})) for c in rules)
        assert any(
            put(c.head, s) == atom
            for c, start in heads
            if start is not None
            for s in solutions(list(c.body), earlier, start, possible)
        )


def rows(text, goal):
    return [tuple(answer.values()) for answer in KnowledgeBase.from_text(text).query(goal)]


def test_left_recursion_ends():
    text = "e(1,2). e(2,3). e(3,1). r(X,Y) :- r(X,Z), e(Z,Y). r(X,Y) :- e(X,Y)."
    assert len(rows(text, "r(X,Y)")) == 9


def test_doubly_recursive_rules_reach_everything():
    text = "e(1,2). e(2,3). e(3,4). e(4,5). r(X,Y) :- e(X,Y). r(X,Y) :- r(X,Z), r(Z,Y)."
    assert len(rows(text, "r(X,Y)")) == 10


def test_mutual_recursion_ends():
    text = "n(0,1). n(1,2). n(2,3). even(0). even(Y) :- odd(X), n(X,Y). odd(Y) :- even(X), n(X,Y)."
    assert rows(text, "even(X)") == [(0,), (2,)]


def test_negation_sees_the_whole_stratum_below():
    text = "e(1,2). e(2,3). n(1). n(2). n(3). r(X,Y) :- e(X,Y). r(X,Y) :- e(X,Z), r(Z,Y). un(X,Y) :- n(X), n(Y), \\+ r(X,Y)."
    assert len(rows(text, "un(X,Y)")) == 6


def test_a_named_variable_with_an_underscore_is_shared_like_any_other():
    assert rows("q(a). q(b). p(b). r(_X) :- \\+ p(_X), q(_X).", "r(X)") == [("a",)]


def test_an_open_part_inside_a_negated_compound_asks_for_no_row_of_that_shape():
    assert rows("q(a). q(b). p(f(b,c)). r(X) :- q(X), \\+ p(f(X,_)).", "r(X)") == [("a",)]


def test_arithmetic_in_a_rule_is_worked_out():
    assert rows("n(1). n(2). double(X, Y) :- n(X), Y is X * 2.", "double(X, Y)") == [(1, 2), (2, 4)]


@pytest.mark.parametrize("sum_", ["1 / 0", f"{'9' * 400} / 3.5", f"{'9' * 400} + 0.5", "2 ** 10000000", "1 << (1 << 40)"])
def test_what_has_no_value_is_undefined_and_so_is_its_negation(sum_):
    base = KnowledgeBase.from_text(f"n(1). p :- n(_), X is {sum_}, n(X). q :- n(_), \\+ p. r :- n(_), \\+ X_is(1). X_is(1) :- n(1)."
        .replace("X_is", "other"))
    assert [base.truth(name) for name in "pqr"] == ["undefined", "undefined", "false"]


def test_numbers_of_any_size_are_exact():
    assert rows("n(1000000000000000000000).", "n(X), Y is X * X + 1") == [(10**21, 10**42 + 1)]


@pytest.mark.parametrize(
    "text",
    [
        "nat(z). nat(s(X)) :- nat(X).",
        "nat(z). nat(Y) :- nat(X), Y = s(X).",
        "nat(0). nat(Y) :- nat(X), Y is X + 1.",
        "nat(z). nat(X) :- up(X). up(s(X)) :- nat(X).",
    ],
)
def test_recursion_that_builds_terms_is_left_to_the_search(text):
    assert ("nat", 1) in program_of(text).top_down


def test_terms_built_without_recursion_are_listed():
    assert rows("p(a). p(b). q(f(X)) :- p(X).", "q(f(X))") == [("a",), ("b",)]


@pytest.mark.parametrize("text", ["p(1). p(2). p(3).", "e(1,2). e(2,1). r(X,Y) :- e(X,Y). r(X,Y) :- e(X,Z), r(Z,Y)."])
def test_too_many_facts_are_refused_with_the_predicate_that_has_most(text):
    with pytest.raises(BudgetExceeded, match=r"more than 2 facts; [per]/\d has most"):
        materialise(program_of(text), most_rows=2)


@given(programs())
def test_columns_in_small_blocks_have_the_same_rows_in_the_same_rounds(text):
    program = program_of(text)
    whole, before = columnar_fixpoint(program, MOST_ROWS), columnar.BLOCK
    columnar.BLOCK = 2
    try:
        blocks = columnar_fixpoint(program, MOST_ROWS)
    finally:
        columnar.BLOCK = before
    assert (whole is None) == (blocks is None)
    for indicator, relation in (whole or {}).items():
        assert relation.rows == blocks[indicator].rows


@pytest.mark.parametrize("rule", ["p(X, Y) :- a(X), a(Y).", "p(X, Y, Z) :- a(X), a(Y), Z is X + Y."], ids=["columns", "rows"])
def test_a_round_that_would_derive_too_much_is_stopped_within_it(rule, monkeypatch):
    monkeypatch.setattr(columnar, "BLOCK", 1_000)
    program = analyse([*read_text(rule), *read_text(" ".join(f"a({at})." for at in range(2_000)))])
    arity = 2 if "Z" not in rule else 3
    with pytest.raises(BudgetExceeded, match=rf"more than 10000 facts; p/{arity} has most of them"):
        materialise(program, 10_000)
