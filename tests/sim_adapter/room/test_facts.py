"""Scenes in few lines: what they leave out has sensible values."""

import math

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.errors import DomainError
from casper.sim_adapter.room.facts import scene_from
from casper.sim_adapter.room.geometry import floor_of

ROOM = """
room_size(4, 3).
furniture(table, table, -1, 1).   furniture(rack, counter, 1.6, 0, 0.6, 1.2).   furniture(fridge, cabinet, -1.6, -1).
position(cup, table).   shape(cup, cylinder).   position(plate, table).   shape(plate, dish).
position(tray, rack).   shape(tray, panel).     position(milk, fridge).   shape(milk, box).
"""


def scene(text=ROOM):
    return scene_from(KnowledgeBase.from_text(text).rows, ("ann", "bob"), "robbie")


def test_the_room_is_a_rectangle_round_the_middle():
    assert scene().extent == ((-2, 2), (-1.5, 1.5)) and scene().middle == (0, 0)


def test_one_walks_wherever_no_furniture_stands():
    floor = floor_of(scene())
    assert floor.free((0, 0), 0.2)
    assert not floor.free((-1, 1), 0.2) and not floor.free((1.6, 0.3), 0.2)


def test_those_who_are_watched_and_who_helps_are_there():
    assert (scene().people, scene().human, scene().robot) == (("ann", "bob"), "ann", "robbie")
    named = scene(ROOM + "body(cleo, person).")
    assert (named.people, named.robot) == (("cleo",), "robbie")


def test_furniture_has_the_usual_sizes_and_a_cabinet_is_open_towards_the_middle():
    pieces = {piece.name: piece for piece in scene().furniture}
    table, rack, fridge = pieces["table"], pieces["rack"], pieces["fridge"]
    assert (table.size_x, table.size_y, table.top) == (1.2, 0.7, 0.74)
    assert (rack.size_x, rack.size_y, rack.top) == (0.6, 1.2, 0.86)
    assert (fridge.opens, fridge.surface) == ("east", 0.98)


def test_things_on_one_piece_of_furniture_stand_apart_and_within_reach():
    things = scene().things
    cup, plate = things["cup"], things["plate"]
    assert (cup.x, plate.x) == pytest.approx((-1.3, -0.7)) and cup.y == plate.y == pytest.approx(0.95)
    assert cup.z == 0.74 and things["milk"].z == 0.98


def test_what_can_be_moved_has_a_mass_and_a_dish_and_a_panel_take_things():
    things = scene().things
    assert [name for name, thing in things.items() if thing.movable] == ["cup", "plate", "milk"]
    assert {name: thing.placing for name, thing in things.items() if thing.placing} == {
        "plate": "inside",
        "tray": "on_top",
    }
    assert len({thing.colour for thing in things.values()}) == 4


def test_the_robot_need_not_say_where_it_starts():
    assert scene().starts == {}
    assert scene(ROOM + "start(robbie, 1, 0, 90).").starts == {"robbie": (1, 0, math.pi / 2)}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (ROOM.replace("room_size(4, 3).", ""), r"state its size: room_size\(SizeX, SizeY\)"),
        (ROOM + "room_size(5, 5).", "is one fact with two lengths"),
        (ROOM + "position(pot, stove). shape(pot, dish).", "needs the furniture stove; there is rack, table, fridge"),
        (ROOM + "position(pot, table).", r"shape\(pot, Kind\)"),
        (ROOM + "shape(pot, dish).", r"position\(pot, X, Y, Z\) or position\(pot, Furniture\)"),
        (ROOM + "shape(cup, dish).", "a thing has one"),
        (ROOM + "furniture(rack, table, 0, 0).", "is there twice"),
        (ROOM + "body(cleo, dog).", "cleo cannot be dog"),
        (ROOM + "mass(tray, 1).", "tray cannot be panel; it must be one of box, cylinder, dish"),
    ],
)
def test_what_makes_no_sense_is_named(text, said):
    with pytest.raises(DomainError, match=said):
        scene(text)
