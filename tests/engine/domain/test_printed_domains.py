"""A domain prints who and what is in it; a mind what it makes of what it saw."""

import pytest
from readings import KITCHEN, domain

from casper import Mind, WorldState
from casper.engine.events import Event
from casper.engine.movements.tree import Evaluation
from casper.engine.perception.world import AgentState, ObjectState


def test_a_domain_prints_agents_goals_and_actions():
    assert str(KITCHEN).splitlines()[:3] == [
        "kitchen: tiago watches human, and helps",
        "3 goals: breakfast, drink, lunch",
        "5 actions: pick_and_place/2, eat/2, wash/2, sip/2, cook/2",
    ]
    assert str(KITCHEN).splitlines()[3] == f"{len(KITCHEN.kb)} clauses of {KITCHEN.folder}"


def test_the_repr_of_a_domain_is_one_line_with_its_size():
    assert repr(KITCHEN) == f"<Domain kitchen: 3 goals, {len(KITCHEN.kb)} clauses>"


def test_a_domain_that_verifies_nothing_says_so_and_names_its_goals_as_they_are(tmp_path):
    told = str(domain(tmp_path, "goal(tea('a:x:b')). goal(tea('[bold]')).\ntea(C) --> fill(C).\n")).splitlines()
    assert told[0].endswith(": robot watches human")
    assert told[1] == "2 goals: tea('a:x:b'), tea('[bold]')"
    assert told[3].endswith("; it has no ontology.pl, and verifies nothing")


def test_of_many_goals_the_first_are_named(tmp_path):
    told = str(domain(tmp_path, "".join(f"g{number} --> a.\n" for number in range(50))))
    assert "50 goals: g0, g1, " in told and ", g19, and 30 more\n" in told


def test_a_mind_prints_its_reading_its_belief_and_the_robots_part():
    mind = Mind(KITCHEN)
    mind.reading.observe("pick_and_place(meal, hobs)")
    assert [event.type for event in mind.supervisor.update(15.0)] == ["prediction", "plan"]
    told = str(mind).splitlines()
    assert told[0] == "kitchen: tiago watches human"
    assert told[1].startswith("pick_and_place(meal, hobs) ──")
    assert told[-3:] == [
        "  15.0  ★ the goal is lunch (1 action seen, 0 missed)",
        "tiago waits for cook(meal, hobs), pick_and_place(meal, plate), eat(meal, plate)",
        "and will then pick_and_place(plate, sink), then wash(plate, sink)",
    ]
    assert repr(mind) == "<Mind that watches human in kitchen: <Reading of 1 observation: lunch 1.00>>"


def test_a_mind_that_has_seen_nothing_yet_prints_that():
    told = str(Mind(KITCHEN, helps=False)).splitlines()
    assert told[1].startswith("nothing observed")
    assert told[-1] == "outcome: undecided"


def test_a_world_state_prints_who_and_what_is_where():
    world = WorldState(9.5, {"ann": AgentState(0, 1.234, 0.5, "a:x:b")}, {"[bold]": ObjectState(1, 2), "cup": ObjectState(1, 2, 0.7)})
    assert str(world).splitlines() == [
        "at 9.5 s",
        "  ann     (0.00, 1.23), heading 0.50, holds a:x:b",
        "  [bold]  (1.00, 2.00)",
        "  cup     (1.00, 2.00, 0.70)",
    ]
    assert repr(world) == "<WorldState at 9.5 s: ann, [bold], cup>"
    assert str(WorldState(0.0, {}, {})) == "at 0 s"


def test_an_evaluation_prints_its_accuracy_and_what_was_taken_for_what():
    table = {"walk": {"walk": 12, "still": 0}, "still": {"walk": 3, "still": 5}}
    evaluation = Evaluation(0.85, {1: 0.8, 2: 0.9}, table, ("walk", "still"))
    assert [line.rstrip() for line in str(evaluation).splitlines()] == [
        "leave-one-trial-out accuracy 0.850",
        " true \\ taken for  walk  still",
        " walk              12    ·",
        " still             3     5",
    ]
    assert repr(evaluation) == "<Evaluation: accuracy 0.850 in 2 trials>"


@pytest.mark.parametrize("thing", [KITCHEN, Mind(KITCHEN), Mind(KITCHEN).reading, Event("plan", 1.0, {"agent": "a\nb"})])
def test_no_repr_has_a_second_line(thing):
    assert len(repr(thing).splitlines()) == 1
