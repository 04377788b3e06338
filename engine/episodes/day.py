"""A day: what a partner's actions say about their goals, one after the other, several at once, or given up.

    >>> day = Domain.load("kitchen").day()
    >>> day.observe("pick_and_place(meal, hobs)")
    >>> day.current["lunch"]
    1.0
"""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Iterator, Mapping
from copy import copy
from dataclasses import replace
from difflib import get_close_matches
from typing import Any

from casper.engine.episodes.episode import Episode
from casper.engine.episodes.growing import Growing
from casper.engine.episodes.hypotheses.advancing import Advance
from casper.engine.episodes.hypotheses.growth import Bounds
from casper.engine.episodes.hypotheses.hypothesis import Event, Level, S, nothing
from casper.engine.episodes.outlook import Outlook
from casper.engine.episodes.prices import Prices
from casper.engine.episodes.printing import day_lines, day_name
from casper.engine.verification.observation import Observed
from casper.engine.verification.vocabulary import Vocabulary
from casper.kb.errors import CasperError
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import as_term
from casper.kb.text.lines import Line, Shown, text_of

AS_IT_WERE: Bounds = Bounds()


class Day(Outlook[S], Shown):
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

    # --- shown -----------------------------------------------------------------------------------------------------

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
