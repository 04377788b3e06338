"""The forward algorithm over the same FSMs: how likely each action is to have happened by now.

What is seen is the classifier's answer, which the emission table says how far to trust: the raw movement of each
step is taken in, since the model itself does what the mode filter does for Ratcliff-Obershelp.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Mapping
from math import fsum
from typing import NamedTuple

from casper.engine.actions.durations import Duration
from casper.engine.actions.forward import Belief, Forward
from casper.engine.actions.fsm import Fsm, movements_of
from casper.engine.actions.hmm_model import HmmModel
from casper.engine.actions.misread import Trail, logarithms
from casper.engine.actions.prediction import ActionSettings, Misread, Prediction
from casper.engine.movements.movements import Movement, MovementFilter
from casper.engine.settings import Rows, number, require
from casper.kb.errors import DomainError

Emission = Mapping[str, Mapping[str, float]]
SURE = 0.65  # the share from which a loop is surely going on
ROUNDS = 0.3  # of the mean time of its movements together for which it must
SMOOTHED = 0.5  # of what is taken wrongly a step at a time is right with what came later known
LEAST = 1e-3  # likelihood of a movement of which nothing was learned
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


class _Evidence(NamedTuple):
    """What one step says: how likely what was seen is by state and phase, and its logarithm by movement."""

    weights: Belief
    logarithms: Mapping[str, float]


class HmmRecogniser:
    """The online recogniser: a prediction stands while one action has happened with ``certainty``.

    An action has happened when its cycle is complete. After an accepted action the belief about the movement
    stays and that about the action begins anew; an accepted loop (Use) may go on without counting again.

    Raises:
        DomainError: at construction, for an action without a cycle.
    """

    def __init__(
        self,
        settings: ActionSettings,
        fsms: tuple[Fsm, ...],
        emission: Emission,
        durations: Mapping[str, Duration] | None = None,
        planned: frozenset[str] = frozenset(),
    ) -> None:
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
        self._every = durations or {name: Duration(settings.lasts) for name in movements_of(fsms)}
        self._plain, self._planned = HmmModel(settings, fsms), planned
        self._filter = MovementFilter(settings.filter_window)
        self.reset()

    def reset(self) -> None:
        """Forget everything."""
        self._filter.reset()
        self._window: deque[str] = deque(maxlen=SHOWN)
        self._use(self._plain)
        self._believe(self._model.initial)
        self._trail.begin(self._model.initial)
        self._weights: Mapping[str, float] = {}
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
        return dict.fromkeys((None, *self._fsms), 0.0) | self._steps.underway(self._belief)

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
        if movement.shares is not None:
            self._doubt()
        self._forward(movement)
        self._scores = self._happened()
        if movement.shares is not None:
            underway = self.underway
            self._last_long(movement.t, underway)
            self._scores = self._expected(underway)
        before, self._standing = self._standing, self._confirmed()
        action = self._standing
        if action is None:
            return None
        score = self._scores[action]
        return Prediction(movement.t, action, score, self._scores, self.window, before != action)

    def accept(self) -> None:
        """Begin anew behind the standing action; what movement is going on stays believed."""
        after = self._fsms[self._standing] if self._standing is not None else None
        phases, belief, start = self._steps.phases, dict[int, float](), dict[int, float]()
        for key, p in self._believed():
            index, phase = divmod(key, phases)
            state = self._model.after(after, self._model.states[index].movement)
            belief[state * phases + phase] = belief.get(state * phases + phase, 0.0) + p
            start[state] = start.get(state, 0.0) + p
        self._belief = self._steps.belief(belief)
        self._trail.begin(start)
        self._window.clear()
        self._standing, self._candidate, self._run = None, "", 0
        self._going = None, 0.0
        self._scores = dict.fromkeys(self._fsms, 0.0)

    def expect(self, weights: Mapping[str, float]) -> None:
        """See `ActionRecogniser`."""
        self._weights = weights

    def _doubt(self) -> None:
        """From now on movements are not sure: what was done stays done."""
        if self._model is self._plain and self._planned:
            phases, before, belief = self._steps.phases, list(self._believed()), dict[int, float]()
            self._use(HmmModel(self.settings, tuple(self._fsms.values()), self._planned))
            for key, p in before:
                at = self._model.number(self._plain.states[key // phases])
                if at is not None:
                    belief[at * phases + key % phases] = p
            if belief:
                self._belief = self._steps.belief(belief)
            else:
                self._believe(self._model.initial)

    def _use(self, model: HmmModel) -> None:
        self._model = model
        self._trail = Trail(model, self._every)
        self._steps = Forward(model, self._every)
        self._said: dict[str, _Evidence] = {}

    def _believe(self, shares: Mapping[int, float]) -> None:
        """Movements that begin, by state."""
        self._belief = self._steps.belief({index * self._steps.phases: p for index, p in shares.items()})

    def _believed(self) -> Iterator[tuple[int, float]]:
        return ((key, p) for key, p in enumerate(self._belief) if p > 0.0)

    def _expected(self, underway: Mapping[str | None, float]) -> dict[str, float]:
        """The scores as they are when what begins is not all alike: each action has its weight, no action has 1."""
        weights, scores = self._weights, self._scores
        if not weights:
            return dict(scores)
        total = self._weight(underway)
        return {a: score * weights.get(a, 1.0) / total for a, score in scores.items()} if total > 0.0 else dict(scores)

    def _weight(self, underway: Mapping[str | None, float]) -> float:
        return fsum([share * self._weights.get(a or "", 1.0) for a, share in underway.items()])

    def _last_long(self, t: float, underway: Mapping[str | None, float]) -> None:
        """A loop that is surely going on, for as long as it takes, has happened though rounds of it were not made out.

        For those who are not sure of every movement only: of short ones some are missed. How sure it is depends on what
        is expected, too.
        """
        sure = SURE * self._weight(underway)
        loops = (a for a in self._fsms if self._fsms[a].loop)
        going = next((a for a in loops if underway[a] * self._weights.get(a, 1.0) >= sure), None)
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

    def _forward(self, movement: Movement) -> None:
        """Predict with the model, and weigh with the likelihood of what was seen (`engine.actions.forward`)."""
        said = self._evidence(movement)
        self._trail.add(movement.t, movement.name, said.logarithms)
        before, self._t = self._t, movement.t
        if before is None:
            self._belief = self._steps.seen(self._belief, said.weights)
        else:
            self._belief = self._steps.step(self._belief, max(movement.t - before, 0.0), said.weights)

    def _evidence(self, movement: Movement) -> _Evidence:
        """What a step says; of a movement that is sure the same each time."""
        if movement.shares is not None or movement.likelihoods is not None:
            return self._evidence_of(self._likelihood(movement))
        said = self._said.get(movement.name)
        if said is None:
            said = self._said[movement.name] = self._evidence_of(self._likelihood(movement))
        return said

    def _evidence_of(self, likelihood: Mapping[str, float]) -> _Evidence:
        return _Evidence(self._steps.weights(likelihood), logarithms(likelihood))

    def _likelihood(self, movement: Movement) -> Mapping[str, float]:
        """How likely what was seen is for each movement: as learned, or by the emission of what it was taken for."""
        if movement.likelihoods is not None:
            return {name: movement.likelihoods.get(name, LEAST) for name in self._emission}
        shares = {movement.name: 1.0} if movement.shares is None else movement.shares
        emission = self._emission if movement.shares is None else self._smoothed
        try:
            return {name: fsum([row[seen] * share for seen, share in shares.items()]) for name, row in emission.items()}
        except KeyError as unknown:
            raise DomainError(f"no transition of any action knows the movement {unknown.args[0]}") from None

    def misread(self) -> tuple[Misread, ...]:
        """Of what was seen since the last action, what was probably something else, if the standing one happened."""
        return self._trail.misread(self._standing) if self._standing is not None else ()

    def _happened(self) -> dict[str, float]:
        return dict.fromkeys(self._fsms, 0.0) | self._steps.happened(self._belief)
