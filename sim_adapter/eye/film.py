"""A film of a simulation as MP4, drawn without a screen and encoded by ffmpeg while the simulation goes on."""

from __future__ import annotations

import math
from collections.abc import Generator, Iterator
from contextlib import contextmanager, suppress
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from casper.kb.errors import CasperError
from casper.kb.text.files import check_writable
from casper.sim_adapter.eye.camera import Camera
from casper.sim_adapter.room.scene import Scene

WIDTH, HEIGHT = 960, 720  # pixels; multiples of 16, which encoders want
EVERY = 0.2  # simulated seconds from one picture to the next
SPEED = 4  # times as fast as it was
SEEN = 45.0  # degrees that the camera sees from below to above


def check_film(path: Path) -> None:
    """Refuse a file to which no film can be written, before anything is simulated.

    Raises:
        CasperError: another ending than .mp4, a place where writing is not allowed, no ffmpeg.
    """
    if path.suffix.lower() != ".mp4":
        raise CasperError(f"a film is written as .mp4, such as {path.stem or 'run'}.mp4, not as {path.name}")
    check_writable(path)
    if find_spec("imageio_ffmpeg") is None:
        raise CasperError("films need imageio-ffmpeg, which is not installed: pip install 'casper-hri[video]'")
    import imageio_ffmpeg

    try:
        imageio_ffmpeg.get_ffmpeg_exe()
    except RuntimeError:
        advice = "install it, or name it in IMAGEIO_FFMPEG_EXE"
        raise CasperError(f"films need ffmpeg, and imageio-ffmpeg finds none: {advice}") from None


class Film:
    """Takes a picture of the physics whenever `EVERY` seconds have gone by.

    Raises:
        RenderError: there is no OpenGL. CasperError: ffmpeg cannot encode it, or as `check_film`.
    """

    def __init__(self, physics: Any, path: Path, width: int = WIDTH, height: int = HEIGHT) -> None:
        check_film(path)
        import imageio_ffmpeg

        self.physics, self.path = physics, path
        self.camera = Camera(physics, width, height)
        self.view = overview(physics.scene, width / height)
        self._number = 0
        how: dict[str, Any] = {"fps": SPEED / EVERY, "ffmpeg_log_level": "error"}
        self._file: Generator[None, Any, None] = imageio_ffmpeg.write_frames(str(path), (width, height), **how)
        self._told(None)  # opens it

    def look(self) -> None:
        """A picture of this moment, when it is time for one."""
        if self.physics.time >= self._number * EVERY - 1e-9:
            self._number += 1
            self._told(self.camera.frame(**self.view).tobytes())

    def close(self) -> None:
        """Finish the file; what was filmed so far can be watched."""
        with suppress(OSError):
            self._file.close()
        self.camera.close()

    def _told(self, picture: bytes | None) -> None:
        try:
            self._file.send(picture)
        except Exception as mistake:  # whatever reading the messages of an ffmpeg that is not one may raise
            said = str(mistake).strip().splitlines() if isinstance(mistake, OSError) else []
            first = (said or ["it stopped, or lacks the codec H.264"])[0]
            raise CasperError(f"ffmpeg cannot encode {self.path}: {first}") from None


def overview(scene: Scene, ratio: float) -> dict[str, Any]:
    """Where a camera has to be to see the whole floor at an angle from the south; for `Camera.frame`.

    Args:
        scene: what is to be seen.
        ratio: how much wider a picture is than high.
    """
    (left, right), (front, back) = scene.extent
    half = math.tan(math.radians(SEEN / 2))
    reach = max((right - left) / 2 / ratio, (back - front) / 2)
    return {
        "azimuth": 90.0,
        "elevation": -58.0,
        "distance": reach / half + 1.0,
        "look_at": ((left + right) / 2, (front + back) / 2, 0.3),
    }


@contextmanager
def filming(simulation: Any, path: Path | None) -> Iterator[None]:
    """Film a simulation while this lasts; nothing without a path.

    Raises:
        RenderError, CasperError: as `Film`.
    """
    if path is None:
        yield
        return
    film = Film(simulation.physics, path)
    simulation.each_glance = film.look
    try:
        yield
    finally:
        simulation.each_glance = bool
        film.close()
