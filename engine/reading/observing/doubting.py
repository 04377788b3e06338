"""Actions where a tracker is not sure of what it tells: what each may have been about, weighed, and what is used up.

In: what every step says. Out: observations with likelihoods, which the reading weighs (`judged`).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import fsum

from casper.engine.actions.happening import Happening, Spot
from casper.engine.actions.prediction import Prediction
from casper.engine.collaboration.acting import DOUBTFUL
from casper.engine.perception.about import about_nearby
from casper.engine.perception.focus import Focus
from casper.engine.perception.world import Doubt, WorldState
from casper.engine.reading.observing.stating import Stating
from casper.engine.reading.reading import Reading
from casper.engine.verification.doubtful import Judged, judged
from casper.engine.verification.observation import Seen
from casper.engine.verification.verification import Statement
from casper.kb.terms.terms import Compound, Variable

RUNNER_UP = 0.05  # of the winner's score from which another action may have been the one
WALKS = 0.5  # probability from which somebody is on their way
EXPECTED = 1.0 - DOUBTFUL  # probability of a step to be still to come from which what is gone says that it was done


class Doubting:
    """Of one partner.

    Args:
        stating: what puts actions into context.
        skills: by what actions are called in their contexts, what they are recognised as.
        consuming: rows of ``consumes(Action)``: after it its target is gone.
    """

    def __init__(self, stating: Stating, skills: Mapping[str, str], consuming: Iterable[tuple[str]]) -> None:
        self.stating, self.skills = stating, skills
        self.consuming = [action for (action,) in consuming]
        self._happening = Happening()
        self._lay: tuple[str, Mapping[Spot, float]] | None = None  # what was handled, and where it lies

    def note(
        self, scores: Mapping[str, float], focus: Focus, handled: str | None, world: WorldState, doubt: Doubt
    ) -> None:
        """One step: ``scores`` of actions, what was ``handled`` lately."""
        here = about_nearby(focus, handled, world.agents[self.stating.partner], world)
        self._happening.note(scores, here, doubt.moves > WALKS)
        if handled is not None and handled in world.objects and any(target == handled for target, _ in here):
            self._lay = handled, here

    def accepted(self) -> None:
        """What was made out happened: begin anew."""
        self._happening.reset()

    def judged(self, prediction: Prediction) -> Judged | None:
        """What seems to have happened, about whatever it may have been about; None while that is not known.

        What else may have happened instead is not forgotten.
        """
        stated: dict[Statement, float] = {}
        for action, score in prediction.scores.items():
            if score >= RUNNER_UP * prediction.score:
                found = self._stated(prediction.t, action, self._happening.of(action))
                if action == prediction.action and not found:
                    return None
                stated |= {statement: share * score for statement, share in found.items()}
        return judged(stated, self.stating.verifier, self.stating.actions) if stated else None

    def is_gone(self, world: WorldState) -> bool:
        """Whether what was handled last is there no more."""
        return self._lay is not None and self._lay[0] not in world.objects

    def used_up(self, world: WorldState, frontiers: Mapping[tuple[Compound, ...], float]) -> Judged | None:
        """The step that uses up what was handled last and is gone, where it is not sure that it was seen already.

        Steps before it may have gone unseen: what is gone was used up, whatever else was done.

        Args:
            world: the moment.
            frontiers: the probability of all that is yet to be done (`Reading.frontiers`).
        """
        if self._lay is None:
            return None
        thing, here = self._lay
        self._lay = None
        for action in self.consuming:
            share = fsum([p for leaves, p in frontiers.items() if any(_uses(leaf, action, thing) for leaf in leaves)])
            if share > EXPECTED:
                there = {spot: p for spot, p in here.items() if spot[0] == thing}
                found = self._stated(world.t, self.skills.get(action, action), there)
                stated = {statement: p for statement, p in found.items() if statement.action == action}
                return judged(stated, self.stating.verifier, self.stating.actions) if stated else None
        return None

    def _stated(self, t: float, action: str, shares: Mapping[Spot, float]) -> dict[Statement, float]:
        stated: dict[Statement, float] = {}
        for (target, place), share in shares.items():
            meant = self.stating.meaning(action, place)
            if meant is not None and target is not None:
                statement = Statement(t, self.stating.partner, meant, target, place)
                stated[statement] = stated.get(statement, 0.0) + share
        return stated


def _uses(leaf: Compound, action: str, thing: str) -> bool:
    """Whether a step is that action on a thing, as far as its target is known."""
    return leaf.functor == action and (not leaf.args or leaf.args[0] == thing or isinstance(leaf.args[0], Variable))


def keeps_goal(reading: Reading, seen: Seen) -> bool:
    """Whether the goal that is likeliest stays so with one more action, if any is."""
    before = _likeliest(reading)
    reading.observe(seen)
    after = _likeliest(reading)
    reading.undo()
    return before is None or before == after


def _likeliest(reading: Reading) -> str | None:
    goal, share = max(reading.posterior.items(), key=lambda pair: pair[1], default=("", 0.0))
    return goal if share > 0.0 else None
