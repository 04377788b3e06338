"""Pictures of the room (PNG), where off-screen rendering is available."""

from __future__ import annotations

import math
import struct
import warnings
import zlib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from casper.kb.errors import CasperError
from casper.sim_adapter.physics.parts import FLOOR, FURNITURE, HUMAN, ROBOT, THINGS

SHOWN = (FLOOR, FURNITURE, THINGS, HUMAN, ROBOT)  # the walls would hide the room


class RenderError(CasperError):
    """No picture can be drawn on this machine; the sentence says what is missing."""


class Camera:
    """Draws a simulation's physics from outside: azimuth and elevation in degrees, distance and look-at in metres.

    Raises:
        RenderError: there is no OpenGL. Without a screen, MUJOCO_GL must be egl or osmesa before MuJoCo is imported.
    """

    def __init__(self, physics: Any, width: int = 960, height: int = 720) -> None:
        self.physics = physics
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                self._renderer = mujoco.Renderer(physics.model, height, width)
        except Exception as reason:  # whatever the platform's OpenGL raises
            raise RenderError(
                "pictures need OpenGL: without a screen, install libegl1 (or libosmesa6) and start with MUJOCO_GL=egl "
                f"(or osmesa) in the environment; MuJoCo says: {reason}"
            ) from None
        self._view = mujoco.MjvCamera()
        self._option = mujoco.MjvOption()
        for group in range(6):
            self._option.geomgroup[group] = group in SHOWN
            self._option.sitegroup[group] = 0

    def frame(
        self,
        *,
        azimuth: float = 70.0,
        elevation: float = -50.0,
        distance: float = 6.5,
        look_at: Sequence[float] = (0.0, -1.0, 0.6),
    ) -> NDArray[np.uint8]:
        """A picture, height × width × 3, seen from above at an angle by default."""
        self._view.azimuth, self._view.elevation, self._view.distance = azimuth, elevation, distance
        self._view.lookat[:] = look_at
        self._renderer.update_scene(self.physics.data, camera=self._view, scene_option=self._option)
        picture: NDArray[np.uint8] = self._renderer.render()
        return picture

    def eye(self) -> NDArray[np.uint8]:
        """What the camera in the robot's head shows."""
        name = f"{self.physics.scene.robot}:eye"
        self._renderer.update_scene(self.physics.data, camera=name, scene_option=self._option)
        picture: NDArray[np.uint8] = self._renderer.render()
        return picture

    def close(self) -> None:
        """Free the renderer."""
        self._renderer.close()


def write_png(path: Path | str, picture: NDArray[np.uint8]) -> None:
    """Write a height × width × 3 picture as a PNG file."""
    height, width, _ = picture.shape
    lines = b"".join(b"\0" + picture[row].tobytes() for row in range(height))
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    chunks = (b"IHDR", header), (b"IDAT", zlib.compress(lines, 6)), (b"IEND", b"")
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for kind, data in chunks:
            file.write(struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)))


def look_from(place: Sequence[float], at: Sequence[float]) -> dict[str, Any]:
    """The arguments of ``frame`` for a camera at ``place`` looking at ``at`` (metres)."""
    dx, dy, dz = (b - a for a, b in zip(place, at))
    distance = math.sqrt(dx * dx + dy * dy + dz * dz)
    return {
        "azimuth": math.degrees(math.atan2(dy, dx)),
        "elevation": math.degrees(math.asin(dz / distance)),
        "distance": distance,
        "look_at": tuple(at),
    }
