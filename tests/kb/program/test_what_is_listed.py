"""What a program amounts to: which predicates are listed, which are searched, and in which strata."""

import pytest

from casper.kb.errors import ProgramError
from casper.kb.program.listing import is_range_restricted
from casper.kb.program.program import analyse, is_given
from casper.kb.program.strata import components_of, dependents, levels_of
from casper.kb.terms.clauses import Clause
from casper.kb.terms.terms import Compound
from casper.kb.text.reader import read_text


def clauses(text):
    return [sentence for sentence in read_text(text) if isinstance(sentence, Clause)]


def names(indicators):
    return {name for name, _ in indicators}


@pytest.mark.parametrize(
    ("text", "searched"),
    [
        ("q(a). p(X) :- q(X).", set()),
        ("q(a). p(X, Y) :- q(X).", {"p"}),
        ("q(a). p(X) :- q(X), Y > X.", {"p"}),
        ("q(a). p(X) :- q(X), Y = X.", set()),
        ("q(a). p(Y) :- q(X), Y = f(X).", set()),
        ("q(a). p(X) :- q(f(X)), f(Y) = Z, Z = f(X).", set()),
        ("q(1). p(Y) :- q(X), Y is X + 1.", set()),
        ("q(1). p(X) :- q(Y), Y is X + 1.", {"p"}),
        ("q(a). p(X) :- \\+ q(X).", {"p"}),
        ("q(a, b). p(X) :- q(X, _), \\+ q(_, X).", set()),
        ("p(f(X)) :- p(X). p(a).", {"p"}),
        ("q(a). p(f(X)) :- q(X).", set()),
        ("q(1). p(X) :- q(X). p(Y) :- p(X), Y is X + 1.", {"p"}),
        ("q(a). p(X) :- q(X). p(Y) :- p(X), Y = s(X).", {"p"}),
        ("q(a). p(X) :- q(X). p(Y) :- p(X), Y = X.", set()),
        ("q(a). p(X) :- claim(X). r(X) :- p(X). s(X) :- q(X).", {"p", "r"}),
        ("q(a, b). p(X, Y) :- q(X, Y). p(X, Z) :- p(X, Y), q(Y, Z).", set()),
        ("p(X). r(X) :- p(X), q(X). q(a).", {"p", "r"}),
    ],
)
def test_a_predicate_is_searched_when_its_rows_cannot_all_be_listed(text, searched):
    program = analyse(clauses(text))
    assert names(program.top_down) == searched
    listed = {i for stratum in program.strata for i in stratum}
    assert listed == set(program.rules) - program.top_down


@pytest.mark.parametrize(
    ("clause", "bound"),
    [
        ("p(X) :- X = Y, q(Y).", True),
        ("p(X) :- Y = X, q(Y).", True),
        ("p(X) :- X = Y, Y = Z, q(Z).", True),
        ("p(X) :- X = Y.", False),
        ("p(X) :- X is Y + 1, q(Y).", True),
        ("p(X) :- Y is X + 1, q(Y).", False),
        ("p(X) :- q(X), \\+ X = Y.", False),
        ("p(X) :- q(X), \\+ r(X, _).", True),
        ("p(X) :- q(X), \\+ r(X, Y).", False),
        ("p(X) :- q(X), _ < X.", False),
        ("p :- q(_).", True),
    ],
)
def test_a_rule_is_bound_when_positive_conditions_give_every_variable_a_value(clause, bound):
    (found,) = clauses(clause)
    assert is_range_restricted(found) is bound


def test_negation_stands_above_what_it_negates_and_nothing_else_does():
    table = {c.head.indicator: (c,) for c in clauses("a :- b, \\+ c. b :- d. c :- \\+ d. d :- e. e :- d.")}
    assert {name: level for (name, _), level in levels_of(table, components_of(table)).items()} == {"a": 2, "b": 0, "c": 1, "d": 0, "e": 0}


def test_strata_come_lowest_first():
    program = analyse(clauses("e. d :- e. c :- e, \\+ d. b :- c. a :- e, \\+ b."))
    assert [sorted(names(stratum)) for stratum in program.strata] == [["d", "e"], ["b", "c"], ["a"]]


def test_dependents_are_those_that_need_a_root_directly_or_not():
    table = {c.head.indicator: (c,) for c in clauses("a :- b. b :- c. d :- e. c :- x = x. e.")}
    assert names(dependents(table, {("c", 0)})) == {"a", "b"}
    assert names(dependents(table, {("a", 0)})) == set()


def test_facts_are_given_and_open_heads_are_rules():
    program = analyse(clauses("p(a). p(a). p(b) :- q. p(X). q."), [("r", 2)], {("q", 1): [("x",), ("y",)]})
    assert list(program.given["p", 1]) == [("a",)]
    assert program.given["q", 1] == {("x",): None, ("y",): None}
    assert program.given["r", 2] == {} and program.rules["r", 2] == ()
    assert [str(c.head) for c in program.rules["p", 1]] == ["p(b)", "p(X)"]
    assert [is_given(c) for c in clauses("p(a). p(X). p(a) :- q.")] == [True, False, False]


def test_what_is_searched_has_its_facts_among_its_clauses_in_the_authors_order():
    program = analyse(clauses("p(a). p(X). p(b)."), (), {("p", 1): [("c",)]})
    assert [str(c.head) for c in program.clauses["p", 1]] == ["p(a)", "p(X)", "p(b)", "p(c)"]
    assert [c.head for c in analyse(clauses("q(a). q(b).")).clauses["q", 1]] == []


def test_only_did_looks_back():
    assert not analyse(clauses("p :- claim(x).")).looks_back
    assert analyse(clauses("p :- did(x, _).")).looks_back
    assert analyse(clauses('p. never("x") :- p, did(y, _).')).looks_back


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("p :- qq. qqq(a, b). qqq.", "nothing defines qq/0; did you mean qqq?"),
        ("p :- q(a, b). q(a).", "q takes 1 argument, not 2"),
        ("p :- q. q(a). q(a, b).", "q takes 1 or 2 arguments, not 0"),
        ("p :- q(a). q.", "q takes 0 arguments, not 1"),
        ("p :- zebra.", "nothing defines zebra/0; add a fact or a rule for it"),
        ("claim(x).", "claim/1 is defined by the system; choose another name"),
        ("did(x, y) :- p. p.", "did/2 is defined by the system"),
        ('never("x").', "this constraint is always broken; give it a body"),
        ("never(X) :- p. p.", 'a constraint starts with its sentence: never("…") :- …'),
        ("never(a, b) :- p. p.", "a constraint starts with its sentence"),
        ("q(a). p :- \\+ q(X).", "X stands only under a negation; bind it by a condition, or write _"),
    ],
)
def test_what_no_clause_may_say_is_refused_with_its_place(text, sentence):
    with pytest.raises(ProgramError) as told:
        analyse(clauses(text))
    assert told.value.sentence.startswith(sentence)
    assert told.value.place.line == 1


def test_a_name_of_the_systems_cannot_be_loaded_either():
    for given in ({"dynamic": [("valid", 1)]}, {"bulk": {("claim", 1): [("x",)]}}):
        with pytest.raises(ProgramError) as told:
            analyse([], **given)
        assert told.value.place is None


def test_names_of_the_systems_with_other_arities_are_free():
    program = analyse(clauses("claim(a, b). p :- claim(a, b)."))
    assert ("claim", 2) in program.rules and not program.top_down


def test_a_negated_comparison_and_a_head_bind_for_a_negation():
    assert analyse(clauses("q(a). p(X) :- \\+ q(X). r :- X = a, \\+ q(X). s :- \\+ a = b.")).rules


def test_a_program_keeps_constraints_apart():
    program = analyse(clauses('p(a). never("x") :- p(b).'))
    assert [str(c.head[1]) for c in program.constraints] == ["x"]
    assert Compound(("never", "x")).indicator not in program.rules
