"""Lazily grown plans against plans that are listed: the same observations, misses and parameters, on random grammars."""

from __future__ import annotations

import pytest
from grown import networks, states_after
from hypothesis import assume, given
from hypothesis import strategies as st
from tellers import Counting

from casper.engine.verification.binding import bindings_of
from casper.engine.verification.matching import NameMatcher, ParameterMatcher
from casper.engine.verification.observation import Observation
from casper.kb.errors import PlanError
from casper.kb.terms.terms import Compound, Variable, as_term
from casper.kb.terms.unification import is_ground, substitute
from casper.plans.library import PlanLibrary

ARGUMENTS = ("cup", "pot", "P", "Q")
ACTIONS = ("a", "b", "c")
TASKS = ("t", "u")


@st.composite
def items(draw: st.DrawFn, tasks: tuple[str, ...], depth: int = 2) -> str:
    """One item of a body."""
    kinds = ["action", "action", *(["task"] if tasks else []), *(["group"] if depth else [])]
    kind = draw(st.sampled_from(kinds))
    if kind == "action":
        return f"{draw(st.sampled_from(ACTIONS))}({draw(st.sampled_from(ARGUMENTS))})"
    if kind == "task":
        return f"{draw(st.sampled_from(tasks))}({draw(st.sampled_from(ARGUMENTS))})"
    parts = [draw(items(tasks, depth - 1)) for _ in range(draw(st.integers(1, 3)))]
    shape = draw(st.sampled_from(["sequence", "choice", "optional", "unordered", "steps", "repeat"]))
    if shape == "sequence":
        return f"({', '.join(parts)})"
    if shape == "choice":
        return f"({' ; '.join(parts)})"
    if shape == "steps":
        pairs = [(x, y) for x in range(len(parts)) for y in range(x + 1, len(parts))]
        chosen = draw(st.lists(st.sampled_from(pairs), unique=True)) if pairs else []
        order = ", ".join(f"x{x} < x{y}" for x, y in chosen)
        return f"steps([{', '.join(f'x{n}: {part}' for n, part in enumerate(parts))}], [{order}])"
    if shape == "repeat":
        least = draw(st.integers(0, 2))
        return f"repeat({parts[0]}, {least}, {draw(st.integers(max(1, least), 3))})"
    return f"{shape}({', '.join(parts)})"


@st.composite
def grammars(draw: st.DrawFn, heads: tuple[str, ...] = ("P", "Q")) -> str:
    """Two goals over two tasks, one of which may use the other; nothing is recursive, a task may have nothing to do."""
    found = ["goal(g(_))", "goal(h)"]
    for task, below in (("u", ()), ("t", ("u",))):
        for _ in range(draw(st.integers(1, 2))):
            body = draw(items(below, 1))
            found.append(f"{task}({draw(st.sampled_from(heads))}) --> {draw(st.sampled_from([body, body, body, '[]']))}")
    found.append(f"g(P) --> {draw(items(TASKS))}, b(P)")
    found.append(f"h --> {draw(items(TASKS))}, c(pot)")
    return ". ".join(found) + "."


def listed_library(text: str) -> PlanLibrary:
    """The library; an example in which some goal has no plan, or too many, is left out."""
    try:
        library = PlanLibrary.from_text(text)
        ways = library.ways
    except PlanError:
        assume(False)
    assume(len(ways) <= 60 and sum(len(way.leaves) for way in ways) <= 400)
    return library


SEEN = st.builds(Observation, st.sampled_from(ACTIONS), st.sampled_from([None, ("cup",), ("pot",), (Variable("Unknown"),)]))


def listed(library: PlanLibrary, seen: list[Observation], matcher, only_done: bool = False) -> dict[object, int]:
    """By goal with what is known of its parameters the fewest leaves that were missed."""
    ways = library.ways
    counting = Counting(ways, matcher(ways))
    for observation in seen:
        counting.observe(observation)
        assume(sum(map(len, counting.level.counts.values())) <= 5000)  # with misses allowed they double by the leaf
    found: dict[object, int] = {}
    for plans, nodes in counting.level.counts.items():
        for node in nodes if plans else ():
            chart = ways[plans[0]].chart
            if only_done and chart.belonging(chart.entered(node[1][0])) & ~node[1][0]:
                continue
            goal = shown(substitute(ways[plans[0]].goal, bindings_of(ways[plans[0]], node[1][4])))
            found[goal] = min(node[1][3], found.get(goal, node[1][3]))
    return found


def shown(goal: Compound) -> object:
    return tuple(part if is_ground(part) else None for part in goal)


def grown(text: str, seen: list[Observation], by_name: bool, most_missed: int) -> dict[object, int]:
    going = networks(text, by_name=by_name, most_missed=most_missed)
    found: dict[object, int] = {}
    for state, missed in states_after(going, list(seen)).items():
        goal = shown(going.goal_of(state))
        found[goal] = min(missed, found.get(goal, missed))
    return found


def without_names(found: dict[object, int]) -> dict[object, int]:
    """By goals alone: names say nothing of parameters, but productions may."""
    fewest: dict[object, int] = {}
    for goal, missed in found.items():
        fewest[goal[0]] = min(missed, fewest.get(goal[0], missed))
    return fewest


@given(grammars(), st.lists(SEEN, min_size=1, max_size=4))
def test_what_is_grown_takes_what_the_listed_plans_take_with_the_same_misses_and_parameters(text, seen):
    library = listed_library(text)
    assert grown(text, seen, False, 30) == listed(library, seen, ParameterMatcher)


@given(grammars(("P", "cup", "Q")), st.lists(SEEN, min_size=1, max_size=4))
def test_what_a_task_to_come_settles_is_not_known_yet_and_rules_nothing_out(text, seen):
    library = listed_library(text)
    free = grown(text, seen, False, 30)
    for special, missed in listed(library, seen, ParameterMatcher).items():
        assert any(covers(general, special) and fewest <= missed for general, fewest in free.items())


def covers(general: object, special: object) -> bool:
    """Whether a goal is as another one where anything is known of it."""
    return all(known in (None, value) for known, value in zip(general, special))


@given(grammars(), st.lists(SEEN, min_size=1, max_size=4))
def test_by_names_the_same_goals_are_left_with_the_same_misses(text, seen):
    library = listed_library(text)
    assert without_names(grown(text, seen, True, 30)) == without_names(listed(library, seen, NameMatcher))


@st.composite
def circles(draw: st.DrawFn) -> str:
    """Two tasks that may contain each other and themselves anywhere; every round has an action."""
    found = ["goal(g(_))", "g(P) --> t(P), c(P)", f"t({draw(st.sampled_from(['P', 'cup', '_']))}) --> {draw(st.sampled_from(['[]', 'a(P)', 'b(cup)']))}"]
    for task in ("t", "u"):
        for _ in range(draw(st.integers(1, 2))):
            parts = [f"{draw(st.sampled_from(ACTIONS))}({draw(st.sampled_from(ARGUMENTS))})"]
            parts += [f"{draw(st.sampled_from(TASKS))}({draw(st.sampled_from(ARGUMENTS))})" for _ in range(draw(st.integers(0, 2)))]
            parts = draw(st.permutations(parts))
            shape = draw(st.sampled_from(["{}", "{}", "optional({}), b(P)", "({} ; b(Q)), c(P)"]))
            found.append(f"{task}({draw(st.sampled_from(['P', 'Q', 'pot']))}) --> {shape.format(', '.join(parts))}")
    found.append("u(P) --> b(P)")
    return ". ".join(found) + "."


@given(circles(), st.lists(SEEN, min_size=1, max_size=2))
def test_tasks_that_contain_themselves_take_what_they_take_when_unrolled_far_enough(text, seen):
    library = listed_library(f"setting(plans, recursion, 3). {text}")
    free = set(grown(text, seen, False, 0))
    unrolled = {goal for goal, missed in listed(library, seen, ParameterMatcher).items() if missed == 0}
    assert all(any(covers(general, special) for general in free) for special in unrolled)
    assert all(any(covers(general, special) for special in unrolled) for general in free)


@given(circles(), st.lists(SEEN, min_size=1, max_size=2))
def test_they_are_finished_where_the_unrolled_ones_are(text, seen):
    library = listed_library(f"setting(plans, recursion, 3). {text}")
    going = networks(text, most_missed=0)
    over = {goal for goal, missed in listed(library, seen, ParameterMatcher, only_done=True).items() if missed == 0}
    assert any(map(going.is_done, states_after(going, list(seen)))) == bool(over)


def test_circles_through_groups_without_an_order_are_said_to_be_cut():
    text = "goal(g). g --> t, c. t --> unordered(a, t). t --> a, b."
    going = networks(text, most_missed=0)
    assert states_after(going, ["a"]) and going.was_cut


def test_nothing_of_it_depends_on_how_deep_the_task_is():
    text = "goal(go(_, _)). go(X, X) --> []. go(X, Y) --> go(X, Z), step(Z, Y)."
    steps = [f"step(p{n}, p{n + 1})" for n in range(40)]
    going = networks(text, most_missed=0)
    [(state, missed)] = states_after(going, steps).items()
    assert (missed, going.is_done(state), going.was_cut) == (0, True, False)
    assert not states_after(going, [*steps, "step(p7, p8)"])


def test_the_states_of_an_unordered_row_are_what_is_left_of_it():
    names = [f"n{number}" for number in range(12)]
    going = networks(f"goal(g). g --> unordered({', '.join(names)}), z.", most_missed=0)
    assert len(states_after(going, names[::-1])) == 1
    assert len(states_after(networks("goal(g). g --> unordered(a, a, a, b), z.", most_missed=0), ["a", "b", "a"])) == 1


def test_a_library_of_more_plans_than_can_be_counted_is_grown_where_it_is_observed():
    rules = " ".join(f"t{n} --> t{n + 1}, t{n + 1} ; a, t{n + 1}." for n in range(80))
    going = networks(f"goal(g). g --> t0. {rules} t80 --> b ; c.", most_missed=0)
    states = states_after(going, ["a", "b"])
    assert states and as_term(going.goal_of(next(iter(states)))) == "g"


@pytest.mark.parametrize("body", ["t, t", "unordered(t, t)", "unordered(t, t, t)"])
def test_ways_that_begin_alike_share_the_chance_of_their_action(body):
    going = networks(f"goal(g(_, _)). g(_, _) --> {body}. t --> a(X), c(X). t --> a(X), d(X).", most_missed=0)
    state = going.begin(0)
    steps = going.steps(state, Observation("a", ("cup",)), None)
    assert len(steps) > 1 and going.choices(state) == 1
    assert sum(step.part for step in steps) == pytest.approx(1.0)


def test_actions_that_are_open_beside_each_other_are_leaves_of_their_own():
    going = networks("goal(g(_, _)). g(X, Y) --> z, unordered((a(X), b), (a(Y), c)).", most_missed=0)
    [begun] = going.steps(going.begin(0), Observation("z", ()), None)
    steps = going.steps(begun.state, Observation("a", ("cup",)), None)
    assert going.choices(begun.state) == 2
    assert [step.part for step in steps] == [1.0, 1.0]


def test_what_is_nested_too_deeply_is_refused_in_a_sentence():
    rules = " ".join(f"t{n} --> t{n + 1}, t{n + 1} ; a, t{n + 1}." for n in range(500))
    going = networks(f"goal(g). g --> t0. {rules} t500 --> b ; c.", most_missed=0)
    with pytest.raises(PlanError, match="the plans of g are nested too deeply to be grown"):
        states_after(going, ["b"])
