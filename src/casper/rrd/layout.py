"""How the viewer opens a recording: the room, what was told and why to the left, series and bands to the right."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from casper.sim_adapter.room.scene import Scene

ABOVE = 1.25  # how far the eye is from the room's middle, by its larger side


def layout(scene: Scene | None, agents: Sequence[str]) -> Any:
    """A blueprint of Rerun's. Of the ways of the agents everything up to the chosen moment is shown."""
    import rerun
    import rerun.blueprint as blueprint

    begin, now = rerun.TimeRangeBoundary.infinite(), rerun.TimeRangeBoundary.cursor_relative()
    so_far = blueprint.VisibleTimeRanges([rerun.VisibleTimeRange("time", start=begin, end=now)])
    room = blueprint.Spatial3DView(
        origin="room",
        name="room",
        overrides={f"room/ways/{rerun.escape_entity_path_part(name)}": so_far for name in agents},
        **({} if scene is None else {"eye_controls": _eye(scene, blueprint)}),
    )
    told = blueprint.Vertical(
        blueprint.TextLogView(origin="told", name="what happened"),
        blueprint.TextDocumentView(origin="why", name="why"),
    )
    series = blueprint.Vertical(
        blueprint.TimeSeriesView(origin="posterior", name="posterior of each goal"),
        blueprint.TimeSeriesView(origin="focus", name="focus of each thing"),
        blueprint.StateTimelineView(origin="bands", name="target, movement, action, goal, robot"),
    )
    return blueprint.Blueprint(
        blueprint.Horizontal(blueprint.Vertical(room, told, row_shares=[3, 2]), series, column_shares=[1, 1]),
        blueprint.TimePanel(state="collapsed", timeline="time"),
        blueprint.BlueprintPanel(state="collapsed"),
        blueprint.SelectionPanel(state="collapsed"),
    )


def _eye(scene: Scene, blueprint: Any) -> Any:
    """From the south at an angle, so that the whole floor is seen."""
    (left, right), (front, back) = scene.extent
    x, y = scene.middle
    far = ABOVE * max(right - left, back - front)
    slant = math.radians(58)
    place = (x, y - far * math.cos(slant), far * math.sin(slant))
    return blueprint.EyeControls3D(position=place, look_target=(x, y, 0.3), eye_up=(0, 0, 1))
