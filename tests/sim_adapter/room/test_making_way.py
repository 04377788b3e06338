"""Who has nothing to do goes where one who is held up has a way."""

from casper.kb.base import KnowledgeBase
from casper.sim_adapter.room.facts import scene_from
from casper.sim_adapter.room.geometry import Disc, floor_of
from casper.sim_adapter.room.making_way import spot_out_of_the_way
from casper.sim_adapter.room.navigation import Navigator

CORRIDOR = """
room_size(6, 0.95). furniture(bench, counter, 2.7, 0, 0.6, 0.9). position(cup, bench). shape(cup, cylinder).
"""
FLOOR = floor_of(scene_from(KnowledgeBase.from_text(CORRIDOR).rows, ("ann",), "robbie"))
HERE, ROBOT, GOAL = (0.0, 0.0), (-2.0, 0.0), (1.0, 0.0)


def test_in_a_corridor_somebody_goes_beyond_where_the_robot_wants_to_be():
    robot = Navigator(FLOOR, 0.28)

    def through(spot):
        return robot.path(ROBOT, GOAL, [Disc(*spot, 0.55)]) is not None

    assert not through(HERE)
    spot = spot_out_of_the_way(Navigator(FLOOR, 0.17), HERE, [Disc(*ROBOT, 0.55)], through)
    assert spot is not None and spot[0] > GOAL[0] + 0.4 and through(spot)


def test_where_there_is_no_such_spot_nobody_moves():
    assert spot_out_of_the_way(Navigator(FLOOR, 0.17), HERE, [], lambda spot: False) is None
