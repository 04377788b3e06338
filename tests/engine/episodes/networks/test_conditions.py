"""Conditions in plans, asked where they stand: against every value their parameters may have, on small libraries."""

from __future__ import annotations

from itertools import product

import pytest
from grown import networks, states_after
from hypothesis import assume, given
from hypothesis import strategies as st
from tellers import Counting

from casper.engine.domain.domain import Domain
from casper.engine.episodes.enumerated import Enumerated
from casper.engine.reading.reading import nobody_can
from casper.engine.verification.observation import Observation
from casper.engine.verification.verified_matching import VerifyingMatcher
from casper.kb.base import KnowledgeBase
from casper.kb.errors import PlanError
from casper.kb.terms.terms import Compound
from casper.kb.terms.unification import substitute
from casper.plans.grammar.conditions import condition_clauses
from casper.plans.library import PlanLibrary
from casper.plans.trees.nodes import Action, Condition
from casper.plans.trees.spelling import spelled_out

FACTS = """human(ann). robot(rob). p(cup). q(cup). q(pot). near(cup, pot).
a(_, X) :- q(X). b(_, X) :- q(X). c(_, X) :- q(X). done(X) :- did(a(_, X), _)."""
CONDITIONS = ("p({})", "q({})", "\\+ p({})", "done({})", "\\+ done({})", "near({}, {})", "{} \\= {}")
THINGS = ("cup", "pot")


def base(library: PlanLibrary) -> KnowledgeBase:
    kb = KnowledgeBase.from_text(FACTS)
    kb.add(condition_clauses(library.productions))
    kb.compile()
    return kb


@st.composite
def items(draw: st.DrawFn, tasks: tuple[str, ...]) -> str:
    argument = st.sampled_from(["X", "Y", "cup"])
    kind = draw(st.sampled_from(["action", "action", "condition", *(["task"] if tasks else [])]))
    if kind == "condition":
        shape = draw(st.sampled_from(CONDITIONS))
        return f"{{{shape.format(*(draw(argument) for _ in range(shape.count('{}'))))}}}"
    name = draw(st.sampled_from(tasks if kind == "task" else ("a", "b", "c")))
    return f"{name}({draw(argument)})"


@st.composite
def grammars(draw: st.DrawFn) -> str:
    """A goal over a task of two ways, one of which may be to do nothing; conditions anywhere but in optional parts."""
    rows = [", ".join(draw(items(())) for _ in range(draw(st.integers(1, 3)))) for _ in range(2)]
    last = draw(st.sampled_from([rows[1], f"{draw(items(()).filter(lambda item: item[0] == '{'))}, []"]))
    parts = [draw(items(("t",))) for _ in range(draw(st.integers(1, 3)))]
    body = draw(st.sampled_from(["{}", "unordered({})"])).format(", ".join(parts))
    return f"goal(g(_)). g(X) --> {body}, b(X). t(X) --> {rows[0]}. t(X) --> {last}."


def possible(library: PlanLibrary, kb: KnowledgeBase, seen: list[Observation]) -> bool:
    """Whether some order of some way, with some values, has just these actions first, its conditions holding."""
    return any(
        fits(_steps(plan.root), dict(zip(plan.variables, values)), kb, seen)
        for way in library.ways
        for plan in spelled_out(way)
        for values in product(THINGS, repeat=len(plan.variables))
    )


def _steps(node) -> list[Action | Condition]:
    if isinstance(node, (Action, Condition)):
        return [node]
    return [step for child in node.children for step in _steps(child)]


def fits(steps, values, kb: KnowledgeBase, seen: list[Observation]) -> bool:
    """Conditions are asked when an action after them is seen, or when nothing comes after them any more."""
    history: list[tuple[Compound, float]] = []
    waiting: list[Compound] = []
    rest = list(seen)
    while steps:
        step, steps = steps[0], steps[1:]
        if isinstance(step, Condition):
            waiting.append(substitute(step.term, values))
            continue
        if not rest:
            return True
        action = substitute(step.term, values)
        statement = Compound((action.functor, "ann", *action.args))
        if action != Compound((rest[0].action, *rest[0].args)) or kb.verify(statement, history).valid is False:
            return False
        if any(kb.why_not(condition, history) is not None for condition in waiting):
            return False
        waiting = []
        history.append((statement, float(len(history) + 1)))
        rest = rest[1:]
    return not rest and all(kb.why_not(condition, history) is None for condition in waiting)


SEEN = st.lists(st.builds(Observation, st.sampled_from("abc"), st.tuples(st.sampled_from(THINGS))), min_size=1, max_size=3)


@given(grammars(), SEEN)
def test_what_some_values_allow_is_taken_and_what_all_refuse_is_not(text, seen):
    try:
        library = PlanLibrary.from_text(text)
        _ = library.ways
    except PlanError:
        assume(False)
    kb = base(library)
    expected = possible(library, kb, seen)
    going = networks(text, kb, partner="ann", most_missed=0)
    states = states_after(going, seen, "ann")
    counting = Counting(library.ways, VerifyingMatcher(library.ways, kb, "ann"))
    for observation in seen:
        counting.observe(observation)
    listed = any(node[1][3] == 0 for plans, nodes in counting.level.counts.items() if plans for node in nodes)
    enumerated = Enumerated(library.ways, VerifyingMatcher(library.ways, kb, "ann"), nobody_can, most_missed=0)
    assert bool(states_after(enumerated, seen, "ann")) == listed
    if expected:
        assert states and listed
    elif not any(state.open for state in states):  # what is open is not known yet, and unknown is not no
        assert not states
    if not states:
        assert not expected


KB = """human(ann). robot(rob). agent(X) :- human(X). agent(X) :- robot(X). vessel(plate). vessel(cup). at(plate, sink).
pick(A, V) :- agent(A), vessel(V). wash(A, V) :- agent(A), vessel(V). dry(A, V) :- agent(A), vessel(V).
van(v1). van(v2). crew(c1). crew(c2). go(A, X) :- agent(A), thing(X). thing(X) :- van(X). thing(X) :- crew(X)."""


def going_on(text: str, **options):
    library = PlanLibrary.from_text(text)
    kb = KnowledgeBase.from_text(KB)
    kb.add(condition_clauses(library.productions))
    return networks(text, kb, partner="ann", robot="rob", **options)


def test_a_way_whose_condition_fails_is_refused_with_the_reason_of_the_base():
    going = going_on("goal(g(_)). g(V) --> {vessel(V), \\+ at(V, sink)}, pick(V), wash(V).")
    assert going.reasons(going.begin(0), Observation("pick", ("plate",)), None) == ("at(plate, sink) holds",)


def test_a_condition_sees_what_was_done():
    text = "goal(g(_)). g(V) --> pick(V), more(V). more(V) --> {did(pick(_, V), _)}, wash(V). more(V) --> {\\+ did(pick(_, V), _)}, dry(V)."
    assert states_after(going_on(text), ["pick(cup)", "wash(cup)"], "ann")
    assert not states_after(going_on(text, most_missed=0), ["pick(cup)", "dry(cup)"], "ann")


def test_conditions_that_exclude_each_other_are_told_before_anything_is_known():
    text = "goal(g(_)). g(X) --> {van(X)}, pick(cup), {crew(X)}, wash(cup)."
    assert states_after(going_on(text), ["pick(cup)"], "ann")
    assert not states_after(going_on(text), ["pick(cup)", "wash(cup)"], "ann")


def test_what_is_passed_over_in_a_circle_was_asked_when_it_began():
    text = "goal(g(_)). g(V) --> t(V), wash(V). t(V) --> {\\+ did(pick(_, V), _)}, t(V), dry(V). t(V) --> pick(V)."
    assert states_after(going_on(text, most_missed=0), ["pick(cup)", "dry(cup)", "dry(cup)", "wash(cup)"], "ann")
    late = "goal(g(_)). g(V) --> t(V), wash(V). t(V) --> {did(pick(_, V), _)}, t(V), dry(V). t(V) --> pick(V)."
    assert not states_after(going_on(late, most_missed=0), ["pick(cup)", "dry(cup)"], "ann")


@pytest.mark.parametrize(("who", "others"), [("robot", "rob's"), ("rob", "rob's")])
def test_a_step_of_another_agent_is_not_taken_and_says_whose_it_is(who, others):
    going = going_on(f"goal(g). g --> by({who}, pick(cup)), wash(cup).")
    assert going.reasons(going.begin(0), Observation("pick", ("cup",)), "ann")[0] == f"pick(cup) is {others} step, not ann's"
    [step] = going.steps(going.begin(0), Observation("pick", ("cup",)), "rob")
    assert step.is_theirs


def test_steps_that_share_who_does_them_are_of_one_agent():
    going = going_on("goal(g). g --> by(W, pick(cup)), by(W, wash(cup)), dry(cup).")
    [step] = going.steps(going.begin(0), Observation("pick", ("cup",)), "ann")
    assert not going.steps(step.state, Observation("wash", ("cup",)), "rob")
    assert going.steps(step.state, Observation("wash", ("cup",)), "ann")


def test_what_looks_back_is_no_obstacle_where_something_is_to_be_done_before():
    text = "human(ann). act(A, X) :- human(A), thing(X). thing(cup). there :- did(act(_, nothing), _)."
    plans = "goal(achieve). achieve --> {there}. achieve --> act(X), achieve."
    reading = Domain.from_text(text, plans).reading()
    reading.observe("act(cup)")
    assert len(reading.frontier) == 1
