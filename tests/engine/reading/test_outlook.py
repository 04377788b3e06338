"""What is likely to come, and what to ask."""

from __future__ import annotations

from math import log2

import pytest
from readings import domain, reading

from casper.engine.explanation.situation import Situation
from casper.engine.reading.questions import entropy
from casper.plans.trees.chart import bits


def test_a_step_that_may_be_left_out_is_not_asked_about(tmp_path):
    text = "goal(g). goal(h). g --> eat, x. h --> (eat ; sip), optional(nap), y."
    seen = domain(tmp_path, text).reading()
    seen.observe("eat")
    asked = {(question.kind, question.about) for question in seen.questions()}
    assert ("goal", "g") in asked and ("step", "x") in asked
    assert not asked & {("done", "eat"), ("done", "sip"), ("step", "nap"), ("step", "sip")}


def test_an_open_choice_inside_a_part_that_was_begun_is_not_asked_about(tmp_path):
    text = "goal(g). goal(h). g --> a, optional((u, (v ; w, x))), z. h --> a, u, y."
    seen = domain(tmp_path, text).reading()
    seen.observe("a")
    seen.observe("u")
    asked = {(question.kind, question.about) for question in seen.questions()}
    assert ("step", "z") in asked
    assert not asked & {("step", "v"), ("step", "w"), ("step", "x")}


def test_the_smallest_alternative_does_not_count_as_done_once_another_was_taken(tmp_path):
    (plan,) = domain(tmp_path, "goal(g). g --> a, optional((u, (v ; w, x), y)), z.").library.ways
    closed = plan.chart.start
    for leaf in (0, 1, 3, 4):  # a, u, w, x
        closed = plan.chart.close(closed, leaf)
    done = Situation.of(plan, closed[0], ()).done
    assert [plan.leaves[leaf][0] for leaf in bits(done)] == ["a", "u"]


def test_a_plan_whose_rest_may_be_left_out_may_be_complete(tmp_path):
    seen = domain(tmp_path, "goal(g). g --> a, optional(b).").reading()
    seen.observe("a")
    assert seen.next_actions == {"b": 0.5, None: 0.5}


def test_the_next_action_is_the_first_that_misses_nothing():
    assert reading("pick_and_place(meal, hobs)").next_actions == {"cook(meal, hobs)": 1.0}
    assert reading("eat", "pick_and_place", "wash").next_actions == {None: 1.0}


def test_outlooks_are_the_shares_of_the_explanations():
    seen = reading("pick_and_place", "pick_and_place", verification=False)
    frontiers = {}
    for explanation in seen.explanations():
        frontiers[explanation.frontier] = frontiers.get(explanation.frontier, 0.0) + explanation.share
    assert seen.frontiers == pytest.approx(frontiers)
    plans = {}
    for explanation in seen.explanations():
        plan = seen.plan_for("tiago", explanation)
        plans[plan] = plans.get(plan, 0.0) + explanation.share
    assert {p: s for p, s in seen.plans_for("tiago").items()} == pytest.approx(plans)
    assert sum(seen.next_actions.values()) == pytest.approx(1.0)


def test_the_best_question_for_a_tie_tells_the_goals_apart():
    seen = reading("pick_and_place", "pick_and_place", "wash")
    assert seen.outcome is None
    question = seen.questions()[0]
    assert (str(question), question.yes) == ("is the goal lunch?", pytest.approx(0.4))
    assert question.gain == pytest.approx(entropy([0.4, 0.6]))


def test_a_question_never_gains_more_than_there_is_to_know():
    seen = reading("pick_and_place")
    most = entropy(list(seen.posterior.values()))
    gains = [question.gain for question in seen.questions()]
    assert gains == sorted(gains, reverse=True)
    assert all(0 <= gain <= min(most, 1.0) + 1e-9 for gain in gains)
    assert most <= log2(3)
