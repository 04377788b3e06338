"""What the messages say that are read: transforms between frames, poses, and what was detected where."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, TypeAlias

from casper.streams.ros.containers import Heard
from casper.streams.ros.frames import Pose, pose_from

DETECTIONS = ("vision_msgs/Detection3DArray", "vision_msgs/Detection3D")
KINDS = frozenset({"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped", "nav_msgs/Odometry", *DETECTIONS})


@dataclass(frozen=True, slots=True)
class Placed:
    """A frame within another, at a time (seconds)."""

    t: float
    parent: str
    frame: str
    pose: Pose
    is_static: bool = False


@dataclass(frozen=True, slots=True)
class Detected:
    """Something seen in a frame: its identifier (empty: none), its likeliest class, and how sure that is."""

    t: float
    frame: str
    identifier: str
    label: str
    score: float
    pose: Pose


Told: TypeAlias = Placed | Detected


def told(heard: Heard) -> Iterator[Told | None]:
    """What a message says; None: something in it that is no finite pose."""
    said = heard.said
    match heard.kind:
        case "tf2_msgs/TFMessage":
            is_static = heard.topic.endswith("tf_static")
            for transform in said.transforms:
                yield _placed(transform, is_static)
        case "geometry_msgs/TransformStamped":
            yield _placed(said, heard.topic.endswith("_static"))
        case "nav_msgs/Odometry":
            pose = _pose(said.pose.pose.position, said.pose.pose.orientation)
            parent, frame = _name(said.header.frame_id), _name(said.child_frame_id)
            yield None if pose is None else Placed(_seconds(said.header.stamp), parent, frame, pose)
        case "vision_msgs/Detection3DArray":
            for detection in said.detections:
                yield _detected(detection, said.header)
        case "vision_msgs/Detection3D":
            yield _detected(said, said.header)


def _placed(transform: Any, is_static: bool) -> Placed | None:
    pose = _pose(transform.transform.translation, transform.transform.rotation)
    if pose is None:
        return None
    header = transform.header
    return Placed(_seconds(header.stamp), _name(header.frame_id), _name(transform.child_frame_id), pose, is_static)


def _detected(detection: Any, outer: Any) -> Detected | None:
    """A detection; its header may be empty, and the array's counts then."""
    header = getattr(detection, "header", outer)
    frame = _name(header.frame_id) or _name(outer.frame_id)
    t = _seconds(header.stamp) or _seconds(outer.stamp)
    label, score = "", 0.0
    for result in detection.results:
        hypothesis = getattr(result, "hypothesis", result)  # vision_msgs 4, or before
        sure = float(hypothesis.score)
        if not label or sure > score:
            label, score = str(getattr(hypothesis, "class_id", getattr(hypothesis, "id", ""))), sure
    identifier = str(getattr(detection, "id", getattr(detection, "tracking_id", "")))
    center = detection.bbox.center
    pose = _pose(center.position, center.orientation)
    return None if pose is None else Detected(t, frame, identifier, label, score, pose)


def _pose(place: Any, turn: Any) -> Pose | None:
    numbers = (float(place.x), float(place.y), float(place.z))
    return pose_from(numbers, (float(turn.x), float(turn.y), float(turn.z), float(turn.w)))


def _seconds(stamp: Any) -> float:
    return float(stamp.sec) + float(stamp.nanosec) / 1e9


def _name(frame: str) -> str:
    return str(frame).lstrip("/")
