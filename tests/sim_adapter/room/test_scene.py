import math

import pytest
from simulated_kitchen import SCENE_FILE, kitchen_scene

from casper.kb.base import KnowledgeBase
from casper.kb.errors import DomainError
from casper.sim_adapter.room.facts import scene_from
from casper.sim_adapter.room.settings import HumanSettings


def without(line_start):
    text = "\n".join(line for line in SCENE_FILE.read_text().splitlines() if not line.startswith(line_start))
    return KnowledgeBase.from_text(text).rows


def changed(line_start, line):
    """The scene with one line replaced by another."""
    lines = SCENE_FILE.read_text().splitlines()
    assert sum(old.startswith(line_start) for old in lines) == 1
    return KnowledgeBase.from_text("\n".join(line if old.startswith(line_start) else old for old in lines)).rows


def test_the_kitchen_has_the_papers_seven_objects():
    assert set(kitchen_scene().things) == {"sink", "hobs", "glass", "biscuits", "meal", "plate", "bottle"}


def test_sink_and_hobs_are_fixed_and_the_rest_can_be_moved():
    assert set(kitchen_scene().movables) == {"glass", "biscuits", "meal", "plate", "bottle"}


def test_the_robot_starts_facing_north():
    assert kitchen_scene().starts["tiago"] == (-0.16, -3.54, math.pi / 2)


@pytest.mark.parametrize(
    ("line", "needed"),
    [
        ("body(human", "body(Name, person)"),
        ("body(tiago", "body(Name, mobile_manipulator)"),
        ("shape(plate", "shape(plate, Kind, SizeX, SizeY, SizeZ)"),
        ("position(plate", "position(plate, X, Y, Z)"),
        ("outline(", "outline(Number, X, Y)"),
    ],
)
def test_a_missing_fact_is_named(line, needed):
    with pytest.raises(DomainError) as mistake:
        scene_from(without(line))
    assert needed in str(mistake.value)


@pytest.mark.parametrize(
    ("line_start", "line", "named"),
    [
        ("setting(human, walk_speed,", "setting(human, walk_sped, 0.8).", "walk_sped"),
        ("setting(sensor, drop,", "setting(sensor, drop, often).", "often"),
        ("placing(sink,", "placing(sink, under).", "under"),
        ("shape(meal,", "shape(meal, cone, 0.07, 0.07, 0.08).", "cone"),
        ("position(meal,", "position(meal, here, -1.58, 1.02).", "here"),
        ("furniture(worktop_4,", "furniture(worktop_4, sofa, 0.33, 1.31, 2.25, 0.69, 0.86).", "sofa"),
        ("opens(fridge,", "opens(fridge, up).", "up"),
    ],
)
def test_a_wrong_fact_is_named(line_start, line, named):
    with pytest.raises(DomainError, match=named):
        scene_from(changed(line_start, line))


def test_a_setting_that_is_not_there_keeps_its_default():
    rows = without("setting(human, walk_speed")
    assert scene_from(rows).human_settings.walk_speed == HumanSettings().walk_speed


def test_settings_of_other_groups_are_none_of_the_scenes_business():
    period = next(line for line in SCENE_FILE.read_text().splitlines() if line.startswith("setting(sim, period"))
    rows = changed("setting(sim, period", period + " setting(focus, threshold, 0.45).")
    assert scene_from(rows) == kitchen_scene()


def test_asking_for_an_unknown_object_names_those_there_are():
    with pytest.raises(DomainError, match=r"no object toaster.*plate"):
        kitchen_scene().thing("toaster")
