"""The paper's ensemble: each FSM's chain compared with the observed movements by Ratcliff and Obershelp."""

from __future__ import annotations

import random
from collections import deque
from collections.abc import Mapping, Sequence
from difflib import SequenceMatcher
from math import fsum

from casper.engine.actions.fsm import Fsm, likeliest_chain, sampled_chain
from casper.engine.actions.prediction import ActionSettings, Misread, Prediction
from casper.engine.movements.movements import Movement, MovementFilter

LONGEST = 100  # movements of the window: a longer one resembles no chain, so only its end is kept


def similarity(sample: Sequence[str], observed: Sequence[str]) -> float:
    """Ratcliff-Obershelp, 0 to 1; not symmetric, hence sample first. Two empty ones are equal."""
    return SequenceMatcher(None, sample, observed, autojunk=False).ratio()


class RatcliffRecogniser:
    """The paper's recogniser; scores are worked out again only when the filtered movement changes.

    The winner is strictly best and at least ``threshold``. Before the filter says anything every score is 1
    (two empty sequences), hence nobody wins.
    """

    def __init__(self, settings: ActionSettings, fsms: tuple[Fsm, ...]) -> None:
        self.settings = settings
        self._fsms = fsms
        self._filter = MovementFilter(settings.filter_window)
        self.reset()

    def reset(self) -> None:
        """Forget everything; drawn chains repeat from the seed."""
        self._filter.reset()
        self._source = random.Random(self.settings.seed)
        self.accept()

    def expect(self, weights: Mapping[str, float]) -> None:
        """Of no matter: what is compared are movements alone."""

    def accept(self) -> None:
        """Empty the window; a movement that is still going on does not enter it again."""
        self._window: deque[str] = deque(maxlen=max(LONGEST, 10 * self.settings.length))
        self._standing: tuple[str, float] | None = None
        self._scores: dict[str, float] = {fsm.action: similarity((), ()) for fsm in self._fsms}

    @property
    def scores(self) -> Mapping[str, float]:
        """Each action's similarity after the last step."""
        return self._scores

    @property
    def window(self) -> tuple[str, ...]:
        """The filtered movements since the last accepted action."""
        return tuple(self._window)

    def misread(self) -> tuple[Misread, ...]:
        """Nothing: similarity says of no single movement what it was."""
        return ()

    def update(self, movement: Movement) -> Prediction | None:
        """Take in the movement of one step; the standing prediction, if any."""
        before = self._standing
        change = self._filter.update(movement)
        if change is not None:
            self._window.append(change.name)
            self._scores = {fsm.action: self._score(fsm) for fsm in self._fsms}
            self._standing = self._winner()
        if self._standing is None:
            return None
        action, score = self._standing
        fresh = before is None or before[0] != action
        return Prediction(movement.t, action, score, self._scores, self.window, fresh)

    def _score(self, fsm: Fsm) -> float:
        settings, first = self.settings, self._window[0]
        if settings.mode == "argmax":
            return self._compare(likeliest_chain(fsm, first, settings.length))
        samples = 1 if settings.mode == "sample" else settings.samples
        chains = (sampled_chain(fsm, first, settings.length, self._source) for _ in range(samples))
        return fsum(map(self._compare, chains)) / samples

    def _compare(self, sample: Sequence[str]) -> float:
        if self.settings.letters == "own":
            return similarity(sample, self.window)
        return similarity([name[0] for name in sample], [name[0] for name in self._window])

    def _winner(self) -> tuple[str, float] | None:
        best = max(self._scores.values(), default=0.0)
        winners = [action for action, score in self._scores.items() if score == best]
        return (winners[0], best) if len(winners) == 1 and best >= self.settings.threshold else None
