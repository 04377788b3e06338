"""The benchmarks of recognition at tiny sizes: both recognisers find the same answers. No time is judged."""

import random
import sys
from collections import Counter
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper.engine.recognition.choice import recogniser
from casper.engine.recognition.options import PAPER, Options
from casper.engine.verification.matching import NameMatcher, ParameterMatcher
from casper.engine.verification.observation import Observation
from casper.kb.terms.terms import Compound, Variable
from casper.plans.trees.nodes import Action, Shape, Task
from casper.plans.trees.plan import Plan

ROOT = Path(__file__).resolve().parent.parent
if str(ROOT / "benchmarks" / "recognition") not in sys.path:
    sys.path.append(str(ROOT / "benchmarks" / "recognition"))

from baseline import Baseline, TooMany  # noqa: E402
from comparison import Answer, answers, check, compared  # noqa: E402
from episodes import blurred, carried_out, episode, interleaved  # noqa: E402
from growth import Case, Line, Panel, copied, listed, measured, table  # noqa: E402
from libraries import AndOr, chains, choices, partly_ordered, strands, with_parameters  # noqa: E402
from shapes import ways  # noqa: E402

THINGS = ("cup", "pot", Variable("P"), Variable("Q"))
OPTIONS = [PAPER, Options(noise=0.1), Options(goals=2), Options(goals=2, noise=0.5)]
ACTIONS = st.builds(lambda name, thing: Action(Compound((name, thing))), st.sampled_from("abc"), st.sampled_from(THINGS))
SEEN = st.builds(Observation, st.sampled_from("abc"), st.sampled_from([None, ("cup",), ("pot",), (Variable("Unknown"),)]))


def shaped(nodes):
    """Nodes in any shape; the pairs of partly ordered ones are those of some bits of a number."""
    children = st.lists(nodes, min_size=1, max_size=3).map(tuple)
    whole = st.builds(Shape, st.sampled_from(["sequence", "optional", "choice", "unordered"]), children)
    return whole | st.builds(partly, children, st.integers(0, 7))


def partly(children, chosen):
    pairs = [(0, 1), (0, 2), (1, 2)]
    return Shape("steps", children, frozenset(p for at, p in enumerate(pairs) if chosen >> at & 1 and p[1] < len(children)))


TREES = st.recursive(ACTIONS, shaped, max_leaves=6)
ROOTS = st.tuples(TREES, ACTIONS)  # the last leaf is always done
LIBRARIES = st.lists(st.tuples(st.sampled_from("ghk"), ROOTS), min_size=1, max_size=3).map(
    lambda made: [Plan(label, Task(Compound((label, Variable("P"))), root), way) for way, (label, root) in enumerate(made)]
)


def agree(plans, matcher, options, seen):
    """Count, posterior and best after each observation; in the end, every explanation with its score."""
    engine, plain = recogniser(plans, matcher, options), Baseline(plans, matcher, options.goals, options.noise)
    check(list(answers(engine, seen)), list(answers(plain, seen)))
    assert engine.is_exact
    number = {id(plan): at for at, plan in enumerate(plans)}
    ours = Counter(told(((number[id(p.plan)], p.marks) for p in x.parts), x.score) for x in engine.explanations())
    assert ours == Counter(told(((p.plan, p.marks) for p in x.parts), plain.score(x)) for x in plain.explanations if x.parts)


def told(parts, score):
    return frozenset(parts), round(score, 12)


@given(LIBRARIES, st.lists(SEEN, min_size=1, max_size=4), st.sampled_from([NameMatcher, ParameterMatcher]), st.sampled_from(OPTIONS))
def test_the_plain_recogniser_and_the_engines_explain_alike(plans, seen, matcher, options):
    agree(plans, matcher(plans), options, seen)


@pytest.mark.parametrize("options", OPTIONS, ids=["one goal", "one, noise", "two", "two, noise"])
@pytest.mark.parametrize(
    "plans",
    [chains(12, 6, 2), with_parameters(12, 6, 3), partly_ordered(4, 6), strands(4, 2, 3, 3), [choices(5, 3, 6)]],
    ids=["chains", "parameters", "partly ordered", "strands", "choices"],
)
def test_they_explain_the_libraries_of_the_figures_alike(plans, options):
    chance = random.Random(0)
    rows = [carried_out(plan, chance, 0.4)[:3] for plan in chance.sample(plans, min(options.goals, len(plans)))]
    seen = interleaved(rows, chance)[:4]
    agree(plans, ParameterMatcher(plans), options, seen)
    agree(plans, ParameterMatcher(plans), options, blurred(seen[:3]))


@pytest.mark.parametrize("order", ["ordered", "partly", "unordered"])
def test_an_and_or_library_has_as_many_productions_as_it_says(order):
    library = AndOr(order=order).library()
    assert (len(library.goals), len(library.ways), len(library.productions)) == (5, 5, 245)
    small = AndOr(2, ((2,), (2,)), symbols=4, order=order).library().ways
    agree(small, NameMatcher(small), Options(goals=2), carried_out(small[0], random.Random(0), 0.0))


def test_an_episode_can_be_explained_without_misses():
    for plan in (*AndOr().library().ways, choices(17, 3, 10)):
        engine = recogniser([plan], NameMatcher([plan]), PAPER)
        for observation in carried_out(plan, random.Random(1), missing=0.0)[:4]:
            engine.observe(observation)
        assert any(found.missed == 0 for found in engine.explanations())
    assert ways(plan.root) == 3**17


def test_a_plain_recogniser_gives_up_beyond_its_budget():
    plans = chains(10, 8, 1)
    plain = Baseline(plans, NameMatcher(plans), budget=200)
    plain.observe(Observation("a0"))
    with pytest.raises(TooMany, match="more than 200 explanations"):
        plain.observe(Observation("a0"))


@pytest.mark.parametrize("wrong", [(2, 1.0, 0.5), (1, 0.9, 0.5), (1, 1.0, 0.6), (3, 1.0, 0.5, False)])
def test_a_comparison_of_different_answers_is_refused(wrong):
    count, share, *rest = wrong
    right = Answer(1, {"g": 1.0}, 0.5)
    check([right, Answer(0, {"g": 0.0}, 0.0, False)], [right, right])
    with pytest.raises(AssertionError, match="observation 1"):
        check([Answer(count, {"g": share}, *rest)], [right])


def test_a_comparison_is_told_in_two_lines(capsys):
    plans = chains(4, 5, 2)
    compared("four goals", plans, NameMatcher(plans), PAPER, [episode(plans, 2, random.Random(0))])
    first, second = capsys.readouterr().out.splitlines()
    assert first.startswith("four goals ") and first.endswith("explanations, Chains")
    assert second.startswith("  plain baseline, equal answers ") and " ms  x " in second


def test_growth_leaves_out_what_would_list_too_much():
    cases = [Case(3, 4, 1, seen) for seen in (1, 2)]
    lines = {"plain list": Line(listed(1), 12), "tree copies": Line(copied)}
    panel = Panel("three goals", "observations", "seen", cases, lines)
    points = measured(panel)
    assert [at for at, _ in points["plain list"]] == [1] and [at for at, _ in points["tree copies"]] == [1, 2]
    assert table(panel, points).splitlines()[-1].split()[:2] == ["2", "–"]
