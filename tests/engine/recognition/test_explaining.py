"""The counting engine against Algorithm 1 word for word, on random libraries and observations."""

from __future__ import annotations

from itertools import islice

from hypothesis import given, settings
from hypothesis import strategies as st
from tellers import Counting

from casper.engine.explanation.explanation import Explanation
from casper.engine.explanation.tree_copying import MarkedTree, explanations
from casper.engine.verification.matching import NameMatcher, ParameterMatcher
from casper.engine.verification.observation import Observation
from casper.kb.terms.terms import Compound, Variable
from casper.plans.trees.nodes import Action, Task
from casper.plans.trees.plan import Plan

ACTIONS = "abc"
THINGS = ("cup", "pot", Variable("P"), Variable("Q"))


@st.composite
def leaves(draw: st.DrawFn) -> Action:
    name = draw(st.sampled_from(ACTIONS))
    return Action(Compound((name, draw(st.sampled_from(THINGS)))))


@st.composite
def plans(draw: st.DrawFn, label: str) -> Plan:
    """A plan of up to seven leaves, some of them under a task of their own."""
    children: list[Action | Task] = []
    for at in range(draw(st.integers(1, 4))):
        group = draw(st.lists(leaves(), min_size=1, max_size=3))
        children.append(group[0] if len(group) == 1 else Task(Compound((f"task{at}",)), tuple(group)))
    return Plan(label, Task(Compound((label, Variable("P"))), tuple(children)))


@st.composite
def libraries(draw: st.DrawFn) -> tuple[Plan, ...]:
    labels = draw(st.lists(st.sampled_from(["g", "h", "k"]), min_size=1, max_size=4))
    return tuple(draw(plans(label)) for label in labels)


@st.composite
def observations(draw: st.DrawFn) -> Observation:
    name = draw(st.sampled_from(ACTIONS))
    args = draw(st.sampled_from([None, ("cup",), ("pot",), (Variable("Unknown"),)]))
    return Observation(name, args)


def counted(library: tuple[Plan, ...], seen: list[Observation], matcher: type) -> list[Explanation]:
    counting = Counting(library, matcher(library))
    for observation in seen:
        counting.observe(observation)
    found = list(counting.explanations())
    assert counting.count == len(found)
    return found


def same(engine: Explanation, specified: MarkedTree, library: tuple[Plan, ...]) -> bool:
    tree = engine.tree()
    return (
        engine.plan is library[specified.plan]
        and engine.binding == specified.binding
        and engine.score == specified.score
        and list(engine.marks) == specified.with_status("observed")
        and [tree.nodes[n]["status"] for n in specified.leaf_nodes]
        == [specified.tree.nodes[n]["status"] for n in specified.leaf_nodes]
    )


@given(libraries(), st.lists(observations(), min_size=1, max_size=4))
def test_by_name_the_engine_gives_the_explanations_of_algorithm_1_in_its_order(
    library: tuple[Plan, ...], seen: list[Observation]
) -> None:
    found, specified = counted(library, seen, NameMatcher), explanations(library, seen, NameMatcher(library))
    assert len(found) == len(specified)
    assert all(same(engine, tree, library) for engine, tree in zip(found, specified))


@given(libraries(), st.lists(observations(), min_size=1, max_size=4))
def test_with_parameters_the_engine_gives_the_explanations_of_algorithm_1_in_its_order(
    library: tuple[Plan, ...], seen: list[Observation]
) -> None:
    found, specified = counted(library, seen, ParameterMatcher), explanations(library, seen, ParameterMatcher(library))
    assert len(found) == len(specified)
    assert all(same(engine, tree, library) for engine, tree in zip(found, specified))


@given(libraries(), st.lists(observations(), min_size=1, max_size=4))
def test_the_sums_of_scores_are_those_of_the_enumerated_explanations(
    library: tuple[Plan, ...], seen: list[Observation]
) -> None:
    counting = Counting(library, ParameterMatcher(library))
    for observation in seen:
        counting.observe(observation)
    specified = explanations(library, seen, ParameterMatcher(library))
    for plan, total in enumerate(counting.kernel.masses(counting.level)):
        assert abs(total - sum(tree.score for tree in specified if tree.plan == plan)) < 1e-12


@given(libraries(), st.lists(observations(), min_size=1, max_size=3), observations())
def test_undoing_an_observation_leaves_the_counts_as_they_were(
    library: tuple[Plan, ...], seen: list[Observation], more: Observation
) -> None:
    counting = Counting(library, ParameterMatcher(library))
    for observation in seen:
        counting.observe(observation)
    before = (counting.count, counting.posterior(), list(counting.explanations()))
    counting.observe(more)
    counting.undo()
    assert (counting.count, counting.posterior(), list(counting.explanations())) == before


@settings(max_examples=5)
@given(st.integers(20, 40))
def test_the_stream_is_lazy_where_there_are_more_explanations_than_atoms(length: int) -> None:
    plan = Plan("g", Task(Compound(("g",)), tuple(Action(Compound(("a",))) for _ in range(length * 2))))
    counting = Counting([plan], NameMatcher([plan]))
    for _ in range(length):
        counting.observe(Observation("a"))
    assert counting.count > 10**10
    first = list(islice(counting.explanations(), 3))
    assert [found.marks[-1] for found in first] == [length - 1, length, length]
