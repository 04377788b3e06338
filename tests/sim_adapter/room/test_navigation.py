import math
from itertools import pairwise

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from simulated_kitchen import kitchen_scene

from casper.sim_adapter.human.walk import RINGS as HUMAN_RINGS
from casper.sim_adapter.room.geometry import (
    Disc,
    floor_of,
    in_the_way,
    inside,
    point_to_segment,
    segment_distance,
    turn,
)
from casper.sim_adapter.room.navigation import Navigator, length

FLOOR = floor_of(kitchen_scene())
HUMAN = Navigator(FLOOR, kitchen_scene().human_settings.radius)
ROBOT = Navigator(FLOOR, kitchen_scene().robot_settings.radius)
TABLE = kitchen_scene().holes[0]

points = st.tuples(st.floats(-2.14, 1.42), st.floats(-3.8, 0.95))


def along(path, step=0.02):
    for (ax, ay), (bx, by) in pairwise(path):
        pieces = max(1, math.ceil(math.dist((ax, ay), (bx, by)) / step))
        for piece in range(pieces + 1):
            yield ax + (bx - ax) * piece / pieces, ay + (by - ay) * piece / pieces


@settings(max_examples=60, deadline=None)
@given(points, points, st.sampled_from([HUMAN, ROBOT]))
def test_a_path_never_leaves_the_walkable_floor_nor_enters_the_table(start, goal, ways):
    assume(ways.free(start) and ways.free(goal))
    path = ways.path(start, goal)
    assert path is not None and path[0] == start and path[-1] == goal
    for x, y in along(path):
        assert inside(kitchen_scene().walkable, (x, y))
        assert not (TABLE[0] < x < TABLE[2] and TABLE[1] < y < TABLE[3])
        assert FLOOR.clearance((x, y)) > ways.radius - 0.01


@settings(max_examples=40, deadline=None)
@given(points, points, points)
def test_a_path_keeps_away_from_another_agent(start, goal, other):
    disc = Disc(*other, 0.55)
    assume(HUMAN.free(start, [disc]) and HUMAN.free(goal, [disc]))
    path = HUMAN.path(start, goal, [disc])
    if path is not None:
        assert all(math.dist(point, other) > disc.radius - 0.01 for point in along(path))


@settings(max_examples=40, deadline=None)
@given(points, points)
def test_pulling_the_string_never_makes_a_path_shorter_than_the_straight_line(start, goal):
    assume(HUMAN.free(start) and HUMAN.free(goal))
    assert length(HUMAN.path(start, goal)) >= math.dist(start, goal) - 1e-9


def test_nobody_can_go_onto_the_table():
    assert HUMAN.path((0.5, -1.0), (-0.64, -1.43)) is None


def test_one_who_was_pushed_against_the_wall_can_still_get_away():
    assert HUMAN.path((-2.1, -1.0), (0.5, 0.0)) is not None


def test_a_blocked_passage_has_no_path():
    corridor = [Disc(-1.6, -1.4, 0.6), Disc(0.6, -1.4, 0.9)]
    assert HUMAN.path((-1.6, 0.4), (-1.0, -3.0), corridor) is None


@pytest.mark.parametrize("name", list(kitchen_scene().things))
def test_the_human_can_stand_in_the_touch_band_of_every_object(name):
    thing = kitchen_scene().thing(name)
    rings = (kitchen_scene().human_settings.stand_distance, *HUMAN_RINGS)
    spots = HUMAN.standing_points((thing.x, thing.y), rings)
    assert spots and all(math.dist(spot, (thing.x, thing.y)) <= 0.58 for spot in spots)


def test_what_lies_ahead_is_in_the_way_and_what_lies_behind_is_not():
    ahead, behind = Disc(0.6, 0.0, 0.5), Disc(-0.6, 0.0, 0.5)
    assert in_the_way((0.0, 0.0), (2.0, 0.0), [ahead])
    assert not in_the_way((0.0, 0.0), (2.0, 0.0), [behind])


def test_one_may_walk_out_of_a_disc_but_not_deeper_into_it():
    disc = Disc(0.0, 0.0, 0.5)
    assert not in_the_way((0.3, 0.0), (2.0, 0.0), [disc])
    assert in_the_way((0.3, 0.0), (-2.0, 0.0), [disc])


@given(st.floats(-100, 100))
def test_a_turn_is_within_half_a_circle_and_the_same_direction(angle):
    assert -math.pi <= turn(angle) <= math.pi
    assert math.isclose(math.cos(turn(angle)), math.cos(angle), abs_tol=1e-9)
    assert math.isclose(math.sin(turn(angle)), math.sin(angle), abs_tol=1e-9)


@given(points, points, points, points)
def test_the_distance_of_segments_is_symmetric_and_never_above_that_of_their_ends(a, b, c, d):
    gap = segment_distance((a, b), (c, d))
    assert math.isclose(gap, segment_distance((c, d), (a, b)), abs_tol=1e-9)
    assert gap <= point_to_segment(a, (c, d)) + 1e-9
