"""Relations as kanren goals, among kanren's own."""

from itertools import chain, combinations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from kanren import conde, eq, lall, run, var
from kanren.constraints import neq

from casper.kb.base import KnowledgeBase
from casper.kb.errors import ProgramError
from casper.kb.terms.terms import Compound

pairs = st.lists(st.tuples(st.sampled_from("abc"), st.sampled_from("abc")), max_size=6, unique=True)
MODES = list(chain.from_iterable(combinations((0, 1), n) for n in range(3)))


def base_of(rows, rules=""):
    facts = "".join(f"r({x},{y}). " for x, y in rows)
    return KnowledgeBase.from_text(f":- dynamic(r/2). {facts} {rules}")


@pytest.mark.parametrize("rule", ["s(X,Y) :- r(X,Y).", "s(X,Y) :- r(X,Y), Z = Z."], ids=["stored", "top-down"])
@pytest.mark.parametrize("bound", MODES)
@given(rows=pairs, values=st.tuples(st.sampled_from("abc"), st.sampled_from("abc")))
def test_a_goal_gives_the_matching_rows_in_every_mode(rule, bound, rows, values):
    base = base_of(rows, rule)
    args = [values[at] if at in bound else var() for at in range(2)]
    expected = {row for row in rows if all(row[at] == values[at] for at in bound)}
    assert set(run(0, tuple(args), base.predicate("s")(*args))) == expected


@given(pairs)
def test_a_disequality_before_the_goal_is_respected(rows):
    x, y = var(), var()
    assert set(run(0, (x, y), neq(x, "a"), base_of(rows).r(x, y))) == {row for row in rows if row[0] != "a"}


@given(pairs)
def test_a_disequality_after_the_goal_is_respected(rows):
    x, y = var(), var()
    assert set(run(0, (x, y), base_of(rows).r(x, y), neq(x, y))) == {row for row in rows if row[0] != row[1]}


@given(pairs)
def test_a_disequality_survives_the_goal_and_still_bars_what_comes_later(rows):
    x, y, w = var(), var(), var()
    assert run(0, w, neq(w, "a"), base_of([*rows, ("c", "c")]).r(x, y), eq(w, "a")) == ()


@given(pairs)
def test_a_repeated_variable_asks_for_equal_columns(rows):
    x = var()
    assert set(run(0, x, base_of(rows).r(x, x))) == {a for a, b in rows if a == b}


@given(pairs)
def test_goals_join_within_lall_and_part_within_conde(rows):
    base, (x, y, z) = base_of(rows), (var(), var(), var())
    joined = {(a, d) for a, b in rows for c, d in rows if b == c}
    assert set(run(0, (x, z), lall(base.r(x, y), base.r(y, z)))) == joined
    either = {a for a, b in rows if b == "a"} | {b for a, b in rows if a == "a"}
    assert set(run(0, x, conde([base.r(x, "a")], [base.r("a", x)]))) == either


def test_a_variable_bound_by_an_earlier_goal_uses_the_index():
    base, (x, y) = base_of([(f"k{n}", f"v{n}") for n in range(500)]), (var(), var())
    relation = base.stored(("r", 2))
    before = relation.touched
    assert run(0, y, eq(x, "k7"), base.r(x, y)) == ("v7",)
    assert relation.touched - before == 1


def test_a_variable_bound_under_a_constraint_uses_the_index_too():
    base, (x, y) = base_of([(f"k{n}", f"v{n}") for n in range(500)]), (var(), var())
    relation = base.stored(("r", 2))
    before = relation.touched
    assert run(0, y, neq(y, "v8"), eq(x, "k7"), base.r(x, y)) == ("v7",)
    assert relation.touched - before == 1


def shapes():
    return KnowledgeBase.from_text("p(f(a,b)). p(f(c,c)). p(g(a)).")


def test_a_compound_pattern_takes_a_row_apart():
    x, y = var(), var()
    assert set(run(0, (x, y), shapes().p(("f", x, y)))) == {("a", "b"), ("c", "c")}


def test_a_variable_repeated_inside_a_compound_asks_for_equal_parts():
    x = var()
    assert run(0, x, shapes().p(Compound(("f", x, x)))) == ("c",)


def test_a_reified_compound_is_one_and_prints_in_the_language():
    x = var()
    answers = run(0, x, shapes().p(x))
    assert all(isinstance(answer, Compound) for answer in answers)
    assert {str(answer) for answer in answers} == {"f(a, b)", "f(c, c)", "g(a)"}


def test_a_compound_built_around_an_answer_reifies_as_one():
    x, y = var(), var()
    (answer,) = run(0, y, shapes().p(Compound(("g", x))), eq(y, Compound(("h", x))))
    assert str(answer) == "h(a)"


@pytest.mark.parametrize("odd", [["a"], {"a"}, [var()]])
def test_a_python_value_that_cannot_be_a_term_is_in_no_row(odd):
    assert run(0, var(), shapes().p(odd)) == ()


def test_a_recursive_functor_answers_inside_run():
    base, x = KnowledgeBase.from_text("nat(z). nat(s(X)) :- nat(X)."), var()
    assert [str(answer) for answer in run(3, x, base.nat(x))] == ["z", "s(z)", "s(s(z))"]


def test_a_part_that_may_be_anything_stays_open():
    base, (x, y) = KnowledgeBase.from_text("same(X, X)."), (var(), var())
    assert run(0, y, base.same(x, y), eq(x, "a")) == ("a",)


def test_valid_is_a_goal_too():
    base, x = KnowledgeBase.from_text('can(ann). can(bob). never("no bob") :- claim(can(bob)). go(X) :- can(X).'), var()
    assert run(0, x, base.valid(("can", x))) == ("ann",)


def test_a_predicate_named_like_a_method_is_reached_by_name():
    base, x = KnowledgeBase.from_text("ask(ann)."), var()
    assert run(0, x, base.predicate("ask")(x)) == ("ann",)


def test_a_goal_with_the_wrong_number_of_arguments_is_refused_at_once():
    with pytest.raises(ProgramError, match="p takes 1 argument, not 2"):
        shapes().p("a", "b")


def test_an_unknown_predicate_is_an_attribute_error_with_a_suggestion():
    with pytest.raises(AttributeError, match="did you mean human"):
        _ = KnowledgeBase.from_text("human(ann).").humen
