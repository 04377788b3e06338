"""Physics that blows up is told of in a sentence, before its numbers reach anybody, and leaves no file behind."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

from casper.kb.errors import CasperError

FASTEST = 200.0  # m/s or rad/s of a joint: nothing in a room is so fast unless the numbers run away
_WARNINGS = mujoco.mjtWarning
UNSTABLE = (_WARNINGS.mjWARN_BADQPOS, _WARNINGS.mjWARN_BADQVEL, _WARNINGS.mjWARN_BADQACC, _WARNINGS.mjWARN_BADCTRL)


class PhysicsFailed(CasperError):
    """The numbers ran away: what the simulation holds now means nothing, so it ends."""


def keep_warnings_to_itself() -> None:
    """MuJoCo counts its warnings in the data and writes no MUJOCO_LOG.TXT; a handler of somebody else stays."""
    if mujoco.get_mju_user_warning() is None:
        mujoco.set_mju_user_warning(_counted)


def _counted(_: str) -> None:
    """The warning is in ``data.warning``, where `check_stable` looks."""


def check_stable(model: Any, data: Any, before: float) -> None:
    """See that the numbers mean something after a step.

    Args:
        model, data: MuJoCo's.
        before: seconds on the clock before the step; MuJoCo sets everything back to the start at a bad number.

    Raises:
        PhysicsFailed: a number is no number or huge, with the time and the joint.
    """
    found = next((data.warning[kind] for kind in UNSTABLE if data.warning[kind].number), None)
    dof = None if found is None else int(found.lastinfo)
    if dof is None and not np.abs(data.qvel).max(initial=0.0) < FASTEST:
        dof = int(np.abs(np.nan_to_num(data.qvel, nan=np.inf)).argmax())
    if dof is None:
        return
    where = f" at {_joint(model, dof)}" if 0 <= dof < model.nv else ""
    told = f"the simulated physics became unstable after {before:.1f} s{where}, so the trial ends there"
    raise PhysicsFailed(f"{told}; a smaller setting(sim, timestep, …) is slower and steadier")


def _joint(model: Any, dof: int) -> str:
    """The name of the joint that a degree of freedom belongs to; a movable's joint is named like it."""
    return str(model.joint(int(model.dof_jntid[dof])).name)
