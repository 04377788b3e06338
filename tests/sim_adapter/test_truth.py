"""What is true of a trial is said by the script and the physics, whatever a mind believes."""

from types import SimpleNamespace

import pytest

pytest.importorskip("mujoco")

from casper import Domain
from casper.engine.events import Event
from casper.kb.terms.terms import Compound
from casper.sim_adapter.partners.conduct import Conduct, Surroundings, plain
from casper.sim_adapter.room.facts import scene_of
from casper.sim_adapter.script import step_for
from casper.sim_adapter.truth import Truth

KITCHEN = Domain.load("kitchen")
SCENE = scene_of(KITCHEN)
WASH, CARRY = Compound(("wash", "plate", "sink")), Compound(("pick_and_place", "plate", "sink"))
LEFT = ["pick_and_place(plate, sink)", "wash(plate, sink)"]


class World:
    """A trial without a simulator: whoever tests says what is done and told."""

    def __init__(self, goals, changes_mind=False):
        conduct: Conduct = plain(Surroundings(KITCHEN, SCENE), goals, changes_mind)
        pursuits = [
            SimpleNamespace(stretch=s, given_up=s.stops is not None, script=s.script[: s.stops]) for s in conduct.stretches
        ]
        self.partner = SimpleNamespace(pursuits=pursuits, at=0, did=[], busy_with=[])
        self.robot = SimpleNamespace(holding=None, current=None, done=[], failed=[])
        self.helper = SimpleNamespace(tasks=[])
        self.truth = Truth(SimpleNamespace(robot=self.robot, time=1.0), {"human": self.partner}, self.helper)

    def did(self, *numbers):
        """The partner does those steps of the present stretch."""
        script = self.partner.pursuits[self.partner.at].script
        self.partner.did += [script[number] for number in numbers]
        self.partner.busy_with = self.partner.did[-1:]
        self.tell()

    def tell(self, *events, is_end=False):
        self.truth.see([Event(kind, 1.0, {"agent": "human", **data}) for kind, data in events], is_end)

    def announce(self, goal, actions=LEFT):
        self.tell(("prediction", {"goal": goal}), ("plan", {"goal": goal, "actions": actions}))

    def grasps(self, action, goal):
        """The robot takes hold of something for an action."""
        made = SimpleNamespace(commitment=SimpleNamespace(goal=goal))
        task = SimpleNamespace(action=action, step=step_for(KITCHEN, action), supervisor=made, mind=SimpleNamespace(partner="human"))
        self.helper.tasks, self.robot.current, self.robot.holding = [task], task.step, action[1]
        self.tell()

    def finish(self, goal, outcome="finished", is_end=False):
        self.tell(("episode", {"goal": goal, "outcome": outcome}), is_end=is_end)

    @property
    def summary(self):
        return self.truth.summary("human")


def test_goals_are_right_when_those_and_no_others_were_read():
    world = World(["breakfast", "drink"])
    world.announce("breakfast")
    world.finish("breakfast")
    assert not world.summary["right"]
    world.announce("drink")
    world.finish("drink", "unclear", is_end=True)
    assert world.summary["right"]


def test_a_goal_read_twice_is_not_right():
    world = World(["breakfast"])
    world.announce("breakfast")
    world.finish("breakfast")
    world.finish("breakfast")
    assert world.summary["believed"] == ["breakfast", "breakfast"] and not world.summary["right"]


def test_what_was_given_up_must_not_be_read_at_the_end_and_what_became_unclear_on_the_way_is_not():
    world = World(["lunch", "drink"], changes_mind=True)
    world.announce("lunch")
    world.finish("lunch", "abandoned")
    world.announce("drink")
    world.finish("drink", "unclear")
    assert world.summary["goals"] == ["drink"] and world.summary["believed"] == []


def test_help_with_what_is_left_of_a_goal_is_no_wrong_intervention():
    world = World(["breakfast"])
    world.did(0, 1)
    world.announce("breakfast")
    world.grasps(CARRY, "breakfast")
    assert world.summary["wrong_interventions"] == []


def test_help_with_a_goal_that_nobody_has_is_one():
    world = World(["drink"])
    world.did(0)
    world.announce("breakfast")
    world.grasps(CARRY, "breakfast")
    assert world.summary["wrong_interventions"] == ["pick_and_place(plate, sink) for breakfast at 1.0 s"]


def test_to_do_once_more_what_was_done_before_it_was_announced_is_one():
    world = World(["breakfast"])
    world.did(0, 1, 2, 3)
    world.announce("breakfast")
    world.grasps(WASH, "breakfast")
    assert world.summary["wrong_interventions"] == ["wash(plate, sink) for breakfast at 1.0 s"]


@pytest.mark.parametrize(("withdrawn", "wrong"), [(False, 0), (True, 1)])
def test_what_was_announced_for_a_goal_that_is_given_up_since_may_be_done_unless_it_was_withdrawn(withdrawn, wrong):
    world = World(["breakfast", "drink"], changes_mind=True)
    world.did(0)
    world.announce("breakfast")
    world.partner.at = 1
    world.did(0)
    if withdrawn:
        world.tell(("withdrawn", {"goal": "breakfast", "because": "a drink"}))
    world.grasps(CARRY, "breakfast")
    assert len(world.summary["wrong_interventions"]) == wrong


def test_to_take_up_what_nobody_asked_for_is_wrong():
    world = World(["breakfast"])
    world.robot.holding, world.robot.current = "plate", step_for(KITCHEN, CARRY)
    world.tell()
    assert len(world.summary["wrong_interventions"]) == 1


def test_holding_on_is_counted_once():
    world = World(["drink"])
    world.announce("breakfast")
    for _ in range(3):
        world.grasps(CARRY, "breakfast")
    assert len(world.summary["wrong_interventions"]) == 1


# --- what became of the help -------------------------------------------------------------------------------------------


def fates(world):
    return [(row["outcome"], row["true"]) for row in world.summary["help"]]


def test_help_that_was_announced_and_never_came_has_not_ended():
    world = World(["breakfast"])
    world.announce("breakfast")
    assert fates(world) == [("announced", True)] * 2 and not world.summary["help_ended"]


def test_help_ends_when_one_of_the_two_has_done_it():
    world = World(["breakfast"])
    world.announce("breakfast")
    world.did(0, 1, 2)
    world.tell(("robot", {"action": LEFT[1], "status": "asked"}), ("robot", {"action": LEFT[1], "status": "done"}))
    assert fates(world) == [("taken over", True), ("done", True)] and world.summary["help_ended"]


def test_a_failure_needs_a_reason_and_what_comes_after_it_has_that_reason():
    world = World(["breakfast"])
    world.announce("breakfast")
    world.tell(*(("robot", {"action": action, "status": "asked"}) for action in LEFT))
    world.tell(("robot", {"action": LEFT[0], "status": "failed", "reason": "there is no free way"}))
    assert world.summary["help_ended"]
    assert "there is no free way" in world.summary["help"][1]["because"]
    world.tell(("plan", {"goal": "breakfast", "actions": LEFT[:1]}), ("robot", {"action": LEFT[0], "status": "failed"}))
    assert not world.summary["help_ended"]


def test_a_withdrawal_is_true_when_the_goal_is_given_up_or_they_are_busy_with_another_one():
    world = World(["breakfast", "drink"], changes_mind=True)
    world.announce("breakfast")
    world.partner.at = 1
    world.did(0)
    world.tell(("withdrawn", {"goal": "breakfast", "because": "a drink"}))
    assert fates(world) == [("withdrawn", True)] * 2


def test_a_withdrawal_is_not_true_while_they_are_busy_with_that_goal():
    world = World(["breakfast"])
    world.announce("breakfast")
    world.did(0)
    world.tell(("withdrawn", {"goal": "breakfast", "because": "a drink"}))
    assert fates(world) == [("withdrawn", False)] * 2 and not world.summary["help_ended"]


def test_steps_that_are_not_planned_any_more_are_accounted_for_only_when_nobody_needs_them():
    world = World(["breakfast"])
    world.announce("breakfast")
    world.tell(("plan", {"goal": "breakfast", "actions": LEFT[:1]}))
    assert fates(world)[1] == ("dropped", False)
