"""Which action the movements amount to: the two recognisers by name."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from casper.engine.actions.durations import read_durations
from casper.engine.actions.expecting import planned
from casper.engine.actions.fsm import movements_of, read_fsms
from casper.engine.actions.hmm import HmmRecogniser, read_emission
from casper.engine.actions.prediction import ActionRecogniser, ActionSettings, action_settings
from casper.engine.actions.ratcliff import RatcliffRecogniser
from casper.engine.settings import Rows


def action_recogniser(
    rows: Rows,
    settings: ActionSettings | None = None,
    skills: Mapping[str, str] | None = None,
    known: Collection[str] = (),
) -> ActionRecogniser:
    """The recogniser a domain asks for, over its FSMs.

    Args:
        rows: of the domain.
        settings: None: as the domain says.
        skills: by what actions are called in their contexts, what they are recognised as.
        known: the actions of the plans.

    Raises:
        DomainError: as ``read_fsms``, ``read_emission`` and ``action_settings`` do.
    """
    settings = settings or action_settings(rows)
    fsms = read_fsms(rows)
    if settings.recogniser == "ratcliff":
        return RatcliffRecogniser(settings, fsms)
    movements = movements_of(fsms)
    durations = read_durations(rows, movements, settings.lasts)
    of_plans = planned([fsm.action for fsm in fsms], skills or {}, known)
    return HmmRecogniser(settings, fsms, read_emission(rows, movements, settings.error), durations, of_plans)
