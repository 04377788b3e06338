"""From a prediction to an observation: what it says, whether that is valid, and what it is taken for until it is seen.

A statement that is refused is told once, not with every step that says it again.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator, Sequence
from dataclasses import replace

from casper.engine.actions.prediction import Misread, Prediction
from casper.engine.events import Event
from casper.engine.perception.about import About
from casper.engine.perception.perception import Relations
from casper.engine.perception.world import WorldState
from casper.engine.reading.observing.stages import action_event, verdict_event
from casper.engine.reading.observing.stating import Stating
from casper.engine.verification.assumed import Assumed, assumed
from casper.engine.verification.doubtful import Judged
from casper.engine.verification.history import Done
from casper.engine.verification.observation import Observation, Seen
from casper.engine.verification.verification import Statement, Verifier
from casper.kb.reasons.validity import Verdict

Misreadings = Callable[[], Sequence[Misread]]


class Judging:
    """Of one partner.

    Args:
        stating: puts actions into context; its verifier judges them, or takes all for valid, by name, where it is None.
        carrying: the plans' actions that bring a thing to a place.

    Attributes:
        earlier: what was done before the last action, as far as rules look back.
        assumed: where the last action is done, while nobody has seen that yet.
    """

    def __init__(self, stating: Stating, carrying: Sequence[str]) -> None:
        self.stating, self.carrying = stating, carrying
        self.verifier: Verifier | None = stating.verifier
        self.earlier: Sequence[Done] = ()
        self.assumed: Assumed | None = None
        self._accepted: Observation | None = None  # the last action
        self._refused: str | None = None  # the statement that was refused last

    def of(
        self, prediction: Prediction, about: About, world: WorldState, misread: Misreadings
    ) -> Generator[Event, None, Observation | None]:
        """The observation that a prediction amounts to; None where it is refused, or not yet known what it means.

        Args:
            prediction: the action.
            about: with what it may have been done, and where.
            world: the moment.
            misread: the movements that were probably misread.
        """
        before = self.stating.doubt
        statement = self.stating.of(prediction, about, world)
        if statement is None:
            if self.stating.doubt not in ("", before):
                yield Event("warning", prediction.t, {"message": self.stating.doubt})
            return None  # the prediction stands, and the next step may tell
        if str(statement) == self._refused:
            return None
        yield action_event(statement, prediction.score, prediction.t, misread())
        observation = Observation(statement.action, t=prediction.t)
        if self.verifier is not None:
            verdict = self.verifier.judge(statement)
            yield verdict_event(prediction.t, verdict)
            if not verdict.valid:
                self._refused = str(statement)
                return None
            observation = self._accept(self.verifier, verdict, prediction.t)
        observation = replace(observation, certainty=min(prediction.score, 1.0))
        self._refused, self._accepted = None, observation
        self.assumed = assumed(statement.destination, observation.args or ())
        return observation

    def of_doubt(
        self, found: Judged | None, score: float, t: float, misread: Misreadings
    ) -> Generator[Event, None, Seen | None]:
        """The same of what was judged already, option by option."""
        if found is None or str(found.statement) == self._refused:
            return None
        yield action_event(found.statement, score, t, misread())
        if found.verdict is not None:
            yield verdict_event(t, found.verdict)
        if found.seen is None:
            self._refused = str(found.statement)
            return None
        if self.verifier is not None and found.verdict is not None:
            self._accept(self.verifier, found.verdict, t)
        self._refused = None
        return replace(found.seen, certainty=min(score, 1.0)) if isinstance(found.seen, Observation) else found.seen

    def _accept(self, verifier: Verifier, verdict: Verdict, t: float) -> Observation:
        self.earlier = tuple(verifier.looked_at)
        return verifier.accept(verdict, t)

    def brought(self, thing: str, place: str, t: float) -> Iterator[Observation]:
        """The actions by which a thing may have come to a place where nobody saw it brought."""
        for action in self.carrying:
            statement = Statement(t, self.stating.partner, action, thing, place)
            if self.verifier is None or self.verifier.judge(statement).valid:
                yield Observation(action, (thing, place), t)

    def put_elsewhere(self, relations: Relations, world: WorldState) -> tuple[Observation, Assumed] | None:
        """The last action and where it was taken to be done, once its thing was put down, and not there."""
        made, action = self.assumed, self._accepted
        was_put = None if made is None else made.update(relations, world)
        if made is None or action is None or was_put is None:
            return None
        self.assumed = None
        return None if was_put else (action, made)
