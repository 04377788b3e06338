"""A day: what a partner's actions say about their goals, one after the other, several at once, or given up.

    >>> day = Domain.load("kitchen").day()
    >>> day.observe("pick_and_place(meal, hobs)")
    >>> day.current["lunch"]
    1.0
"""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Iterator, Mapping, Sequence
from copy import copy
from dataclasses import replace
from difflib import get_close_matches
from typing import Any, Generic

from casper.engine.collaboration.collaboration import CollaborativePlan
from casper.engine.episodes.episode import Account, Episode, Needless
from casper.engine.episodes.growing import Growing
from casper.engine.episodes.hypotheses.advancing import Advance
from casper.engine.episodes.hypotheses.growth import Bounds
from casper.engine.episodes.hypotheses.hypothesis import Body, Event, Hypothesis, Level, S, nothing
from casper.engine.episodes.prices import Prices
from casper.engine.episodes.printing import day_lines, day_name
from casper.engine.episodes.telling import Teller
from casper.engine.verification.observation import Observed, Seen
from casper.engine.verification.vocabulary import Vocabulary
from casper.kb.errors import CasperError
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.kb.text.lines import Line, Shown, text_of

AS_IT_WERE: Bounds = Bounds()


class Day(Shown, Generic[S]):
    """Hypotheses about which goals are open, and what became of those that closed.

    Memory and time an observation do not grow with the day: what closed leaves the state, and what was observed more
    than ``bounds.lag`` observations ago cannot be told any more, but for the episodes that `closed` hands out. The last
    ``bounds.undo`` observations can be taken back.

    Args:
        growing: the plans.
        prices: what it costs to begin, give up, add and skip.
        priors: each goal's prior by label; all alike where none are given.
        bounds: how much is kept.
    """

    def __init__(
        self,
        growing: Growing[S],
        prices: Prices | None = None,
        priors: Mapping[str, float] | None = None,
        bounds: Bounds = AS_IT_WERE,
    ) -> None:
        self.prices, self.bounds = prices or Prices(), bounds
        self._growing = growing
        self._goals = growing.goals
        self._numbers = {goal: number for number, goal in enumerate(self._goals)}
        whole = sum((priors or {}).get(goal, 1.0) for goal in self._goals) or 1.0
        self._priors = [(priors or {}).get(goal, 1.0) / whole for goal in self._goals]
        self._vocabulary = Vocabulary(growing.leaves())
        self._advance = Advance(growing, self.prices, self._priors, bounds)
        self._levels: deque[Level[S]] = deque([nothing()], bounds.lag + 1)
        self._told: list[Episode] = []  # closed since the last call

    # --- observing -------------------------------------------------------------------------------------------------

    def observe(
        self,
        observed: Observed,
        t: float | None = None,
        agent: str | None = None,
        goals: Collection[str] | None = None,
    ) -> None:
        """Take in one action: ``"eat"``, ``"eat(biscuits, plate)"``, or likelihoods ``{"eat": 0.7, "sip": 0.2}``.

        An action that no plan has is needless; `needless` tells it with the nearest action of the plans.

        Args:
            observed: what was seen.
            t: when, in seconds; None: episodes tell the number of the observation, and rules know the order only.
            agent: who did it; None: the partner, where there is one only.
            goals: the labels of the goals it is known to serve, none at all where it is known to be needless; None:
                nothing is known.

        Raises:
            ReadError: the text is no action.
            CasperError: likelihoods that are none, or a goal that is none.
        """
        level = self._levels[-1]
        number = level.number + 1
        seen = self._vocabulary.read(observed)
        only = None if goals is None else frozenset(map(self._number_of, goals))
        event = Event(seen, agent, float(number) if t is None else t, number, level.counts.get(agent, 0) + 1, only)
        foreign = self._vocabulary.foreign(seen)
        if foreign is not None:
            after = self._advance.unknown(level, event, foreign)
        else:
            after = self._advance.observed(level, event)
        self._growing.observed(seen, agent, t)
        self._levels.append(after)
        beyond = -2 - self.bounds.undo
        if len(self._levels) >= -beyond:  # nobody goes back as far, and hypotheses are what takes room
            self._levels[beyond] = replace(self._levels[beyond], hypotheses=())
        self._told += [self._teller.closed(closed) for closed in after.settled]

    def _number_of(self, goal: str) -> int:
        if goal not in self._numbers:
            close = get_close_matches(goal, self._numbers, n=1)
            hint = f"did you mean {close[0]}?" if close else f"the goals are {', '.join(self._goals)}"
            raise CasperError(f"{goal} is no goal; {hint}")
        return self._numbers[goal]

    def finish(self) -> None:
        """The day is over: every goal that is open is closed, by what is cheaper to believe of it."""
        level = self._levels.pop()
        self._levels.append(self._advance.over(level))
        self._told += [self._teller.closed(closed) for closed in self._levels[-1].settled]

    def undo(self) -> None:
        """Take back the last observation. What `closed` has handed out stays told.

        Raises:
            CasperError: there is none, or it lies too far back.
        """
        if len(self._levels) < 2 or not self._levels[-2].hypotheses:
            most = min(self.bounds.lag, self.bounds.undo)
            beyond = f"; a day remembers its last {most}" if self._levels[-1].number else ""
            raise CasperError(f"there is no observation to take back{beyond}")
        level = self._levels.pop()
        self._growing.forget()
        untold = {closed.link.number for closed in level.settled}
        self._told = [episode for episode in self._told if episode.observations[-1] not in untold]

    def fork(self) -> Day[S]:
        """A day that goes its own way from here; what was worked out so far is shared."""
        other = copy(self)
        other._growing = self._growing.fork()
        other._advance = Advance(other._growing, self.prices, self._priors, self.bounds)
        other._levels, other._told = self._levels.copy(), self._told.copy()
        return other

    # --- what it says ----------------------------------------------------------------------------------------------

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

    def to_json(self, top: int = 3) -> dict[str, Any]:
        """The object for ``casper explain --changes --json``: the fields of a reading, and what only a day has.

        An explanation is a row of episodes; ``explanations`` are the hypotheses kept, ``outcome`` is `leading`.
        """
        best = self.best(max(top, 1))
        bound: dict[str, Any] = {} if self.is_exact else {"exact": False, "left_out": self.left_out}
        return {
            "observations": [str(seen) for seen in self.observations],
            "explanations": self.states,
            "confidence": best[0].share,
            "outcome": self.leading,
            "posterior": dict(self.posterior),
            "best": [account.to_json() for account in best[:top]],
            "frontier": [term_text(as_term(action)) for action in self.frontier],
            "rejected": [{"goal": goal, "reasons": list(reasons)} for goal, reasons in self.rejected.items()],
            "current": dict(self.current),
            "episodes": [episode.to_json() for episode in best[0].episodes],
            "needless": [needless.to_json() for needless in best[0].needless],
            **bound,
        }

    def lines(self, top: int = 1) -> Iterator[Line]:
        """What a person is shown, with the best ``top`` rows of episodes."""
        return day_lines(self, top)

    def __str__(self) -> str:
        return text_of(self.lines())

    def __repr__(self) -> str:
        return day_name(self)
