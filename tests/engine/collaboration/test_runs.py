"""Runs over partial orders whose leaves wait for different people's steps."""

import pytest
from readings import reading

from casper.engine.collaboration.collaboration import CollaborativePlan, longest_run
from casper.engine.collaboration.supervisor import Supervisor
from casper.engine.explanation.situation import Situation
from casper.kb.terms.terms import Compound
from casper.plans.library import PlanLibrary


@pytest.mark.parametrize(
    ("able", "others", "before", "run"),
    [
        ([2, 3], [0, 1], [0, 0, 0b01, 0b10], (2, 3)),  # each waits for another step: both, once both are done
        ([1, 3], [0, 2], [0, 0b1, 0b11, 0b111], (3,)),  # a step of the others comes between them
        ([0, 1], [2], [0, 0, 0b11], (0, 1)),
        ([0, 2], [1], [0, 0b1, 0], (0, 2)),
        ([0, 1, 2], [3], [0, 0b1000, 0, 0], (0, 1, 2)),
        ([], [0], [0], ()),
    ],
)
def test_the_longest_run_waits_for_all_that_it_needs(able, others, before, run):
    assert longest_run(able, others, before) == run


def test_a_leaf_of_the_agents_own_is_in_the_run_however_short_that_is():
    before = [0, 0b1, 0b11, 0b111, 0b1111]
    assert longest_run([1, 3, 4], [0, 2], before) == (3, 4)
    assert longest_run([1, 3, 4], [0, 2], before, own=1) == (1,)
    assert longest_run([1, 3, 4], [0, 2], before, own=4) == (3, 4)


def test_what_was_done_since_is_left_out():
    (plan,) = PlanLibrary.from_text("goal(g). g --> a, b, c, d.").ways
    a, b, c, d = plan.leaves
    part = CollaborativePlan("rob", "g", (a, b), (c, d), (2, 3), (0, 1))
    assert part.after(Situation.of(plan, 0, ())) == part
    assert part.after(Situation.of(plan, 0b0101, ())) == CollaborativePlan("rob", "g", (b,), (d,), (3,), (1,))
    assert part.after(Situation.of(plan, 0b1111, ())) == CollaborativePlan("rob", "g", (), (), ())


def test_a_part_is_json():
    part = CollaborativePlan("rob", "g", (Compound(("a",)),), (Compound(("wash", "cup")),), (1,), (0,))
    assert part.to_json() == {"agent": "rob", "goal": "g", "waiting": ["a"], "actions": ["wash(cup)"]}


def test_before_a_goal_is_predicted_every_figure_is_zero():
    supervisor = Supervisor(reading(), "tiago")
    figures = {"observed": 0, "missed": 0, "waiting": 0, "planned": 0}
    assert supervisor.summary() == {"predicted": None, "prediction_time": None, **figures}
    assert list(supervisor.update(1.0)) == [] and not supervisor.ready
