"""Frames: where each is in its parent at a time, and so in any frame above (ROS's tf2, in the small).

A transform is found between two that were sent, by going straight from one place to the other and turning evenly; after
the last one it stands for a while. Static ones stand for ever.
"""

from __future__ import annotations

from bisect import bisect_right
from collections import deque
from dataclasses import dataclass, field
from math import atan2, hypot, isfinite, sqrt

STANDS = 1.0  # seconds for which the last transform is taken to hold
KEPT = 400  # transforms of a frame
DEEPEST = 64  # frames above one another
MOST = 5_000  # frames


@dataclass(frozen=True, slots=True)
class Pose:
    """A place (metres) and a turn, a unit quaternion."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    qx: float = 0.0
    qy: float = 0.0
    qz: float = 0.0
    qw: float = 1.0

    def of(self, inner: Pose) -> Pose:
        """A pose that is told within this one, told where this one is."""
        x, y, z, w = self.qx, self.qy, self.qz, self.qw
        # t = 2 q × v; v' = v + w t + q × t
        tx = 2 * (y * inner.z - z * inner.y)
        ty = 2 * (z * inner.x - x * inner.z)
        tz = 2 * (x * inner.y - y * inner.x)
        return Pose(
            self.x + inner.x + w * tx + y * tz - z * ty,
            self.y + inner.y + w * ty + z * tx - x * tz,
            self.z + inner.z + w * tz + x * ty - y * tx,
            w * inner.qx + x * inner.qw + y * inner.qz - z * inner.qy,
            w * inner.qy - x * inner.qz + y * inner.qw + z * inner.qx,
            w * inner.qz + x * inner.qy - y * inner.qx + z * inner.qw,
            w * inner.qw - x * inner.qx - y * inner.qy - z * inner.qz,
        )

    @property
    def heading(self) -> float:
        """Radians from the x axis to where its own x axis points, seen from above."""
        return atan2(2 * (self.qw * self.qz + self.qx * self.qy), 1 - 2 * (self.qy * self.qy + self.qz * self.qz))

    def between(self, other: Pose, share: float) -> Pose:
        """On the way to another."""
        sign = self.qx * other.qx + self.qy * other.qy + self.qz * other.qz + self.qw * other.qw
        a, b = 1 - share, share if sign >= 0 else -share
        q = [
            a * self.qx + b * other.qx,
            a * self.qy + b * other.qy,
            a * self.qz + b * other.qz,
            a * self.qw + b * other.qw,
        ]
        norm = sqrt(sum(value * value for value in q)) or 1.0
        x, y, z = (mine + share * (theirs - mine) for mine, theirs in zip(self.place, other.place))
        return Pose(x, y, z, *(value / norm for value in q))

    @property
    def place(self) -> tuple[float, float, float]:
        """Metres."""
        return self.x, self.y, self.z

    def gap(self, other: Pose) -> float:
        """Metres between both."""
        return hypot(self.x - other.x, self.y - other.y, self.z - other.z)


def pose_from(place: tuple[float, float, float], turn: tuple[float, float, float, float]) -> Pose | None:
    """A pose of numbers that somebody sent; None: they are none of a pose. A turn of zeros is no turn."""
    norm = sqrt(sum(value * value for value in turn))
    if not all(map(isfinite, (*place, norm))):
        return None
    return Pose(*place, *(value / norm for value in turn)) if norm > 1e-6 else Pose(*place)


@dataclass(slots=True)
class _Edge:
    parent: str
    is_static: bool
    times: deque[float] = field(default_factory=lambda: deque(maxlen=KEPT))
    poses: deque[Pose] = field(default_factory=lambda: deque(maxlen=KEPT))

    def at(self, t: float) -> Pose | None:
        if self.is_static:
            return self.poses[-1]
        after = bisect_right(self.times, t)
        if after == 0:
            return None
        before, first = self.times[after - 1], self.poses[after - 1]
        if after == len(self.times):
            return first if t - before <= STANDS else None
        if self.times[after] - before > STANDS and t - before > STANDS:
            return None
        return first.between(self.poses[after], (t - before) / (self.times[after] - before))


class Frames:
    """What was sent of frames so far."""

    def __init__(self) -> None:
        self.edges: dict[str, _Edge] = {}

    def __contains__(self, frame: str) -> bool:
        return frame in self.edges

    def add(self, t: float, parent: str, child: str, pose: Pose, is_static: bool = False) -> bool:
        """A transform; whether it was taken (not: an older one, a frame in itself, too many frames)."""
        edge = self.edges.get(child)
        if parent == child or (edge is None and len(self.edges) >= MOST):
            return False
        if edge is None or edge.parent != parent or edge.is_static != is_static:
            edge = self.edges[child] = _Edge(parent, is_static)
        if edge.times and t <= edge.times[-1] and not is_static:
            return False
        edge.times.append(t)
        edge.poses.append(pose)
        return True

    def above(self, frame: str) -> list[str]:
        """The frame, its parent, and so on up to the root."""
        found = [frame]
        while (edge := self.edges.get(found[-1])) is not None and len(found) < DEEPEST and edge.parent not in found:
            found.append(edge.parent)
        return found

    def pose(self, frame: str, within: str, t: float) -> Pose | None:
        """Where a frame is within one that is above it; None: that cannot be known."""
        pose = Pose()
        for _ in range(DEEPEST):
            if frame == within:
                return pose
            edge = self.edges.get(frame)
            here = None if edge is None else edge.at(t)
            if edge is None or here is None:
                return None
            pose, frame = here.of(pose), edge.parent
        return None
