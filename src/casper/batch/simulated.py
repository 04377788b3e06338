"""Simulated trials as rows: settings in, what became of it out."""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import lru_cache
from importlib.util import find_spec
from typing import Any

from casper.batch.judging import FIGURES, judged, trial_settings
from casper.engine.domain.altering import altered
from casper.engine.domain.domain import Domain
from casper.kb.errors import CasperError

GIVES = ("trial", *FIGURES)


def simulated(domain: Domain, trial: Any, options: Mapping[str, Any]) -> dict[str, Any]:
    """Run a trial.

    Args:
        domain: where.
        trial: fields of `casper.sim_adapter.trial.TrialSettings`, and beside them ``settings``: what the domain's
            settings are changed to (`engine.domain.altering`).
        options: none.

    Raises:
        CasperError: MuJoCo is not installed, a setting that makes no sense, or the trial broke off.
    """
    if find_spec("mujoco") is None:
        raise CasperError("trials need MuJoCo, which is not installed: pip install 'casper-hri[sim]'")
    if not isinstance(trial, Mapping):
        raise CasperError(f"a trial is a mapping of settings, as in {{'goal': 'lunch', 'seed': 3}}, not {trial!r:.60}")
    given = dict(trial)
    changed = given.pop("settings", None) or {}
    where = _changed(domain, json.dumps(changed, sort_keys=True))
    return {"trial": dict(trial), **judged(where, trial_settings(given))}


@lru_cache(maxsize=4)
def _changed(domain: Domain, settings: str) -> Domain:
    """The domain with other settings, made once for all trials of a condition in a row."""
    return altered(domain, json.loads(settings))
