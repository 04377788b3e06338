"""What rests is put to sleep by the physics; nobody must be able to tell."""

import pytest

pytest.importorskip("mujoco")

from hypothesis import given, settings
from hypothesis import strategies as st
from simulated_kitchen import kitchen_scene

from casper.sim_adapter.physics.physics import Physics

RESTS = 150  # control steps after which what was let go lies still
MOVABLES = kitchen_scene().movables


def rested():
    """A kitchen in which everything has come to rest."""
    physics = Physics(kitchen_scene())
    run(physics, RESTS)
    return physics


def run(physics, steps):
    for _ in range(steps):
        physics.step()


def hand_at(physics, spot, at_once=False):
    physics.aim_mocap("human:hand", spot, 0.0, at_once=at_once)


def lifted(physics, thing, height):
    """Raise an object in the human's hand, and hold it still until the physics may have put it to sleep."""
    x, y, z = physics.position(thing)
    hand_at(physics, (x, y, z), at_once=True)
    physics.refresh()
    physics.grasp("human", thing)
    for step in range(1, 51):
        hand_at(physics, (x, y, z + height * step / 50))
        physics.step()
    run(physics, 60)


def test_nothing_that_rests_is_worked_out():
    physics = rested()
    awake = {physics.model.body(int(i)).name for i in physics.data.body_awake_ind[: physics.data.nbody_awake]}
    assert physics.data.ncon == 0 and not awake & set(MOVABLES)


@settings(max_examples=10, deadline=None)
@given(st.sampled_from(MOVABLES), st.integers(0, 12))
def test_what_is_let_go_in_the_air_falls_however_long_it_was_held_still(thing, more):
    physics = rested()
    before = physics.position(thing)[2]
    lifted(physics, thing, 0.2)
    run(physics, more)
    assert physics.position(thing)[2] > before + 0.15
    physics.release("human")
    run(physics, 40)
    assert physics.position(thing)[2] < before + 0.1


@pytest.mark.parametrize("thing", MOVABLES)
def test_what_is_held_follows_the_hand_after_it_was_held_still(thing):
    physics = rested()
    lifted(physics, thing, 0.2)
    x, y, z = physics.position(thing)
    hx, hy, hz = physics.position("human:hand")
    for step in range(1, 26):
        hand_at(physics, (hx, hy, hz + 0.1 * step / 25))
        physics.step()
    run(physics, 10)
    assert physics.position(thing) == pytest.approx((x, y, z + 0.1), abs=0.01)


def test_what_stood_in_something_falls_when_that_is_taken_away():
    physics = rested()
    x, y, z = physics.position("plate")
    physics._move("meal", (x, y, z + 0.05, 1.0, 0.0, 0.0, 0.0))
    run(physics, RESTS)
    before = physics.position("meal")[2]
    physics.remove("plate")
    run(physics, RESTS)
    assert physics.position("meal")[2] < before - 0.002


def test_what_is_put_back_lies_where_it_was():
    physics = rested()
    before = physics.position("biscuits")
    physics.remove("biscuits")
    run(physics, RESTS)
    physics.put_back("biscuits")
    run(physics, RESTS)
    assert physics.position("biscuits") == pytest.approx(before, abs=1e-3)
