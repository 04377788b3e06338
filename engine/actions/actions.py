"""Which action the movements amount to: the two recognisers by name, the contextualisation."""

from __future__ import annotations

from collections.abc import Mapping

from casper.engine.actions.fsm import movements_of, read_fsms
from casper.engine.actions.hmm import HmmRecogniser, read_emission
from casper.engine.actions.prediction import ActionRecogniser, ActionSettings, action_settings
from casper.engine.actions.ratcliff import RatcliffRecogniser
from casper.engine.settings import Rows, require


def action_recogniser(rows: Rows, settings: ActionSettings | None = None) -> ActionRecogniser:
    """The recogniser a domain asks for, over its FSMs.

    Raises:
        DomainError: as ``read_fsms``, ``read_emission`` and ``action_settings`` do.
    """
    settings = settings or action_settings(rows)
    fsms = read_fsms(rows)
    if settings.recogniser == "ratcliff":
        return RatcliffRecogniser(settings, fsms)
    return HmmRecogniser(settings, fsms, read_emission(rows, movements_of(fsms), settings.error))


def context_table(rows: Rows) -> dict[tuple[str, str], str]:
    """Facts ``context(Action, Destination, Contextualised)`` as a table.

    Raises:
        DomainError: one action and destination with two meanings.
    """
    table: dict[tuple[str, str], str] = {}
    for action, destination, meaning in rows("context", 3):
        other = table.setdefault((action, destination), meaning)
        require(other == meaning, f"context({action}, {destination}, …) is both {other} and {meaning}")
    return table


def contextualise(action: str, destination: str | None, table: Mapping[tuple[str, str], str]) -> str | None:
    """What the action means at this destination (paper, table context).

    An action the table does not mention passes through; one it does mention is None where the destination is
    unknown or not in it.
    """
    if all(action != known for known, _ in table):
        return action
    return None if destination is None else table.get((action, destination))
