"""What hypotheses are told as: episodes, with their trees, and needless actions."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Generic, TypeVar

from casper.engine.episodes.episode import Account, Episode, Needless
from casper.engine.episodes.growing import Growing
from casper.engine.episodes.hypotheses.agreeing import contradicts, numbers
from casper.engine.episodes.hypotheses.hypothesis import Closed, Hypothesis, Instance, Level, Link, Outcome

S = TypeVar("S")


class Teller(Generic[S]):
    """Tells what the levels that are kept hold."""

    def __init__(self, growing: Growing[S], levels: Sequence[Level[S]]) -> None:
        self._growing, self._levels = growing, levels

    def account(self, hypothesis: Hypothesis[S]) -> Account:
        """A hypothesis as a row of episodes."""
        own = [*(c.link for c in hypothesis.closed), *(instance.links[0] for instance in hypothesis.instances)]
        taken = {at for link in own for at in numbers(link)}  # a hypothesis may know better than what was told
        settled = [closed for closed in self._levels[-1].told if not contradicts(closed, taken)]
        told = [self.closed(closed) for closed in (*settled, *hypothesis.closed)]
        told.sort(key=lambda episode: episode.observations[-1])
        under_way = [self._under_way(instance) for instance in hypothesis.instances]
        under_way.sort(key=lambda episode: episode.observations[0])
        whole = sum(other.weight for other in self._levels[-1].hypotheses)
        shares = hypothesis.weight / whole, hypothesis.best / whole
        return Account((*told, *under_way), self._needless(hypothesis), *shares)

    def closed(self, closed: Closed[S]) -> Episode:
        """An episode that is over."""
        return self._episode(closed.goal, closed.owner, closed.outcome, closed.link, closed.left)

    def _under_way(self, instance: Instance[S]) -> Episode:
        goal, state, _ = instance.body.entries[0]
        left = self._growing.least_left(state)
        return self._episode(goal, instance.body.owner, None, instance.links[0], left)

    def _episode(self, goal: int, owner: str | None, outcome: Outcome | None, link: Link[S], left: int) -> Episode:
        links = link.all()
        history = [each.taken for each in links]
        missed = sum(taken.step.missed for taken in history)
        if outcome == "finished":
            missed, left = missed + left, 0
        return Episode(
            self._growing.goals[goal],
            owner,
            outcome,
            links[0].event.t,
            link.event.t,
            len(links),
            missed,
            tuple(each.number for each in links),
            self._growing.goal_of(link.step.state),
            left,
            partial(self._growing.tree, goal, history),
        )

    def _needless(self, hypothesis: Hypothesis[S]) -> tuple[Needless, ...]:
        levels = {level.number: level for level in self._levels}
        found: list[Needless] = []
        for number in hypothesis.needless:
            level = levels.get(number)
            if level is not None and level.seen is not None:
                found.append(Needless(number, level.seen, level.agent, level.t, level.foreign))
        return tuple(found)
