"""Where actions seem to have happened, and what the reading expects, where a sensor is poor."""

import math

from hypothesis import given
from hypothesis import strategies as st

from casper.engine.actions.expecting import planned, weights
from casper.engine.actions.fsm import Fsm
from casper.engine.actions.happening import Happening
from casper.engine.actions.hmm import HmmRecogniser
from casper.engine.actions.prediction import ActionSettings
from casper.engine.movements.movements import Movement

HOBS, PLATE, NOWHERE = {("meal", "hobs"): 1.0}, {("meal", "plate"): 1.0}, {("meal", None): 1.0}
SKILLS = {"cook": "use", "eat": "use"}
spots = st.sampled_from([HOBS, PLATE, NOWHERE, {("meal", "hobs"): 0.5, ("meal", "plate"): 0.5}])
steps = st.lists(st.tuples(st.floats(0.0, 1.0), spots, st.booleans()), min_size=1, max_size=30)


def told(steps):
    happening = Happening()
    for score, here, walks in steps:
        happening.note({"use": score}, here, walks)
    return happening.of("use")


def test_an_action_that_is_made_out_on_the_way_happened_where_the_agent_stood():
    found = told([(0.3, HOBS, False), (0.5, HOBS, False), (0.9, PLATE, True), (0.9, PLATE, True)])
    assert found == {("meal", "hobs"): 1.0}


def test_what_lost_its_chance_elsewhere_counts_no_more():
    found = told([(0.5, HOBS, False), (0.5, HOBS, True), (0.0, PLATE, True), (0.8, PLATE, False)])
    assert found == {("meal", "plate"): 1.0}


def test_a_place_that_was_known_is_not_forgotten_where_nothing_is_near_any_more():
    assert told([(0.4, HOBS, False), (0.6, NOWHERE, False)]) == {("meal", "hobs"): 1.0}


@given(steps)
def test_shares_of_where_an_action_happened_add_up(steps):
    found = told(steps)
    assert not found or math.isclose(sum(found.values()), 1.0)
    assert all(share >= 0.0 for share in found.values())


def test_a_step_that_is_expected_makes_its_action_likelier():
    found = weights({"eat(meal, plate)": 1.0}, SKILLS, ["pick_and_place", "use"])
    assert found["use"] > 1.0 > found["pick_and_place"] > 0.0


def test_where_nothing_is_expected_all_actions_are_alike():
    assert weights({None: 1.0}, SKILLS, ["use"]) == weights({}, SKILLS, ["use"]) == {}


@given(st.dictionaries(st.sampled_from(["eat(a, b)", "cook(a, b)", "pick_and_place(a, b)", None]), st.floats(0.01, 1.0)))
def test_weights_are_one_on_average(coming):
    found = weights(coming, SKILLS, ["pick_and_place", "use", "relocate"])
    assert not found or math.isclose(sum(found.values()), 3.0)


def test_an_action_is_planned_when_a_plan_has_it_at_some_place():
    assert planned(["use", "relocate", "pick_and_place"], SKILLS, {"eat", "pick_and_place"}) == {"use", "pick_and_place"}


CARRY = Fsm("carry", {"move": {"put": 1.0}, "put": {"rest": 1.0}, "rest": {"move": 1.0}}, ("move", "put"))


def scores_after(movements, kept):
    """The chance of ``carry`` after shares of a movement each, half a second a step."""
    even = {true: {seen: 0.8 if seen == true else 0.1 for seen in CARRY.rows} for true in CARRY.rows}
    recogniser = HmmRecogniser(ActionSettings(certainty=1.0, lasts=2.0), (CARRY,), even, planned=kept)
    for step, name in enumerate(movements):
        shares = {other: 0.9 if other == name else 0.05 for other in CARRY.rows}
        recogniser.update(Movement(step * 0.5, name, shares=shares))
    return recogniser.scores["carry"]


def test_what_was_done_stays_done_where_no_step_is_sure():
    movements = ["move"] * 6 + ["put"] * 3 + ["rest"] * 6
    assert scores_after(movements, frozenset({"carry"})) > 0.6 > scores_after(movements, frozenset())


STIR = Fsm("stir", {"take": {"put": 1.0}, "put": {"take": 1.0}, "rest": {"take": 1.0}}, ("take", "put") * 2, loop=True)
REST = Fsm("relax", {"rest": {"take": 1.0}, "take": {"rest": 1.0}, "put": {"rest": 1.0}}, ("rest", "take"))


def steps_until_stirred(weights, most=400):
    """Half seconds of a hand at work, taking or putting being all alike, until ``stir`` has happened."""
    even = {true: {seen: 0.8 if seen == true else 0.1 for seen in STIR.rows} for true in STIR.rows}
    recogniser = HmmRecogniser(ActionSettings(lasts=4.0), (STIR, REST), even, planned=frozenset({"stir"}))
    recogniser.expect(weights)
    for step in range(most):
        shares = {"take": 0.48, "put": 0.48, "rest": 0.04}
        if recogniser.update(Movement(step * 0.5, "take", shares=shares)) is not None:
            return step
    return most


def test_what_is_expected_and_goes_on_for_long_is_known_to_have_happened_sooner():
    assert steps_until_stirred({"stir": 1.8, "relax": 0.2}) < steps_until_stirred({}) <= steps_until_stirred({"stir": 0.2, "relax": 1.8})
