"""Each behaviour in the simulator: what a body really does that was told to behave so. Nobody watches, nobody helps."""

import math
from dataclasses import replace
from functools import cache
from itertools import pairwise

import pytest

pytest.importorskip("mujoco")

from simulated_kitchen import kitchen_scene

from casper import Domain
from casper.sim_adapter.partners.behaviours.table import behaving
from casper.sim_adapter.partners.conduct import Surroundings, plain
from casper.sim_adapter.partners.partner import Partner
from casper.sim_adapter.simulation import Simulation
from casper.sim_adapter.steps import Step
from casper.sim_adapter.trial import Trial, TrialSettings

KITCHEN = Domain.load("kitchen")


@cache
def lived(name, goals, seed=0, longest=200.0):
    """Somebody who behaves so, alone in the kitchen to the end: the simulation, the partner, what was where each second."""
    surroundings = Surroundings(KITCHEN, kitchen_scene(), seed)
    conduct, _ = behaving(plain(surroundings, goals.split(",")), name, surroundings)
    simulation = Simulation(kitchen_scene(), seed=seed)
    partner = Partner(KITCHEN, simulation, [], conduct=conduct, helped=False)
    partner.begin()
    seen = []
    while not partner.idle and simulation.time < longest:
        simulation.advance(1.0)
        partner.notice(simulation.time)
        seen.append(simulation.truth())
        if partner.waits:
            partner.begin()
    return simulation, partner, seen


def did(partner):
    """The steps that were done, in order."""
    return [str(scripted.step) for scripted in partner.did]


def test_who_changes_their_mind_leaves_the_first_goal_as_it_is_and_reaches_the_second():
    simulation, partner, _ = lived("fickle", "lunch,drink")
    stops = partner.pursuits[0].stretch.stops
    assert did(partner)[: stops + 1] == [*map(str, (s.step for s in partner.pursuits[0].script)), "pick_and_place(bottle, glass)"]
    assert simulation.rests_in("glass", "sink") and not simulation.rests_in("plate", "sink")


def test_who_pauses_stands_still_that_long_and_goes_on():
    simulation, partner, seen = lived("pausing", "drink")
    pauses = [scripted.step.seconds for scripted in partner.did if scripted.step.skill == "still"]
    places = [(state.agents["human"].x, state.agents["human"].y) for state in seen]
    rests = sum(math.dist(a, b) < 1e-6 for a, b in pairwise(places))
    assert rests >= sum(pauses) - len(pauses)
    assert simulation.rests_in("glass", "sink")


def test_who_wanders_takes_up_what_nobody_needs_and_reaches_the_goal_all_the_same():
    simulation, partner, seen = lived("wandering", "drink", 1)
    handled = {s.step.target for s in partner.did if s.step.skill in ("handle", "set_down")}
    assert handled and handled <= {state.agents["human"].holding for state in seen}
    assert simulation.rests_in("glass", "sink")


def test_what_is_taken_up_and_put_back_lies_where_it_was():
    simulation = Simulation(kitchen_scene(), seed=0)
    before = simulation.truth().objects["meal"]
    simulation.human.do([Step("handle", "meal")])
    while not simulation.human.idle:
        simulation.advance(0.5)
    after = simulation.truth().objects["meal"]
    assert math.dist((before.x, before.y, before.z), (after.x, after.y, after.z)) < 0.02


def test_who_forgets_to_cook_brings_the_meal_back_to_the_hobs():
    simulation, partner, _ = lived("forgetful", "lunch", 2)
    assert did(partner)[:5] == [
        "pick_and_place(meal, hobs)",
        "pick_and_place(meal, plate)",
        "pick_and_place(meal, hobs)",
        "use(meal, hobs)",
        "pick_and_place(meal, plate)",
    ]
    assert simulation.rests_in("plate", "sink")


def test_two_goals_at_once_are_both_reached():
    simulation, partner, _ = lived("juggling", "breakfast,drink")
    whose = [scripted.goal for scripted in partner.did]
    assert whose.index("drink") < len(whose) - 1 - whose[::-1].index("breakfast")
    assert simulation.rests_in("plate", "sink") and simulation.rests_in("glass", "sink")


def test_who_stands_in_the_way_stands_at_a_place_of_what_is_left():
    _, partner, seen = lived("blocking", "drink", 3)
    walk, still = (scripted.step for scripted in partner.did if scripted.action is None)
    at = [state.objects[walk.target] for state in seen]
    near = sum(math.dist((s.agents["human"].x, s.agents["human"].y), (o.x, o.y)) < 0.65 for s, o in zip(seen, at))
    assert near >= still.seconds - 1


def test_what_is_put_elsewhere_lies_there_before_the_goal_goes_on():
    simulation, partner, seen = lived("misplacing", "breakfast", 1)
    step = next(s.step for s in partner.did if s.step.skill == "set_down")
    spots = [(state.objects[step.target].x, state.objects[step.target].y) for state in seen if step.target in state.objects]
    assert any(math.dist(spot, step.spot[:2]) < 0.03 for spot in spots)
    assert simulation.rests_in("plate", "sink")


def test_who_is_eager_keeps_the_first_steps_that_are_announced_and_leaves_the_others():
    surroundings = Surroundings(KITCHEN, kitchen_scene(), 0)
    conduct = replace(plain(surroundings, ["breakfast"]), keeps=1)
    partner = Partner(KITCHEN, Simulation(kitchen_scene(), seed=0), [], conduct=conduct)
    partner.begin()
    announced = [scripted.action for scripted in partner.now.script[2:]]
    partner.heed(announced)
    assert [str(step) for step in partner.human.queue.waiting][:3] == ["pick_and_place(biscuits, plate)", "use(biscuits, plate)", "pick_and_place(plate, sink)"]
    assert [scripted.action for scripted in partner.now.left] == announced[1:]


def test_who_does_everything_alone_leaves_nothing_to_the_robot():
    surroundings = Surroundings(KITCHEN, kitchen_scene(), 0)
    conduct, _ = behaving(plain(surroundings, ["breakfast"]), "alone", surroundings)
    partner = Partner(KITCHEN, Simulation(kitchen_scene(), seed=0), [], conduct=conduct)
    partner.begin()
    partner.heed([scripted.action for scripted in partner.now.script[2:]])
    assert not partner.now.left and len(partner.human.queue.waiting) == 4


def test_a_visitor_is_a_third_body_that_moves_a_thing_of_the_goal():
    trial = Trial(KITCHEN, TrialSettings("drink", 4, partner="visited"))
    visitor = trial.simulation.people["visitor"]
    step = next(step for step in visitor.queue.waiting if step.skill == "set_down")
    while step not in visitor.done and trial.simulation.time < 90.0:
        trial.simulation.advance(1.0)
    at = trial.simulation.truth().objects[step.target]
    assert math.dist((at.x, at.y), step.spot[:2]) < 0.03


def test_who_waits_for_an_idle_robot_in_vain_does_it_themselves():
    simulation = Simulation(kitchen_scene(), seed=0)
    partner = Partner(KITCHEN, simulation, ["breakfast"])
    partner.begin()
    partner.heed([scripted.action for scripted in partner.now.script])  # all of it, and nothing comes
    while not partner.idle and simulation.time < 150.0:
        simulation.advance(1.0)
        partner.notice(simulation.time)
        partner.wait(simulation.time)
    assert simulation.rests_in("plate", "sink") and not partner.now.left
