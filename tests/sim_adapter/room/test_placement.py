import math

from hypothesis import given
from hypothesis import strategies as st
from simulated_kitchen import kitchen_scene

from casper.sim_adapter.physics.objects import start_height
from casper.sim_adapter.room.placement import is_placed, place_spot

SCENE = kitchen_scene()
START = {name: (t.x, t.y, start_height(SCENE, t)) for name, t in SCENE.things.items()}
PAIRS = [(t, d) for t in SCENE.movables for d in SCENE.destinations if t != d]
agents = st.tuples(st.floats(-1.9, 1.2), st.floats(-3.0, 0.7))


@given(st.sampled_from(PAIRS), agents)
def test_what_is_put_at_its_spot_counts_as_placed(pair, agent):
    target, destination = pair
    spot = place_spot(SCENE, START, target, destination, agent)
    assert is_placed(SCENE, {**START, target: spot}, target, destination)


def test_nothing_is_at_its_destination_at_the_start():
    assert not any(is_placed(SCENE, START, target, destination) for target, destination in PAIRS)


@given(agents)
def test_the_bottle_stands_beside_the_glass_without_touching_it(agent):
    x, y, _ = place_spot(SCENE, START, "bottle", "glass", agent)
    gap = math.dist((x, y), START["glass"][:2]) - SCENE.thing("bottle").radius - SCENE.thing("glass").radius
    assert 0.01 < gap < 0.06
    worktop = next(piece for piece in SCENE.furniture if piece.name == "worktop_4")
    assert worktop.holds(x, y, SCENE.thing("bottle").radius)


def test_the_meal_is_put_in_the_middle_of_the_hobs():
    x, y, z = place_spot(SCENE, START, "meal", "hobs", (1.2, 0.7))
    assert (x, y) == START["hobs"][:2]
    assert math.isclose(z, 0.86 + 0.01 + 0.04)


def test_the_glass_goes_beside_a_plate_that_lies_in_the_sink():
    plate = place_spot(SCENE, START, "plate", "sink", (-1.0, 0.7))
    x, y, _ = place_spot(SCENE, {**START, "plate": plate}, "glass", "sink", (-1.0, 0.7))
    assert math.dist((x, y), plate[:2]) > SCENE.thing("plate").radius + SCENE.thing("glass").radius
    assert is_placed(SCENE, {**START, "glass": (x, y, 0.83)}, "glass", "sink")


def test_a_plate_held_above_the_sink_is_not_in_it():
    x, y, z = place_spot(SCENE, START, "plate", "sink", (-1.0, 0.7))
    assert not is_placed(SCENE, {**START, "plate": (x, y, z + 0.12)}, "plate", "sink")


def test_an_object_that_was_removed_is_placed_nowhere():
    where = {name: spot for name, spot in START.items() if name != "meal"}
    assert not is_placed(SCENE, where, "meal", "plate")
