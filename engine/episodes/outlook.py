"""What a day says of its hypotheses: which goals are pursued, which episodes explain it best, what is to be done."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping, Sequence
from typing import Generic

from casper.engine.collaboration.collaboration import CollaborativePlan
from casper.engine.episodes.episode import Account, Episode, Needless
from casper.engine.episodes.growing import Growing
from casper.engine.episodes.hypotheses.advancing import Advance
from casper.engine.episodes.hypotheses.hypothesis import Body, Hypothesis, Level, S
from casper.engine.episodes.telling import Teller
from casper.engine.verification.observation import Observed, Seen
from casper.engine.verification.vocabulary import Vocabulary
from casper.kb.terms.terms import Compound


class Outlook(Generic[S]):
    """What can be asked of a day at any time; `day.Day` is how it comes about."""

    _growing: Growing[S]
    _goals: Sequence[str]
    _vocabulary: Vocabulary
    _advance: Advance[S]
    _levels: deque[Level[S]]
    _told: list[Episode]

    @property
    def observations(self) -> Sequence[Seen]:
        """What was observed lately, in order."""
        return tuple(level.seen for level in self._levels if level.seen is not None)

    @property
    def count(self) -> int:
        """How many observations there were since the day began."""
        return self._levels[-1].number

    @property
    def posterior(self) -> Mapping[str, float]:
        """Each goal's probability of being pursued now: open, and not left alone for so long that it was given up."""
        level = self._levels[-1]
        found = dict.fromkeys(self._goals, 0.0)
        for hypothesis in level.hypotheses:
            lacking: dict[int, float] = {}  # by goal: that no instance is of it, or that it was given up
            for body in hypothesis.key:
                alive = self._alive(hypothesis, body)
                shares: dict[int, float] = {}
                for goal, state, share in body.entries:
                    if not body.is_done or not self._growing.is_done(state):
                        shares[goal] = shares.get(goal, 0.0) + share
                for goal, share in shares.items():
                    lacking[goal] = lacking.get(goal, 1.0) * (1 - alive * share)
            for goal, none in lacking.items():
                found[self._goals[goal]] += hypothesis.weight * (1 - none)
        return found

    def _alive(self, hypothesis: Hypothesis[S], body: Body[S]) -> float:
        together = sum(other.owner == body.owner for other in hypothesis.key)
        table = self._advance.idling.alive(together)
        return table[min(self._levels[-1].counts.get(body.owner, 0) - body.touched, len(table) - 1)]

    @property
    def current(self) -> Mapping[str, float]:
        """Each goal's probability that the last action belongs to it; what is lacking to 1 is for a needless one."""
        found = dict.fromkeys(self._goals, 0.0)
        for goal, share in (self._levels[-1].current or {}).items():
            found[self._goals[goal]] = share
        return found

    @property
    def leading(self) -> str | None:
        """The goal that the last action most likely belongs to; None when that is none, or goals tie."""
        shares = sorted((self._levels[-1].current or {}).items(), key=lambda pair: -pair[1])
        if not shares or shares[0][1] <= 1 - sum(share for _, share in shares):
            return None
        is_tie = len(shares) > 1 and shares[0][1] <= shares[1][1] * (1 + 1e-9)
        return None if is_tie else self._goals[shares[0][0]]

    @property
    def episodes(self) -> tuple[Episode, ...]:
        """The episodes of the best hypothesis: those that closed lately by when they ended, then the open ones."""
        return self._teller.account(self._best).episodes

    @property
    def needless(self) -> tuple[Needless, ...]:
        """What served no goal lately, by the best hypothesis."""
        return self._teller.account(self._best).needless

    def best(self, count: int = 1) -> list[Account]:
        """The heaviest hypotheses, each as the row of episodes that explains it best."""
        return [self._teller.account(hypothesis) for hypothesis in self._levels[-1].hypotheses[: max(count, 0)]]

    def closed(self) -> list[Episode]:
        """The episodes that closed since the last call, each told once: as soon as the hypotheses agree on it.

        An episode on which they do not agree is told after ``bounds.lag`` observations, with the outcome "unclear" if
        most of the weight is against it.
        """
        told, self._told = self._told, []
        return told

    @property
    def frontier(self) -> tuple[Compound, ...]:
        """What the best hypothesis leaves to be done: of the goal that was touched last first."""
        instances = reversed(self._best.instances)
        states = [instance.body.entries[0].state for instance in instances]
        return tuple(action for state in states for action in self._growing.rest(state))

    def plan_for(self, agent: str) -> CollaborativePlan | None:
        """What the agent can do for an open goal of the best hypothesis: the one touched last of which it can do any.

        None when nothing is open.
        """
        states = [instance.body.entries[0].state for instance in reversed(self._best.instances)]
        plans = [self._growing.part(state, agent) for state in states]
        made = [plan for plan in plans if plan is not None]
        return next((plan for plan in made if plan.actions), made[0] if made else None)

    def reasons(self, observed: Observed, agent: str | None = None) -> dict[str, tuple[str, ...]]:
        """Why each open goal of the best hypothesis cannot take this action next; none of a goal that can."""
        seen = self._vocabulary.read(observed)
        foreign = self._vocabulary.foreign(seen)
        found: dict[str, tuple[str, ...]] = {}
        for instance in self._best.instances:
            goal, state, _ = instance.body.entries[0]
            if foreign is not None:
                found[self._goals[goal]] = foreign.reasons
            elif not self._growing.steps(state, seen, agent):
                found[self._goals[goal]] = tuple(self._growing.reasons(state, seen, agent))
        return found

    @property
    def rejected(self) -> dict[str, tuple[str, ...]]:
        """The goals that are neither open nor begin with the last action, and why it cannot be their first."""
        level = self._levels[-1]
        if level.seen is None:
            return {}
        pursued, current = self.posterior, self.current
        out = [goal for goal, label in enumerate(self._goals) if not pursued[label] and not current[label]]
        if level.foreign is not None:
            return {self._goals[goal]: level.foreign.reasons for goal in out}
        begun = [(goal, self._growing.begin(goal)) for goal in out]
        told = [(goal, self._growing.reasons(state, level.seen, level.agent)) for goal, state in begun]
        return {self._goals[goal]: tuple(reasons) for goal, reasons in told}

    @property
    def is_exact(self) -> bool:
        """Whether nothing was dropped lately."""
        return self.left_out == 0.0

    @property
    def left_out(self) -> float:
        """The share of the weight that was dropped lately: each time of what there was then, added up.

        It says how much was left out when it was, not what would have become of it.
        """
        return min(1.0, sum(level.dropped for level in self._levels))

    @property
    def states(self) -> int:
        """How many hypotheses are kept."""
        return len(self._levels[-1].hypotheses)

    @property
    def _best(self) -> Hypothesis[S]:
        return self._levels[-1].hypotheses[0]

    @property
    def _teller(self) -> Teller[S]:
        return Teller(self._growing, self._levels)
