"""The forward algorithm over the same FSMs: how likely each action is to have happened by now.

What is seen is the classifier's answer, which the emission table says how far to trust: the raw movement of each
step is taken in, since the model itself does what the mode filter does for Ratcliff-Obershelp.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Mapping

from casper.engine.actions.fsm import Fsm
from casper.engine.actions.hmm_model import HmmModel
from casper.engine.actions.prediction import ActionSettings, Prediction
from casper.engine.movements.movements import Movement, MovementFilter
from casper.engine.settings import Rows, number, require
from casper.kb.errors import DomainError

Emission = Mapping[str, Mapping[str, float]]
_NEGLIGIBLE = 1e-7
SURE = 0.65  # the share from which a loop is surely going on
ROUNDS = 0.3  # of the mean time of its movements together for which it must
SMOOTHED = 0.5  # of what is taken wrongly a step at a time is right with what came later known
SHOWN = 100  # movements of the window that is shown: of hours without an action only the last


def read_emission(rows: Rows, movements: tuple[str, ...], error: float) -> Emission:
    """Facts ``emission(True, Seen, P)``; without any, ``error`` is spread evenly over the other movements.

    A movement that is seen and never emitted, by a table, gets a small chance, so that it cannot rule out
    everything.

    Raises:
        DomainError: an unknown movement, a row that is missing or does not add up to 1.
    """
    even = {
        true: {seen: 1.0 - error if seen == true else error / (len(movements) - 1) for seen in movements}
        for true in movements
    }
    table: dict[str, dict[str, float]] = {}
    for true, seen, p in rows("emission", 3):
        require(true in even and seen in even, f"emission({true}, {seen}, {p}) names a movement no transition has")
        table.setdefault(true, {})[seen] = number(p, f"emission({true}, {seen}, {p})")
    if not table:
        return even
    for true in movements:
        row = table.get(true, {})
        require(
            abs(sum(row.values()) - 1.0) < 0.02,
            f"emission({true}, …) adds up to {sum(row.values()):g}, not 1",
        )
    return {true: {seen: max(table[true].get(seen, 0.0), 1e-3) for seen in movements} for true in movements}


class HmmRecogniser:
    """The online recogniser: a prediction stands while one action has happened with ``certainty``.

    An action has happened when its cycle is complete. After an accepted action the belief about the movement
    stays and that about the action begins anew; an accepted loop (Use) may go on without counting again.

    Raises:
        DomainError: at construction, for an action without a cycle.
    """

    def __init__(self, settings: ActionSettings, fsms: tuple[Fsm, ...], emission: Emission) -> None:
        require(bool(fsms), "no action has transitions, so none can be recognised")
        for fsm in fsms:
            if not fsm.cycle:
                raise DomainError(f"{fsm.action} needs cycle({fsm.action}, N, Movement) facts to be recognised by hmm")
        self.settings = settings
        self._fsms = {fsm.action: fsm for fsm in fsms}
        self._emission = emission
        self._smoothed = {
            true: {seen: SMOOTHED * (seen == true) + (1 - SMOOTHED) * p for seen, p in row.items()}
            for true, row in emission.items()
        }
        self._model = HmmModel(settings, fsms)
        self._filter = MovementFilter(settings.filter_window)
        self.reset()

    def reset(self) -> None:
        """Forget everything."""
        self._filter.reset()
        self._window: deque[str] = deque(maxlen=SHOWN)
        self._belief = dict(self._model.initial)
        self._t: float | None = None
        self._standing: str | None = None
        self._candidate, self._run = "", 0
        self._going: tuple[str | None, float] = (None, 0.0)  # the loop that is surely going on, and since when
        self._scores = dict.fromkeys(self._fsms, 0.0)

    @property
    def scores(self) -> Mapping[str, float]:
        """The probability of each action to have happened, after the last step."""
        return self._scores

    @property
    def underway(self) -> Mapping[str | None, float]:
        """The probability of each action to be going on or to have happened; None stands for no action."""
        shares: dict[str | None, float] = dict.fromkeys((None, *self._fsms), 0.0)
        for index, p in self._belief.items():
            state = self._model.states[index]
            shares[state.action if state.progress >= 0 else None] += p
        return shares

    @property
    def window(self) -> tuple[str, ...]:
        """The last filtered movements since the last accepted action (shown; the belief does not use them)."""
        return tuple(self._window)

    def update(self, movement: Movement) -> Prediction | None:
        """Take in the movement of one step; the standing prediction, if any.

        Raises:
            DomainError: a movement no FSM knows.
        """
        change = self._filter.update(movement)
        if change is not None:
            self._window.append(change.name)
        if movement.shares is None:
            self._forward(movement.t, {movement.name: 1.0}, self._emission)
        else:
            self._forward(movement.t, movement.shares, self._smoothed)
        self._scores = self._happened()
        if movement.shares is not None:
            self._last_long(movement.t)
        before, self._standing = self._standing, self._confirmed()
        action = self._standing
        if action is None:
            return None
        score = self._scores[action]
        return Prediction(movement.t, action, score, self._scores, self.window, before != action)

    def accept(self) -> None:
        """Begin anew behind the standing action; what movement is going on stays believed."""
        after = self._fsms[self._standing] if self._standing is not None else None
        belief: dict[int, float] = {}
        for index, p in self._belief.items():
            state = self._model.after(after, self._model.states[index].movement)
            belief[state] = belief.get(state, 0.0) + p
        self._belief = belief
        self._window.clear()
        self._standing, self._candidate, self._run = None, "", 0
        self._going = None, 0.0
        self._scores = dict.fromkeys(self._fsms, 0.0)

    def _last_long(self, t: float) -> None:
        """A loop that is surely going on, for as long as it takes, has happened though rounds of it were not made out.

        For those who are not sure of every movement only: of short ones some are missed.
        """
        underway = self.underway
        going = next((a for a in self._fsms if underway[a] >= SURE and self._fsms[a].loop), None)
        if going is None or going != self._going[0]:
            self._going = going, t
        elif t - self._going[1] >= ROUNDS * len(self._fsms[going].cycle) * self.settings.lasts:
            self._scores = {**self._scores, going: max(self._scores[going], underway[going])}

    def _confirmed(self) -> str | None:
        """The action that has been certain for long enough: a single misread step should not decide."""
        best = max(self._scores, key=self._scores.__getitem__)
        if self._scores[best] < self.settings.certainty:
            best = ""
        self._run = self._run + 1 if best and best == self._candidate else 1
        self._candidate = best
        return best if best and self._run >= self.settings.confirm else None

    def _forward(self, t: float, shares: Mapping[str, float], emission: Emission) -> None:
        """Predict with the model, weigh with the emission of what was seen, or may have been, and normalise.

        States of no weight are dropped.
        """
        states, expected = self._model.states, self._predicted(t)
        try:
            likelihood = {
                name: sum(row[seen] * share for seen, share in shares.items()) for name, row in emission.items()
            }
        except KeyError as unknown:
            raise DomainError(f"no transition of any action knows the movement {unknown.args[0]}") from None
        weighed = {index: p * likelihood[states[index].movement] for index, p in expected.items()}
        total = sum(weighed.values())
        least = total * _NEGLIGIBLE
        self._belief = {index: p / total for index, p in weighed.items() if p > least}

    def _predicted(self, t: float) -> dict[int, float]:
        """The belief before anything is seen at ``t``: movements last, or change along the arcs."""
        before, self._t = self._t, t
        if before is None:
            return self._belief
        stay = math.exp(-max(t - before, 0.0) / self.settings.lasts)
        arcs, change = self._model.arcs, 1.0 - stay
        expected = {index: p * stay for index, p in self._belief.items()}
        for index, p in self._belief.items():
            moved = p * change
            if moved > _NEGLIGIBLE:
                for to, chance in arcs[index]:
                    expected[to] = expected.get(to, 0.0) + moved * chance
        return expected

    def _happened(self) -> dict[str, float]:
        scores = dict.fromkeys(self._fsms, 0.0)
        complete = self._model.complete
        for index, p in self._belief.items():
            if (action := complete[index]) is not None:
                scores[action] += p
        return scores
