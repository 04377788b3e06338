"""What recognises actions: its settings, and what it says."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

from casper.engine.movements.movements import Movement
from casper.engine.settings import Rows, read_settings, require


@dataclass(frozen=True, slots=True)
class ActionSettings:
    """How actions are recognised.

    recogniser: ``hmm`` or ``ratcliff`` (the paper's). filter_window: steps of the movement filter.

    Of ``ratcliff``: mode ``argmax`` (one likeliest chain, repeatable), ``sample`` (one drawn chain) or
    ``mean`` (of ``samples`` drawn chains, from ``seed``); length of a chain; letters ``own`` or ``first``
    (two movements with one first letter are then alike, as in the paper's figure); threshold of the
    winner's score.

    Of ``hmm``: certainty, the probability from which an action has happened; confirm, for how many steps in
    a row; lasts, the mean seconds of a movement; error, that one is classified wrongly (used where no
    ``emission/3`` says more); idle, that what comes after an action is none; abandon, that an action is
    broken off at a change of movement; again, that an accepted loop goes on at one.
    """

    recogniser: str = "hmm"
    filter_window: int = 3
    mode: str = "argmax"
    samples: int = 64
    seed: int = 0
    length: int = 6
    letters: str = "own"
    threshold: float = 0.7
    certainty: float = 0.6
    confirm: int = 2
    lasts: float = 6.0
    error: float = 0.1
    idle: float = 0.2
    abandon: float = 0.02
    again: float = 0.5

    def __post_init__(self) -> None:
        require(self.recogniser in ("hmm", "ratcliff"), f"recogniser is hmm or ratcliff, not {self.recogniser}")
        require(self.mode in ("argmax", "sample", "mean"), f"mode is argmax, sample or mean, not {self.mode}")
        require(self.letters in ("own", "first"), f"letters is own or first, not {self.letters}")
        require(
            min(self.filter_window, self.samples, self.length, self.confirm) >= 1,
            "filter_window, samples, length and confirm of the actions start at 1",
        )
        for name in ("threshold", "certainty", "error", "idle", "abandon", "again"):
            require(0.0 <= getattr(self, name) <= 1.0, f"{name} of the actions lies between 0 and 1")
        require(self.lasts > 0.0 and self.error > 0.0, "lasts and error of the actions are above 0")


def action_settings(rows: Rows) -> ActionSettings:
    """Settings from facts ``setting(actions, Name, Value)``.

    Raises:
        DomainError: an unknown setting or a value of the wrong kind.
    """
    return read_settings(ActionSettings, rows, "actions")


@dataclass(frozen=True, slots=True)
class Prediction:
    """An action that is taken to have happened.

    score: the winner's similarity (ratcliff) or probability (hmm); scores: everyone's. movements: the
    filtered movements since the last accepted action. fresh: this action did not stand at the step before.
    """

    t: float
    action: str
    score: float
    scores: Mapping[str, float]
    movements: tuple[str, ...]
    fresh: bool = True


@dataclass(frozen=True, slots=True)
class Misread:
    """A movement that was seen at ``t`` (seconds) and later turned out to have probably been another."""

    t: float
    seen: str
    likely: str


class ActionRecogniser(Protocol):
    """A movement a step in, an action out while one stands.

    A prediction is repeated, with ``fresh`` off, at every step while it stands, so that one whose destination
    was not known yet can be tried again. ``accept`` is called when it passed verification; a rejected one is
    simply not accepted, and clears nothing.
    """

    @property
    def scores(self) -> Mapping[str, float]:
        """Each action's score after the last step."""

    @property
    def window(self) -> tuple[str, ...]:
        """The filtered movements since the last accepted action."""

    def update(self, movement: Movement) -> Prediction | None:
        """Take in the movement of one step."""

    def misread(self) -> tuple[Misread, ...]:
        """What was seen on the way to the standing prediction and was probably something else."""

    def expect(self, weights: Mapping[str, float]) -> None:
        """How much likelier each action is to come than if nothing were known; only where movements are not sure."""

    def accept(self) -> None:
        """The standing prediction happened: begin anew behind it."""

    def reset(self) -> None:
        """Forget everything."""
