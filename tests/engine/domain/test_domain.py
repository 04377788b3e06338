"""Domains: what is loaded of a folder, who is who, and what the knowledge base lets an agent do of a plan."""

import pytest

from casper.engine.domain.domain import Domain, find_domain
from casper.engine.explanation.situation import Situation
from casper.kb.errors import CasperError, DomainError, PlanError

ONTOLOGY = """human(ann). human(bob). robot(rob). robot(tia). cup(mug). sink(sink).
agent(X) :- human(X). agent(X) :- robot(X).
fill(A, C) :- human(A), cup(C).
wash(A, C, S) :- agent(A), cup(C), sink(S).
never("fill it first") :- claim(wash(_, C, _)), \\+ did(fill(_, C), _).
"""
PLANS = "goal(tea(C)) :- cup(C).\ntea(C) --> fill(C), wash(C, S).\n"


def domain(folder, ontology=ONTOLOGY, plans=PLANS, **files):
    for name, text in {"ontology": ontology, "plans": plans, **files}.items():
        if text is not None:
            (folder / f"{name}.pl").write_text(text)
    return Domain.load(folder)


def test_a_folder_is_a_knowledge_base_and_a_library(tmp_path):
    found = domain(tmp_path, actions="setting(actions, confirm, 3).")
    assert found.verifies and found.library.goals == ("tea",)
    assert list(found.kb.rows("setting", 3)) == [("actions", "confirm", 3)]
    assert {str(row["A"]) for row in found.kb.query("step(tea(mug), _, A)")} >= {"fill(mug)"}
    assert {file.name for file in found.files} == {"ontology.pl", "plans.pl", "actions.pl"}


def test_the_actions_of_plans_are_what_valid_lists(tmp_path):
    found = domain(tmp_path)
    assert {str(answer["S"]) for answer in found.kb.query("valid(S)")} == {"fill(ann, mug)", "fill(bob, mug)"}


def test_a_relation_that_the_author_wrote_is_not_made_of_the_plans(tmp_path):
    found = domain(tmp_path, ontology=ONTOLOGY + "task(mine).\n")
    assert [row for row in found.kb.rows("task", 1)] == [("mine",)]


def test_without_stated_goals_every_goal_holds(tmp_path):
    found = domain(tmp_path, plans="tea(C) --> fill(C).\nnap --> rest.\n", ontology=ONTOLOGY + "rest(A) :- agent(A).\n")
    assert found.kb.ask("goal(nap)") and found.kb.ask("goal(tea(mug))")


def test_without_an_ontology_goals_hold_whatever_their_conditions(tmp_path):
    found = domain(tmp_path, ontology=None)
    assert not found.verifies
    assert found.kb.ask("goal(tea(anything))")


@pytest.mark.parametrize(
    ("settings", "partner", "robot"),
    [
        ("", "ann", "rob"),
        ("setting(agents, partner, bob).", "bob", "rob"),
        ("setting(agents, robot, tia).", "ann", "tia"),
        ("setting(focus, partner, bob). setting(agents, x, tia).", "ann", "rob"),
    ],
)
def test_partner_and_robot_are_the_named_ones_or_the_first(tmp_path, settings, partner, robot):
    found = domain(tmp_path, actions=settings)
    assert (found.partner, found.robot) == (partner, robot)


def test_where_nobody_is_named_partner_and_robot_are_called_so(tmp_path):
    found = domain(tmp_path, ontology=None)
    assert (found.partner, found.robot) == ("human", "robot")


def capability(found, closed, leaf, agent, binding=(None, None)):
    (plan,) = found.library.ways
    action, can = found.capability(Situation.of(plan, closed, binding), leaf, agent)
    return str(action), can


def test_an_agent_can_do_what_is_valid_once_what_lies_before_is_done(tmp_path):
    found = domain(tmp_path)
    assert capability(found, 0, 0, "ann") == ("fill(mug)", True)
    assert capability(found, 0, 0, "rob") == ("fill(mug)", False)
    assert capability(found, 0, 1, "rob") == ("wash(mug, sink)", True)
    assert capability(found, 1, 1, "rob", ("mug", None)) == ("wash(mug, sink)", True)


def test_a_shipped_domain_goes_by_its_name_and_a_folder_by_its_path(tmp_path):
    assert find_domain("kitchen").name == "kitchen"
    with pytest.raises(DomainError, match=r"there is no domain 'nowhere': give a folder, or one of .*kitchen"):
        find_domain("nowhere")
    with pytest.raises(DomainError, match="holds no domain"):
        find_domain(tmp_path)
    (tmp_path / "scene.pl").write_text("")
    assert find_domain(tmp_path) == tmp_path.resolve()


def test_a_plan_with_an_action_that_nobody_can_do_is_refused(tmp_path):
    with pytest.raises(PlanError, match=r"a plan has the action fil/1, but no rule fil/2 says when it is valid; did you mean fill\?"):
        domain(tmp_path, plans="tea(C) --> fil(C).\n")


def test_a_domain_without_plans_explains_nothing(tmp_path):
    with pytest.raises(PlanError, match="has no plans to explain anything with"):
        domain(tmp_path, plans=None).reading()


@pytest.mark.parametrize("wrong", [{"policy": "guess"}, {"score": "guess"}, {"goals": 0}, {"noise": -1.0}, {"noise": 2.0}, {"budget": 0}])
def test_a_reading_that_cannot_be_is_refused(tmp_path, wrong):
    with pytest.raises(CasperError):
        domain(tmp_path).reading(**wrong)


def test_readings_never_share_what_was_observed_and_see_a_changed_base(tmp_path):
    found = domain(tmp_path)
    first, second = found.reading(), found.reading()
    first.observe("fill")
    assert (len(first.observations), len(second.observations)) == (1, 0)
    found.kb.assert_("cup(jar)")
    third = found.reading()
    third.observe("fill(jar)")
    assert third.count == 1


def test_priors_weigh_the_goals(tmp_path):
    plans = "goal(g). goal(h). g --> a, b. h --> a, c. prior(g, 0.75). prior(h, 0.25).\n"
    seen = domain(tmp_path, ontology=None, plans=plans).reading()
    seen.observe("a")
    assert seen.posterior == {"g": 0.75, "h": 0.25}
