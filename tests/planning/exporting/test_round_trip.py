"""A problem that was imported and exported is imported as the same text again."""

import warnings

import pytest
from hypothesis import given
from hypothesis import strategies as st

pytest.importorskip("unified_planning", reason="planning needs: pip install 'casper-hri[planning]'")

from planning_problems import problems

from casper import Domain
from casper.kb.errors import CasperError
from casper.planning import LeftOut, Who, from_problem, import_problem, to_problem

NOBODY = Who()
KEPT = ["basic_exists", "basic_forall", "counter", "robot_loader_adv", "robot_fluent_of_user_type", "hierarchical_blocks_world",
        "robot_locations_connected", "robot_real_constants", "htn-go"]  # fmt: skip


def again(problem, who=NOBODY):
    first = import_problem(problem, who)
    with warnings.catch_warnings():
        warnings.simplefilter("error", LeftOut)
        return first.files, import_problem(to_problem(first.domain()), who).files


def basic_with(tmp_path, examples, file, text):
    """The framework's basic example as a domain, with a text more in one of its files."""
    import_problem(examples["basic"].problem).write(tmp_path / "basic")
    with (tmp_path / "basic" / file).open("a") as there:
        there.write(text)
    return Domain.load(tmp_path / "basic")


@given(problems(), st.sampled_from([None, "vehicle", "movable"]))
def test_a_problem_without_tasks_comes_back_unchanged(problem, agent):
    before, after = again(problem, Who(agent))
    assert after == before


@given(problems(hierarchical=True), st.sampled_from([None, "vehicle"]))
def test_a_hierarchy_with_recursive_methods_comes_back_unchanged(problem, agent):
    before, after = again(problem, Who(agent))
    assert after == before


@pytest.mark.parametrize("name", KEPT)
def test_an_example_of_the_framework_comes_back_unchanged(examples, name):
    before, after = again(examples[name].problem)
    assert after == before


def test_a_domain_that_does_not_say_what_its_actions_change_is_no_problem():
    with pytest.raises(CasperError, match="the domain kitchen does not say what its actions change: state fluent/2"):
        to_problem(Domain.load("kitchen"))


def test_what_a_problem_cannot_say_is_told(tmp_path, examples):
    domain = basic_with(tmp_path, examples, "ontology.pl", 'never("not twice") :- claim(a(_)), did(a(_), _).\n')
    with pytest.warns(LeftOut, match="never/1 has no place in a problem of planning, and is left out"):
        to_problem(domain)


def test_a_clause_that_has_no_place_in_an_action_is_refused_with_its_place(tmp_path, examples):
    domain = basic_with(tmp_path, examples, "ontology.pl", "sunny.\na(Agent) :- actor(Agent), sunny.\n")
    with pytest.raises(CasperError, match=r"ontology.pl:\d+:1: sunny is about no type and no fluent of the problem"):
        to_problem(domain)


def test_what_is_left_out_of_a_domain_is_a_warning(examples):
    with pytest.warns(LeftOut, match="the action move is left out: it takes time"):
        from_problem(examples["logistic"].problem)


def test_plans_without_a_signature_are_told(tmp_path, examples):
    domain = basic_with(tmp_path, examples, "plans.pl", "goal(twice).\ntwice --> a, a.\n")
    with pytest.warns(LeftOut, match=r"plans.pl:\d+:1: twice has no compound_task"):
        to_problem(domain)


def test_types_in_a_circle_are_refused(tmp_path):
    (tmp_path / "ontology.pl").write_text("problem(x). type(a). type(b). subtype(a, b). subtype(b, a).\n")
    with pytest.raises(CasperError, match="the types run in a circle: a < b < a"):
        to_problem(Domain.load(tmp_path))
