"""HOLD: whether there is something in a hand."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from casper.qsr.calculi.calculus import Moment, Plain

if TYPE_CHECKING:
    from casper.qsr.arrays.scene import Array, Scene


@dataclass(frozen=True)
class Hold(Plain):
    """``holding`` or ``free``, of an agent alone; what it holds is in the trace."""

    name: str = "hold"
    arity = 1
    motion = False
    needs = ()
    labels = ("free", "holding")
    remembers = False

    def codes(self, scene: Scene, before: Array) -> Array:
        """See `Calculus.codes`; free where nothing is known of hands."""
        import numpy as np

        from casper.qsr.arrays.scene import rows_of

        frames = scene.frames
        if frames.held is None:
            return np.zeros((len(scene.of[0]), frames.where[0].shape[1] - 1), dtype=np.int8)
        return np.asarray((rows_of(frames.held, scene.of[0])[:, 1:] >= 0).astype(np.int8))

    def one(self, moment: Moment, before: str | None) -> str:
        """See `Calculus.one`."""
        return "free" if moment.now[0].holding is None else "holding"
