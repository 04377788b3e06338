"""What a recognised action says: who did what, with what, where; the likeliest of what comes into question."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable
from dataclasses import dataclass, field

from casper.engine.actions.contexts import Contexts
from casper.engine.actions.prediction import Prediction
from casper.engine.perception.about import About, are_together, beside, is_in_reach
from casper.engine.perception.world import WorldState
from casper.engine.reading.reading import Reading
from casper.engine.verification.history import History
from casper.engine.verification.observation import Observation
from casper.engine.verification.verification import Statement, Verifier
from casper.kb.base import KnowledgeBase
from casper.kb.errors import BudgetExceeded, Undefined


@dataclass
class Stating:
    """Puts the recognised actions of one partner into context.

    ``known`` gives the knowledge base with what was seen by now, ``begun`` a reading in which nothing was observed.
    ``doubt`` is why it is not known what the last action meant, if that is so.
    """

    partner: str
    contexts: Contexts
    history: History
    known: Callable[[], KnowledgeBase]
    verifier: Verifier | None
    begun: Callable[[], Reading]
    actions: Collection[str]
    doubt: str = field(default="", init=False)

    def of(self, prediction: Prediction, about: About, world: WorldState) -> Statement | None:
        """What seems to have happened, put into context: at the first place where it is valid and in some plan, else at
        the first where it is valid, or at the first.

        What is in one place with that comes into question, too. Of two things in one place either may be what is
        handled: where one way round means nothing, or nothing that is valid, the other is taken. What means something
        at a place only is done where one can reach.
        """
        self.doubt = ""
        places = [*about.places, *beside(world, about)]
        there = [(about.target, place) for place in places if about.target is not None]
        if self.contexts.mentions(prediction.action):
            there = [pair for pair in there if any(is_in_reach(world, self.partner, name) for name in pair)]
        turned = [(place, target) for target, place in there if place and are_together(world, target, place)]
        stated = self._statements(prediction, there) or self._statements(prediction, turned)
        if self.verifier is None or len(stated) + len(turned) < 2:
            return stated[0] if stated else None
        valid = self._valid(stated) or self._valid(self._statements(prediction, turned)) or stated[:1]
        return next((s for s in valid if len(valid) > 1 and self._is_of_a_plan(s)), valid[0]) if valid else None

    def _statements(self, prediction: Prediction, pairs: Iterable[tuple[str | None, str | None]]) -> list[Statement]:
        """What the action means with each target and place, where it means something."""
        meant = [(self.meaning(prediction.action, place), target, place) for target, place in pairs]
        return [Statement(prediction.t, self.partner, action, *about) for action, *about in meant if action is not None]

    def _valid(self, stated: Iterable[Statement]) -> list[Statement]:
        return [] if self.verifier is None else [s for s in stated if self.verifier.judge(s).valid]

    def _is_of_a_plan(self, statement: Statement) -> bool:
        """Whether some plan has the very action."""
        if statement.action not in self.actions:
            return False
        reading = self.begun()
        reading.observe(Observation(statement.action, statement.term.args[1:], t=statement.t))
        return reading.count > 0

    def meaning(self, action: str, place: str | None) -> str | None:
        """What an action means at a place; None where that is nothing, or not known, which ``doubt`` tells."""
        try:
            return self.contexts.meaning(action, place, self.known(), self.history)
        except (BudgetExceeded, Undefined) as doubt:
            self.doubt = doubt.sentence
            return None
