import math
from functools import cache

import numpy as np
import pytest

pytest.importorskip("mujoco")

from simulated_kitchen import SCRIPTS, kitchen_scene, put, run_until_idle, use

from casper.kb.errors import DomainError
from casper.sim_adapter.simulation import Simulation
from casper.sim_adapter.steps import Step
from casper.sim_adapter.training.training import training_script


@cache
def done_alone(goal):
    """The whole script of a goal, with what was seen every half second."""
    simulation = Simulation(kitchen_scene(), seed=5)
    simulation.human.do(SCRIPTS[goal])
    moments = []

    def look(now):
        human = now.human
        moments.append((now.time, human.movement, human.current, now.truth()))

    return run_until_idle(simulation, each=look), moments


@pytest.mark.parametrize("goal", list(SCRIPTS))
def test_the_human_completes_the_whole_script(goal):
    simulation, _ = done_alone(goal)
    assert simulation.human.done == SCRIPTS[goal] and simulation.human.failed == []


@pytest.mark.parametrize("goal", list(SCRIPTS))
def test_the_vessel_rests_in_the_sink_at_the_end(goal):
    simulation, _ = done_alone(goal)
    assert simulation.rests_in(SCRIPTS[goal][-1].target, "sink")


@pytest.mark.parametrize("goal", list(SCRIPTS))
def test_holding_things_gives_no_warning_of_the_solver(goal):
    simulation, _ = done_alone(goal)
    assert simulation.physics.warnings == 0


@pytest.mark.parametrize("goal", list(SCRIPTS))
def test_nothing_is_ever_dropped_to_the_floor(goal):
    _, moments = done_alone(goal)
    assert all(state.z > 0.5 for *_, world in moments for state in world.objects.values())


@pytest.mark.parametrize("goal", list(SCRIPTS))
def test_every_coordinate_is_a_finite_number(goal):
    _, moments = done_alone(goal)
    for *_, world in moments:
        for state in world.objects.values():
            assert all(map(math.isfinite, (state.x, state.y, state.z)))
        for state in world.agents.values():
            assert all(map(math.isfinite, (state.x, state.y, state.heading)))


@pytest.mark.parametrize("goal", list(SCRIPTS))
def test_the_human_handles_things_from_within_the_touch_band(goal):
    _, moments = done_alone(goal)
    for _, movement, step, world in moments:
        if step is not None and movement in ("pick", "place"):
            name = step.target if movement == "pick" else step.destination
            human, thing = world.agents["human"], world.objects[name]
            assert math.dist((human.x, human.y), (thing.x, thing.y)) <= 0.6


@pytest.mark.parametrize("goal", list(SCRIPTS))
def test_the_human_never_walks_into_furniture(goal):
    simulation, moments = done_alone(goal)
    ways = simulation.human.walk.navigator
    for *_, world in moments:
        human = world.agents["human"]
        assert ways.floor.clearance((human.x, human.y)) > ways.radius - 0.02


def test_a_pick_and_place_goes_walk_pick_transport_place():
    simulation = Simulation(kitchen_scene(), seed=2)
    simulation.human.do([put("biscuits", "plate")])
    labels = []
    run_until_idle(simulation, each=lambda now: labels.append(now.human.movement))
    changes = [label for label, before in zip(labels, [None, *labels]) if label != before]
    assert changes[:4] == ["walk", "pick", "transport", "place"]


def test_a_use_is_three_pairs_of_pick_and_place_on_the_spot():
    _, moments = done_alone("lunch")
    cooking = [(movement, world) for _, movement, step, world in moments if step == use("meal", "hobs")]
    labels = [movement for movement, _ in cooking]
    changes = [label for label, before in zip(labels, [None, *labels]) if label != before and label != "still"]
    assert changes == ["pick", "place"] * 3
    places = {(round(w.agents["human"].x, 3), round(w.agents["human"].y, 3)) for _, w in cooking[4:]}
    assert len(places) == 1


def test_the_label_agrees_with_what_is_in_the_hand():
    _, moments = done_alone("lunch")
    for _, movement, _, world in moments:
        held = world.agents["human"].holding
        if movement in ("walk", "still"):
            assert held is None
        if movement == "transport":
            assert held is not None


def test_the_human_starts_anywhere_on_the_free_floor():
    places = {Simulation(kitchen_scene(), seed=seed).human.place for seed in range(4)}
    assert len(places) == 4


def test_a_start_inside_the_table_is_refused():
    with pytest.raises(DomainError, match="not on the free floor"):
        Simulation(kitchen_scene(), seed=0, start=(-0.64, -1.43))


def test_steps_not_yet_begun_can_be_left_to_somebody_else():
    simulation = Simulation(kitchen_scene(), seed=0)
    human = simulation.human
    human.do(SCRIPTS["breakfast"])
    simulation.advance(1.0)
    assert human.leave(SCRIPTS["breakfast"]) == SCRIPTS["breakfast"][1:]
    assert human.current == SCRIPTS["breakfast"][0]
    assert list(human.queue.waiting) == [Step("stand_aside")]


def test_one_who_stands_aside_is_out_of_everybodys_way():
    simulation = Simulation(kitchen_scene(), seed=0, start=(-0.66, -0.7))
    simulation.human.do([Step("stand_aside")])
    run_until_idle(simulation)
    where = simulation.physics.positions().values()
    assert all(math.dist(simulation.human.place, spot[:2]) > 0.9 for spot in where)


def test_stepping_back_leaves_the_touch_band():
    simulation = Simulation(kitchen_scene(), seed=0)
    simulation.human.do([Step("walk_to", "biscuits"), Step("step_back")])
    run_until_idle(simulation)
    assert math.dist(simulation.human.place, simulation.physics.position("biscuits")[:2]) > 0.7


@pytest.mark.parametrize(
    "step",
    [
        Step("juggle", "plate", "sink"),
        put("toaster", "sink"),
        put("sink", "plate"),
        put("plate", "biscuits"),
        use("plate", None),
    ],
)
def test_what_cannot_be_done_is_refused_with_a_sentence(step):
    with pytest.raises(DomainError):
        Simulation(kitchen_scene(), seed=0).human.do([step])


def test_taking_what_is_gone_fails_with_the_reason():
    simulation = Simulation(kitchen_scene(), seed=0)
    simulation.remove("meal")
    simulation.human.do([put("meal", "hobs")])
    run_until_idle(simulation)
    assert simulation.human.failed == [(put("meal", "hobs"), "meal is no longer there")]


def test_a_training_trial_is_still_fetch_still():
    for seed in range(20):
        script = training_script(kitchen_scene(), np.random.default_rng(seed))
        assert [step.skill for step in script] == ["still", "pick_and_place", "still"]
        assert 2.0 <= script[0].seconds <= 4.0
        assert script[1].target != script[1].destination


def test_a_training_trial_may_step_back_before_the_last_still():
    script = training_script(kitchen_scene(), np.random.default_rng(0), step_back=True)
    assert [step.skill for step in script] == ["still", "pick_and_place", "step_back", "still"]


@pytest.mark.parametrize("seed", [0, 4, 9])
def test_what_is_carried_away_from_the_fridge_does_not_knock_against_it(seed):
    simulation = Simulation(kitchen_scene(), seed=seed)
    simulation.human.do([put("meal", "hobs")])
    physics = simulation.physics
    knocks = 0
    while not simulation.human.idle:
        simulation.advance(0.02)
        if simulation.human.movement == "transport":
            knocks += "furniture:fridge" in touched_by(physics, "meal")
    assert knocks == 0


def touched_by(physics, name):
    """Names of the bodies an object touches."""
    owner, body = physics.model.geom_bodyid, physics.body_id(name)
    pairs = ({int(owner[contact.geom1]), int(owner[contact.geom2])} for contact in physics.data.contact)
    return {physics.model.body(other).name for pair in pairs if body in pair for other in pair - {body}}
