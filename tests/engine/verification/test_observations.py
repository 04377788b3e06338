"""Observations: what text, terms and likelihoods become, and what is refused of them."""

import pytest

from casper.engine.verification.observation import Observation, Uncertain, observation_of, options_of, seen_of
from casper.kb.errors import CasperError, PlanError
from casper.kb.terms.terms import Compound, Variable

ACTIONS = [("eat", 2), ("eat", 1), ("rest", 0), ("sip", 1)]


@pytest.mark.parametrize(
    ("observed", "seen"),
    [
        ("eat", Observation("eat")),
        ("eat(meal)", Observation("eat", ("meal",))),
        ("rest", Observation("rest", ())),
        (Compound(("sip", "tea")), Observation("sip", ("tea",))),
        (("sip", "tea"), Observation("sip", ("tea",))),
        (Observation("sip"), Observation("sip")),
    ],
)
def test_an_observation_is_its_name_and_its_arguments_where_they_are_known(observed, seen):
    assert observation_of(observed, ACTIONS) == seen
    assert seen_of(observed, ACTIONS) == seen


@pytest.mark.parametrize(
    ("observed", "sentence"),
    [
        ("sipp", "no plan has the action sipp; did you mean sip?"),
        ("zzz", "no plan has the action zzz; the plans have eat, rest, sip"),
        ("eat(a, b, c)", "eat takes 1 or 2 arguments here (the agent is left out), not 3"),
        ("rest(a)", "rest takes 0 arguments here"),
    ],
)
def test_an_action_that_no_plan_has_is_refused_with_what_may_be_meant(observed, sentence):
    with pytest.raises(PlanError) as told:
        observation_of(observed, ACTIONS)
    assert str(told.value).startswith(sentence)


def test_how_much_of_an_observation_is_known():
    assert Observation("eat").known_args == 0
    assert Observation("eat", ("meal", Variable("D"))).known_args == 1
    assert [Observation("eat", args).is_plain for args in (None, (), ("a",), (Variable("X"),), (Compound(("f", "a")),))] == [
        False, True, True, False, False,
    ]  # fmt: skip


def test_an_observation_is_shown_as_it_is_written():
    assert [str(o) for o in (Observation("eat"), Observation("rest", ()), Observation("eat", ("a b", 1)))] == [
        "eat", "rest", 'eat("a b", 1)',
    ]  # fmt: skip


def test_what_was_not_made_out_keeps_its_likelihoods():
    seen = seen_of({"eat": 0.25, "sip(tea)": 0.5}, ACTIONS)
    assert seen == Uncertain(((Observation("eat"), 0.25), (Observation("sip", ("tea",)), 0.5)))
    assert seen.action == "sip"
    assert str(seen) == "eat: 0.25 | sip(tea): 0.5"
    assert options_of(seen) == seen.options
    assert options_of(Observation("eat")) == ((Observation("eat"), 1.0),)
    assert seen_of(seen, ACTIONS) == seen


def test_the_same_option_twice_adds_up():
    assert seen_of({"eat": 0.25, Observation("eat"): 0.5}, ACTIONS).options == ((Observation("eat"), 0.75),)


@pytest.mark.parametrize("likelihood", [0, -0.1, True, "much", float("inf"), float("nan")])
def test_a_likelihood_is_a_number_above_zero(likelihood):
    with pytest.raises(CasperError, match="it must be a number above 0"):
        seen_of({"eat": likelihood}, ACTIONS)


@pytest.mark.parametrize("options", [{"eat": 0.6, "sip": 0.5}, {"eat": 1.001}, {}])
def test_likelihoods_sum_to_at_most_one(options):
    with pytest.raises(CasperError, match="must sum to at most 1"):
        seen_of(options, ACTIONS)


def test_likelihoods_may_sum_to_one_and_to_what_rounding_makes_of_it():
    assert seen_of({"eat": 1}, ACTIONS).action == "eat"
    assert seen_of({"eat": 0.1, "sip": 0.9 + 1e-12}, ACTIONS).action == "sip"
