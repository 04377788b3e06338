"""Readings: what the knowledge base cuts, why, what undoing does, and what the robot would do."""

import pytest
from readings import reading

from casper import Domain
from casper.engine.reading.policy import best, strict
from casper.engine.recognition.standing import Standing
from casper.kb.errors import CasperError, PlanError


def texts(actions):
    return [repr(action) for action in actions]


def test_a_fresh_reading_explains_nothing_yet():
    fresh = reading()
    assert (fresh.count, fresh.outcome, fresh.confidence, fresh.best(3), fresh.frontier) == (0, None, 0.0, [], ())


def test_the_posterior_sums_to_one_while_something_explains_the_observations():
    for seen in (["pick_and_place"], ["pick_and_place", "pick_and_place"], ["eat"], ["wash"]):
        assert sum(reading(*seen).posterior.values()) == pytest.approx(1.0)


def test_confidence_is_the_best_explanations_share_and_not_the_goals_posterior():
    seen = reading("pick_and_place")
    assert seen.confidence == pytest.approx(3 / 13)
    assert seen.posterior["breakfast"] > seen.confidence


def test_what_is_known_of_one_leaf_flows_to_the_others():
    assert texts(reading("pick_and_place(meal, hobs)").frontier) == [
        "cook(meal, hobs)",
        "pick_and_place(meal, plate)",
        "eat(meal, plate)",
        "pick_and_place(plate, sink)",
        "wash(plate, sink)",
    ]


def test_an_unknown_argument_agrees_with_every_value():
    assert reading("pick_and_place(_, hobs)").outcome == "lunch"


def test_an_action_that_fits_no_parameters_explains_nothing_and_says_so():
    seen = reading("pick_and_place(biscuits, sink)")
    assert seen.count == 0
    assert any("not biscuits" in reason for reason in seen.rejected["drink"])


def test_a_goal_rejected_earlier_keeps_its_reason():
    seen = reading("pick_and_place(bottle, glass)", "sip", "pick_and_place")
    assert seen.rejected["lunch"][0] == "Food of lunch is meal, not bottle"


def test_a_goal_without_the_action_is_rejected_for_that():
    assert reading("sip").rejected == {"breakfast": ("breakfast has no sip",), "lunch": ("lunch has no sip",)}


def test_a_goal_whose_action_lies_behind_is_rejected_for_that():
    assert "is left in lunch" in reading("wash", "cook").rejected["lunch"][0]


def test_undo_goes_back_to_where_the_reading_was():
    seen = reading("pick_and_place(meal, hobs)")
    before = seen.to_json()
    seen.observe("wash")
    seen.observe("cook")
    seen.undo()
    seen.undo()
    assert seen.to_json() == before


def test_undoing_nothing_is_refused():
    with pytest.raises(CasperError, match="no observation"):
        reading().undo()


@pytest.mark.parametrize("action", ["fly", "eat(biscuits)", "pick_and_place(a, b, c)"])
def test_an_action_no_plan_has_is_refused_and_changes_nothing(action):
    seen = reading("pick_and_place")
    with pytest.raises(PlanError):
        seen.observe(action)
    assert len(seen.observations) == 1


def test_the_robot_takes_the_longest_run_it_can_do_and_waits_for_what_lies_before():
    plan = reading("pick_and_place(biscuits, plate)").plan_for("tiago")
    assert texts(plan.waiting) == ["eat(biscuits, plate)"]
    assert texts(plan.actions) == ["pick_and_place(plate, sink)", "wash(plate, sink)"]


def test_of_two_equally_long_runs_the_robot_takes_the_later():
    plan = reading("pick_and_place(meal, hobs)").plan_for("tiago")
    assert texts(plan.actions) == ["pick_and_place(plate, sink)", "wash(plate, sink)"]
    assert len(plan.waiting) == 3


def test_without_verification_the_robots_part_is_still_known_in_full():
    plan = reading("pick_and_place", "sip", verification=False).plan_for("tiago")
    assert texts(plan.actions) == ["pick_and_place(glass, sink)", "wash(glass, sink)"]


def test_a_human_helper_could_do_everything():
    assert len(reading("pick_and_place(meal, hobs)").plan_for("human").actions) == 5


def test_strict_commits_to_a_sole_explanation_even_with_misses():
    assert strict(Standing(1, "drink", 1, 0)) == "drink"


def test_strict_waits_while_the_best_explanation_misses_a_leaf():
    assert strict(Standing(2, "breakfast", 1, 0)) is None
    assert best(Standing(2, "breakfast", 1, 0)) == "breakfast"


def test_no_policy_decides_a_tie_between_goals():
    assert strict(Standing(2, "breakfast", 0, 1)) is None
    assert best(Standing(2, "breakfast", 0, 1)) is None


def test_verdicts_may_depend_on_what_was_done_before(tmp_path):
    (tmp_path / "ontology.pl").write_text(
        'human(ann).\nwarm(A) :- human(A).\neat(A) :- human(A).\nnever("first warm it") :- claim(eat(_)), \\+ did(warm(_), _).\n'
    )
    (tmp_path / "plans.pl").write_text("cold --> eat.\nhot --> warm, eat.\n")
    domain = Domain.load(tmp_path)
    cold = domain.reading()
    cold.observe("eat")
    assert (cold.count, cold.rejected["cold"]) == (0, ("first warm it",))
    hot = domain.reading()
    hot.observe("warm")
    hot.observe("eat")
    assert hot.outcome == "hot"


def test_the_best_explanation_alone_is_what_one_gets_without_a_number():
    seen = reading("eat", verification=False)
    assert seen.count > 1
    assert seen.best() == [seen.first]
    assert [found.goal for found in seen.best(2)] != []
    assert len(seen.best(2)) == 2
