"""Matching observations to leaves: the fast path for constants is unification."""

from hypothesis import given
from hypothesis import strategies as st

from casper.engine.verification.binding import filled, slots_of, unified
from casper.engine.verification.matching import ParameterMatcher
from casper.engine.verification.mismatch import Clash
from casper.engine.verification.observation import Observation
from casper.kb.terms.terms import Compound, Variable
from casper.plans.trees.nodes import Action, Task
from casper.plans.trees.plan import Plan

CONSTANTS = st.sampled_from(["cup", "pot", 1, 1.0, 2, "[]"])
PARAMETERS = st.sampled_from([Variable("X"), Variable("Y"), Variable("Z")])
LEAVES = st.lists(st.one_of(CONSTANTS, PARAMETERS), max_size=4).map(lambda args: Compound(("put", *args)))


@st.composite
def cases(draw):
    leaves = draw(st.lists(LEAVES, min_size=1, max_size=3))
    plan = Plan("g", Task(Compound(("g", Variable("X"))), tuple(map(Action, leaves))))
    binding = tuple(draw(st.one_of(st.none(), CONSTANTS)) for _ in plan.variables)
    leaf = draw(st.integers(0, len(leaves) - 1))
    size = draw(st.sampled_from([len(leaves[leaf]) - 1, len(leaves[leaf])]))
    return plan, leaf, Observation("put", tuple(draw(CONSTANTS) for _ in range(size))), binding


@given(cases())
def test_filling_in_constants_is_unifying(case):
    plan, leaf, observation, binding = case
    assert observation.is_plain
    assert filled(slots_of(plan)[leaf], observation.args, binding) == unified(plan, leaf, observation, binding)


def test_arguments_that_are_terms_or_unknown_are_unified():
    plan = Plan("g", Task(Compound(("g",)), (Action(Compound(("put", Compound(("on", Variable("X")))))),)))
    matcher = ParameterMatcher([plan])
    assert matcher.match(0, 0, Observation("put", (Compound(("on", "cup")),)), (None,)) == ("cup",)
    assert matcher.match(0, 0, Observation("put", (Variable("Unknown"),)), (None,)) == (None,)
    assert isinstance(matcher.match(0, 0, Observation("put", ("cup",)), (None,)), Clash)


def test_a_clash_says_which_argument_disagrees_when_it_is_asked():
    plan = Plan("g", Task(Compound(("g",)), (Action(Compound(("put", Variable("X"), "sink"))),)))
    clash = ParameterMatcher([plan]).match(0, 0, Observation("put", ("cup", "sink")), ("pot",))
    assert clash.reasons == ("X of g is pot, not cup",)
