"""The premises of a row are found however their conditions stand, and never among later rows."""

import pytest
from hypothesis import given
from programs import programs

from casper.kb.base import KnowledgeBase
from casper.kb.errors import BudgetExceeded
from casper.kb.reasons.premises import NotLookedUp, Premises
from casper.kb.reasons.why import prove
from casper.kb.terms.terms import Compound
from casper.kb.terms.unification import unify
from casper.kb.top_down.solve import Solver

ORDERS = (
    "path(X, Y) :- edge(X, Z), path(Z, Y).",
    "path(X, Y) :- path(Z, Y), edge(X, Z).",
    "path(X, Y) :- path(X, Z), edge(Z, Y).",
    "path(X, Y) :- edge(Z, Y), path(X, Z).",
)


def chain(rule, length):
    base = KnowledgeBase.from_text(f":- dynamic(edge/2). path(X, Y) :- edge(X, Y). {rule}")
    base.facts("edge", [(at, at + 1) for at in range(length)])
    return base


@pytest.mark.parametrize("rule", ORDERS)
def test_a_step_of_a_chain_looks_at_two_rows_in_every_order(rule):
    model, atom = chain(rule, 60)._model, Compound(("path", 0, 60))
    proof = prove(atom, model.proofs, model.search(budget=2), model.given, model.program.strata)
    assert proof is not None and proof.fact == atom
    with pytest.raises(BudgetExceeded, match="unknown"):
        prove(atom, model.proofs, model.search(budget=0), model.given, model.program.strata)


@given(programs())
def test_they_are_an_instance_of_the_rule_that_holds_among_earlier_rows(text):
    model = KnowledgeBase.from_text(text)._model
    for indicator, relation in model.relations.items():
        for rule in model.program.rules[indicator]:
            for row in relation:
                atom, round_ = Compound((indicator[0], *row)), relation.round_of(row)
                earlier = {x.needed for x in rule.body if x.needed is not None and not x.is_strict}
                try:
                    found = Premises(model.relations, model.relations, earlier, round_, 10_000).of(atom, rule)
                except NotLookedUp:
                    continue
                bindings = unify(rule.head, atom, {})
                solver = Solver(model.relations, {})
                if found is None:
                    solutions = [] if bindings is None else list(solver.solve(rule.body, bindings))
                    for solution in solutions:
                        premises = [x.instance(solution).atom for x in rule.body if x.needed in earlier and not x.is_strict]
                        assert any(model.relations[p.indicator].round_of(p.args) >= round_ for p in premises)
                    continue
                assert next(solver.solve(found), None) is not None
                for literal in found:
                    if literal.needed in earlier and not literal.is_strict:
                        assert model.relations[literal.needed].round_of(literal.atom.args) < round_


def test_a_proof_rests_on_no_absence_of_what_is_undefined():
    text = "b(0). b(1). g(0, []). g(1, 2). h(X) :- b(X), \\+ (g(X, Y), Y =\\= X). h(X) :- b(X), X < 1."
    proof = KnowledgeBase.from_text(text).why("h(0)")
    assert [str(premise.literal) for premise in proof.premises] == ["b(0)", "0 < 1"]


def test_what_is_counted_is_left_to_a_search():
    model = KnowledgeBase.from_text("many(N) :- aggregate_all(count, human(_), N). human(ann).")._model
    (rule,) = model.program.rules["many", 1]
    with pytest.raises(NotLookedUp):
        Premises(model.relations, model.relations, set(), 9, 100).of(Compound(("many", 1)), rule)


def test_an_expression_without_a_value_gives_no_premises():
    model = KnowledgeBase.from_text("half(X, Y) :- n(X), Y is 1 // X. n(0). n(1).")._model
    (rule,) = model.program.rules["half", 2]
    assert Premises(model.relations, model.relations, set(), 9, 100).of(Compound(("half", 0, 0)), rule) is None
    assert Premises(model.relations, model.relations, set(), 9, 100).of(Compound(("half", 1, 1)), rule) is not None


def test_an_absence_that_is_undefined_is_no_premise():
    text = "n(0). half(X, Y) :- n(X), Y is 4 / X. ok(X) :- n(X), \\+ (half(X, _), n(X)). ok(X) :- n(X), X < 1."
    proof = KnowledgeBase.from_text(text).why("ok(0)")
    assert [str(premise.literal.atom) for premise in proof.premises] == ["n(0)", "0 < 1"]
