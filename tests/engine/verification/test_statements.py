"""Statements of the low level, judged one after the other, and plans' leaves judged with the knowledge base."""

import pytest
from readings import KITCHEN

from casper.engine.verification.binding import binding_of, bindings_of
from casper.engine.verification.matching import NameMatcher, ParameterMatcher
from casper.engine.verification.mismatch import Mismatch, Refused
from casper.engine.verification.observation import Observation
from casper.engine.verification.verification import Statement, Verifier
from casper.engine.verification.verified_matching import VerifyingMatcher, settle
from casper.kb.base import KnowledgeBase
from casper.kb.terms.terms import Compound, Variable
from casper.plans.library import PlanLibrary

HOME = """human(ann). food(egg). food(pie). bowl(bowl).
warm(A, F, D) :- human(A), food(F), bowl(D).
eat(A, F, D) :- human(A), food(F), bowl(D).
never("first warm it") :- claim(eat(_, F, _)), \\+ did(warm(_, F, _), _).
"""


def test_what_is_unknown_of_a_statement_is_a_variable():
    assert str(Statement(0.0, "ann", "eat", "egg", None)) == "eat(ann, egg, Destination)"
    assert str(Statement(0.0, "ann", "eat", None, "bowl")) == "eat(ann, Target, bowl)"


def test_what_was_accepted_is_what_happened_and_its_agent_is_left_out():
    verifier = Verifier(KnowledgeBase.from_text(HOME))
    eat = Statement(2.0, "ann", "eat", "egg", None)
    assert verifier.judge(eat).reasons == ("first warm it",)
    warmed = verifier.judge(Statement(1.0, "ann", "warm", "egg", None))
    assert verifier.accept(warmed, 1.0) == Observation("warm", ("egg", "bowl"))
    assert verifier.history == [(Compound(("warm", "ann", "egg", "bowl")), 1.0)]
    assert verifier.judge(eat).valid


def test_what_is_not_known_in_full_did_not_happen_for_sure():
    verifier = Verifier(KnowledgeBase.from_text(HOME))
    observation = verifier.accept(verifier.judge(Statement(1.0, "ann", "warm", None, "bowl")), 1.0)
    assert (observation.action, observation.known_args) == ("warm", 1)
    assert verifier.history == []


def plans(text):
    return PlanLibrary.from_text(text).ways


def matcher(text="goal(g(F)) :- food(F). g(F) --> warm(F, bowl), eat(F, bowl)."):
    return VerifyingMatcher(plans(text), KnowledgeBase.from_text(HOME + "goal(g(F)) :- food(F)."), "ann")


def test_a_goal_with_one_value_settles_it_and_one_with_two_does_not():
    (plan,) = plans("g(F) --> eat(F, bowl).")
    one = KnowledgeBase.from_text("food(egg). goal(g(F)) :- food(F).")
    two = KnowledgeBase.from_text("food(egg). food(pie). goal(g(F)) :- food(F).")
    assert settle(one, plan, (None,)) == ("egg",)
    assert settle(two, plan, (None,)) == (None,)
    assert settle(two, plan, ("pie",)) == ("pie",)
    assert isinstance(settle(two, plan, ("mug",)), Refused)
    assert settle(two, plan, ("mug",)).reasons == ("mug is not food",)


def test_a_goal_whose_condition_takes_too_long_is_not_refused():
    (plan,) = plans("g(F) --> eat(F, bowl).")
    endless = KnowledgeBase.from_text("goal(g(X)) :- goal(g(X)), X = X. goal(g(f(X))) :- goal(g(X)).")
    assert settle(endless, plan, (None,)) == (None,)


def test_an_action_is_judged_by_what_happened_before_and_undone_with_it():
    asked = matcher()
    eat, warm = Observation("eat", ("egg", "bowl")), Observation("warm", ("egg", "bowl"))
    assert asked.match(0, 1, eat, (None,)).reasons == ("first warm it",)
    asked.observed(warm)
    assert asked.match(0, 1, eat, (None,)) == ("egg",)
    asked.forget()
    assert isinstance(asked.match(0, 1, eat, (None,)), Mismatch)


def test_a_fork_has_the_same_past_and_a_future_of_its_own():
    first = matcher()
    eat, warm = Observation("eat", ("egg", "bowl")), Observation("warm", ("egg", "bowl"))
    second = first.fork()
    first.observed(warm)
    assert first.match(0, 1, eat, (None,)) == ("egg",)
    assert isinstance(second.match(0, 1, eat, (None,)), Mismatch)


def test_only_what_was_seen_in_full_counts_as_done():
    asked = matcher()
    asked.observed(Observation("warm"))
    asked.observed(Observation("warm", ("egg", Variable("D"))))
    assert isinstance(asked.match(0, 1, Observation("eat", ("egg", "bowl")), (None,)), Mismatch)


def test_a_changed_knowledge_base_is_asked_anew():
    asked = matcher()
    wanted = Observation("warm", ("jam", "bowl"))
    assert asked.match(0, 0, wanted, (None,)).reasons == ("jam is not food",)
    asked.kb.assert_("food(jam)")
    assert asked.match(0, 0, wanted, (None,)) == ("jam",)


@pytest.mark.parametrize(
    ("seen", "binding", "reason"),
    [
        (("pie", "sink"), (None,), "g has eat(F, bowl), not eat(pie, sink)"),
        (("pie", "bowl"), ("egg",), "F of g is egg, not pie"),
        (("pie",), (None,), "eat takes 2 arguments in g"),
        ((Variable("X"), "sink"), ("egg",), "g has eat(egg, bowl), not eat(X, sink)"),
    ],
)
def test_a_clash_names_the_first_argument_that_disagrees(seen, binding, reason):
    found = ParameterMatcher(plans("g(F) --> eat(F, bowl).")).match(0, 0, Observation("eat", seen), binding)
    assert found.reasons == (reason,)


def test_a_name_alone_fits_whatever_is_known():
    both = plans("g(F) --> eat(F, bowl).")
    assert ParameterMatcher(both).initial(0) == (None,)
    assert ParameterMatcher(both).match(0, 0, Observation("eat"), ("egg",)) == ("egg",)
    assert NameMatcher(both).initial(0) == NameMatcher(both).match(0, 0, Observation("eat", ("x", "y")), ()) == ()


def test_a_binding_and_its_substitution_say_the_same():
    (plan,) = plans("g(F, D) --> eat(F, D).")
    food, dish = plan.variables
    assert bindings_of(plan, ("egg", None)) == {food: "egg"}
    assert binding_of(plan, {food: "egg", dish: Variable("Z")}) == ("egg", None)
    assert Mismatch().reasons == ()


def test_the_kitchen_settles_the_food_of_each_goal():
    asked = VerifyingMatcher(KITCHEN.library.ways, KITCHEN.kb, KITCHEN.partner)
    assert [asked.initial(n)[0] for n in range(len(KITCHEN.library.ways))] == ["biscuits", "bottle", "meal"]
