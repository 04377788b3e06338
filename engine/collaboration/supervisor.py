"""The supervisor (paper section III-G): commits to a goal, holds the collaborative plan, and says when to act.

What was announced holds until it is done, changed by another ``plan``, or withdrawn: then the robot does not do it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from casper.engine.collaboration.acting import ActingSettings, sureness
from casper.engine.collaboration.collaboration import CollaborativePlan
from casper.engine.collaboration.commitment import NOTHING, Commitment, where
from casper.engine.collaboration.reads import Reads
from casper.engine.events import Event
from casper.engine.events.telling import sentence, will_do
from casper.engine.explanation.explanation import Explanation, Interleaved
from casper.engine.verification.observation import certainty_of
from casper.kb.terms.terms import Compound

LIKELY = ActingSettings()
NEEDED = 2 / 3  # probability from which a part of the robot is worth doing, where it may have been done


class Supervisor:
    """Turns a reading's outcome into a plan and keeps the plan in step with what the partner does.

    ``robot`` None watches only: goals are predicted, nothing is planned. ``acting`` says how sure a goal must be before
    anything is announced. ``doubts``: the sensor is poor, and shares of all explanations decide which goal is believed
    in, and whether the robot's turn has come; else the reading's policy does.
    """

    def __init__(self, reading: Reads, robot: str | None, acting: ActingSettings = LIKELY) -> None:
        self.reading, self.robot, self.acting = reading, robot, acting
        self.commitment: Commitment | None = None
        self.waiting: tuple[Compound, ...] = ()
        self.actions: tuple[Compound, ...] = ()
        self.done: list[Compound] = []  # of what was announced, by the robot
        self.given_up: set[Compound] = set()  # what the robot could not do, and announces no more
        self.is_withdrawn = False  # what was announced last was taken back
        self.doubts = False
        self.is_instead = False  # another goal that was believed in must have been given up for this one
        self._made: CollaborativePlan | None = None  # the last one that was announced
        self._said = ""  # the last sentence about what the robot does now

    @property
    def ready(self) -> bool:
        """Whether the robot's turn has come: there is something to do and nothing left to wait for."""
        return bool(self.actions) and not self.waiting

    @property
    def left(self) -> tuple[Compound, ...]:
        """What the robot still has to do of what it announced: an action that is there twice is done twice."""
        left = list(self.actions)
        for action in self.done:
            if action in left:
                left.remove(action)
        return tuple(left)

    def did(self, action: Compound) -> None:
        """The robot has done one of the actions it announced."""
        self.done.append(action)

    def gives_up(self, action: Compound) -> None:
        """The robot could not do an action: it does no more of what it announced, and never announces that again."""
        self.given_up.add(action)
        self.waiting, self.actions = (), ()

    def goes_on(self, t: float) -> list[Event]:
        """The robot has done a part that the plan leaves to it alone, and others were waiting for: what it does next.

        Nothing when its part was the last one; then the goal is reached.
        """
        made = self.commitment
        explanation = None if made is None else self.reading.best_of(made.goal)
        if made is None or explanation is None or self.robot is None:
            return []
        plan = self.reading.next_part(self.robot, explanation, made.plan)
        if plan is None:
            return []
        self.commitment = replace(made, explanation=explanation, plan=plan)
        return list(self._announce(plan, t))

    def update(self, t: float) -> Iterator[Event]:
        """Look at the reading after an observation; yields ``prediction`` and ``plan`` events where things changed."""
        goal = self._outcome
        changed = goal is not None and (self.commitment is None or self.commitment.goal != goal)
        if goal is not None and changed and self.sureness_of(goal) >= self.acting.certainty:
            yield from self._commit(goal, t)
        elif self.commitment is not None:
            yield from self._follow(self.commitment, t)

    def sureness_of(self, goal: str) -> float:
        """How sure a goal is (`acting`): by its posterior, and by what its best explanation uses and takes for unseen.

        Of a poor sensor it is no news that actions went unseen.
        """
        explanation = self.reading.best_of(goal)
        if explanation is None:
            return 0.0
        used = (seen for at, seen in enumerate(self.reading.observations) if at not in explanation.needless)
        unseen = 0 if self.doubts else explanation.missed
        posterior = self.reading.posterior.get(goal, explanation.share)
        return sureness(posterior, map(certainty_of, used), unseen, self.is_instead)

    @property
    def _outcome(self) -> str | None:
        if not self.doubts:
            return self.reading.outcome
        goal, share = max(self.reading.posterior.items(), key=lambda pair: pair[1], default=("", 0.0))
        return goal if share >= self.acting.share else None

    def _is_due(self, plan: CollaborativePlan) -> bool:
        """Where it has nothing to wait for: whether that is sure enough, and whether its part is probably needed."""
        if not self.doubts or plan.waiting or self.robot is None:
            return True
        parts = [(part, share) for part, share in self.reading.plans_for(self.robot).items() if part.goal == plan.goal]
        due = sum(share for part, share in parts if not part.waiting)
        needed = sum(share for part, share in parts if set(plan.actions) <= set(part.actions))
        return due >= self.acting.share and needed >= NEEDED

    def withdraw(self, t: float, because: str) -> Iterator[Event]:
        """Give up what was announced and is not done yet; yields ``withdrawn`` where there is such a thing."""
        left, made = self.left, self._made
        self.waiting, self.actions, self.is_withdrawn = (), (), True
        if left and made is not None:
            yield Event("withdrawn", t, {"agent": made.agent, "goal": made.goal, "because": because})
            if self._said:
                self._said, tell = "", self.reading.tell
                text = tell.phrase("takes back", tell.name(made.agent), because)
                yield Event("says", t, {"agent": made.agent, "goal": made.goal, "text": sentence(text)})

    def summary(self) -> dict[str, Any]:
        """The figures of the prediction, at the moment it was made (paper table "results")."""
        return NOTHING | ({} if self.commitment is None else self.commitment.figures())

    def _commit(self, goal: str, t: float) -> Iterator[Event]:
        explanation = self.reading.best_of(goal)
        if explanation is None:
            return
        plan = self._planned(explanation)
        if self._made is not None and self._made.goal not in explanation.goals:
            yield from self.withdraw(t, self._told("other goal", goal))
        self.commitment = Commitment(goal, t, explanation, plan, len(self.reading.observations))
        observed = len(explanation.marks)
        data = {"goal": goal, "confidence": explanation.share, "certainty": self.sureness_of(goal)}
        data |= {"observed": observed, "missed": explanation.missed}
        yield Event("prediction", t, {**data, "posterior": dict(self.reading.posterior)})
        if self.robot is not None:
            yield from self._announce(plan, t)

    def _planned(self, explanation: Explanation | Interleaved) -> CollaborativePlan:
        plan = self.reading.plan_for(self.robot or "", explanation)
        assert plan is not None
        return plan

    def _follow(self, commitment: Commitment, t: float) -> Iterator[Event]:
        """The partner went on: wait for less, and leave out what they did themselves. Where they took another way than
        was expected the robot's part is made anew."""
        explanation = self.reading.best_of(commitment.goal)
        if self.robot is None:
            return
        if explanation is None:
            yield from self._doubt(t)
            return
        before, now = where(commitment.explanation, commitment.plan), where(explanation, commitment.plan)
        if before is not None and now is not None and before.leads_to(now):
            plan = commitment.plan.after(now)
        else:
            plan = self._planned(explanation)
            self.commitment = replace(commitment, explanation=explanation, plan=plan)
        yield from self._announce(plan, t)

    def _doubt(self, t: float) -> Iterator[Event]:
        """Nothing speaks for the goal any more, and for no other one alone yet."""
        first = self.reading.first
        if self._made is not None and (first is None or self._made.goal not in first.goals):
            yield from self.withdraw(t, self._told("fits not", self._made.goal))

    def _told(self, phrase: str, goal: str) -> str:
        """A sentence about a goal, in the words of the reading."""
        tell = self.reading.tell
        return tell.phrase(phrase, tell.goal(goal))

    def _announce(self, plan: CollaborativePlan, t: float) -> Iterator[Event]:
        if not self.given_up.isdisjoint(plan.actions) or not self._is_due(plan):
            return
        if self._made is None or (plan.waiting, plan.actions) != (self.waiting, self.actions):
            self._made, self.waiting, self.actions = plan, plan.waiting, plan.actions
            self.is_withdrawn = False
            yield Event("plan", t, {**plan.to_json(), "ready": self.ready})
            yield from self._say(plan, t)

    def _say(self, plan: CollaborativePlan, t: float) -> Iterator[Event]:
        """What the robot does now, in a sentence, before it does it."""
        if not self.ready or not self.left:
            return
        text = will_do(self.reading.tell, plan.agent, plan.goal, self.left)
        if text != self._said:
            self._said = text
            yield Event("says", t, {"agent": plan.agent, "goal": plan.goal, "text": text})
