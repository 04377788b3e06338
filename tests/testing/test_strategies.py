"""What each strategy makes, and what it shrinks to."""

from itertools import pairwise

import pytest
from hypothesis import HealthCheck, find, given, settings
from hypothesis import strategies as st

from casper.engine.domain.domain import Domain
from casper.engine.perception.world import WorldState
from casper.engine.verification.observation import Observation
from casper.kb.base import KnowledgeBase
from casper.kb.errors import CasperError
from casper.kb.terms.terms import Compound
from casper.kb.text.reader import read_statement
from casper.plans.library import PlanLibrary
from casper.testing.strategies import (
    facts,
    interleavings,
    libraries,
    observations,
    plans,
    programs,
    statements,
    world_traces,
)
from casper.testing.types import register
from casper.testing.values import columns_of

KITCHEN = Domain.load("kitchen")
ACTIONS = {(name, arity + 1) for name, arity in KITCHEN.library.actions}
FAST = settings(suppress_health_check=[HealthCheck.too_slow], deadline=None, database=None)


def least(strategy, condition=lambda value: True):
    """What a strategy shrinks to."""
    return find(strategy, condition, settings=settings(FAST, max_examples=200))


# --- statements and facts -------------------------------------------------------------------------------------------


@given(statements(KITCHEN))
def test_a_statement_is_one_of_the_actions_with_values_that_fit(text: str) -> None:
    statement = read_statement(text)
    assert statement.indicator in ACTIONS
    for value, column in zip(statement.args, columns_of(KITCHEN.kb, statement.indicator)):
        assert value in column


def test_only_agents_eat_and_only_what_is_food() -> None:
    agents, things, vessels = columns_of(KITCHEN.kb, ("eat", 3))
    assert agents == ["human"] and "sink" not in things and "biscuits" in things and "plate" in vessels


@given(statements(KITCHEN, valid=True), statements(KITCHEN, valid=False))
def test_valid_and_invalid_statements_are_what_they_are_called(valid: str, invalid: str) -> None:
    assert KITCHEN.kb.verify(valid).valid is True and KITCHEN.kb.verify(invalid).valid is False


@given(facts(KITCHEN))
def test_a_fact_can_be_stated_and_taken_back(fact: str) -> None:
    kb = KITCHEN.kb.assume()
    stated = kb.assert_(fact)
    assert kb.ask(fact)
    if stated:
        kb.retract(fact)
        assert not kb.ask(fact)


def test_some_facts_are_new() -> None:
    assert least(facts(KITCHEN), lambda fact: not KITCHEN.kb.ask(fact))


@pytest.mark.parametrize("options", [{"actions": [("dance", 1)]}, {"actions": []}])
def test_statements_that_there_are_none_of_are_told(options) -> None:
    with pytest.raises(CasperError, match=r"there are no statements dance/1|nothing to draw from"):
        statements(KITCHEN, **options)


def test_a_base_without_statements_is_told() -> None:
    with pytest.raises(CasperError, match="nothing to draw from"):
        statements(KnowledgeBase.from_text("p(1)."))


# --- pursuits -------------------------------------------------------------------------------------------------------


@given(observations(KITCHEN))
def test_a_whole_pursuit_is_read_as_its_goal(pursuit) -> None:
    reading = KITCHEN.reading()
    for action in pursuit.actions:
        reading.observe(action)
    assert reading.outcome == pursuit.goal and pursuit.actions == pursuit.steps and reading.frontier == ()


@given(observations(KITCHEN, drop=0.5, needless=0.5, misread=0.5))
def test_what_goes_wrong_is_told_of_a_pursuit(pursuit) -> None:
    own = [action for at, action in enumerate(pursuit.actions) if at not in pursuit.needless]
    seen = [at for at in range(len(pursuit.steps)) if at not in pursuit.unseen]
    assert len(own) == len(seen) > 0
    for at, action in zip(seen, own):
        assert (action == pursuit.steps[at]) == (at not in pursuit.misread)


@given(libraries().flatmap(lambda library: st.tuples(st.just(library), observations(library))))
@settings(FAST)
def test_a_pursuit_of_any_library_has_an_explanation_without_a_miss(pair) -> None:
    from casper.engine.reading.reading import Reading
    from casper.engine.verification.matching import ParameterMatcher

    library, pursuit = pair
    reading = Reading(library, ParameterMatcher(library.ways))
    for step in pursuit.steps:
        reading.observe(step)
    assert reading.posterior[pursuit.goal] > 0 and reading.best_of(pursuit.goal).missed == 0


def test_a_pursuit_shrinks_to_the_first_goal_with_nothing_amiss() -> None:
    pursuit = least(observations(KITCHEN, drop=0.5, needless=0.5, misread=0.5))
    assert (pursuit.goal, pursuit.unseen, pursuit.needless, pursuit.misread) == ("breakfast", (), (), ())
    one = least(observations(KITCHEN, drop=0.5), lambda found: found.unseen)
    assert len(one.unseen) == 1


@given(interleavings(observations(KITCHEN, goal="lunch"), observations(KITCHEN, goal="drink")))
def test_interleaved_pursuits_keep_their_own_order(found) -> None:
    for number, pursuit in enumerate(found.pursuits):
        assert tuple(a for a, of in zip(found.actions, found.of) if of == number) == pursuit.actions
    assert found.goals == {"lunch", "drink"}


def test_interleaved_pursuits_shrink_to_one_after_the_other() -> None:
    found = least(interleavings(observations(KITCHEN), observations(KITCHEN)))
    assert list(found.of) == sorted(found.of)


@pytest.mark.parametrize("options, words", [({"goal": "dinner"}, "there are breakfast"), ({"drop": 2}, "from 0 to 1")])
def test_a_pursuit_that_there_is_none_of_is_told(options, words) -> None:
    with pytest.raises(CasperError, match=words):
        least(observations(KITCHEN, **options))


# --- plans, programs, traces ----------------------------------------------------------------------------------------


@given(libraries())
@settings(FAST)
def test_a_library_reads_back_and_can_be_explained_with(library) -> None:
    assert PlanLibrary.from_text(library.to_text()).to_text() == library.to_text()
    assert library.ways and all(plan.leaves for plan in library.ways)


def test_a_plan_shrinks_to_one_step() -> None:
    assert least(plans()) == "goal1(P) --> a(cup)."
    assert len(least(libraries()).ways) == 1


@pytest.mark.parametrize("shape", ["optional(", "unordered(", "steps(", "repeat(", " ; "])
def test_every_shape_is_made(shape: str) -> None:
    assert shape in least(plans(), lambda text: shape in text)


@given(programs(circles=True))
@settings(FAST)
def test_a_program_can_be_loaded(text: str) -> None:
    KnowledgeBase.from_text(text).compile()


@given(world_traces(KITCHEN))
@settings(FAST)
def test_a_trace_advances_and_can_be_watched(trace) -> None:
    from casper.engine.mind import Mind

    mind = Mind(KITCHEN)
    assert all(a.t < b.t for a, b in pairwise(trace))
    for world in trace:
        assert set(world.agents) <= {"human"}
        mind.update(world)


def test_a_trace_shrinks_to_one_state_at_rest() -> None:
    (world,) = least(world_traces(KITCHEN, gaps=False))
    assert world.agents["human"].x == 0.0 and world.agents["human"].holding is None


@pytest.mark.parametrize("kind", [Compound, PlanLibrary, Observation, WorldState])
def test_hypothesis_knows_our_types(kind: type) -> None:
    register()
    assert isinstance(least(st.from_type(kind)), kind)
