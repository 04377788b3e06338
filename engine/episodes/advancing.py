"""From one level of a day to the next: expand, drop the lightest, close what is over, and agree on what closed."""

from __future__ import annotations

import heapq
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

from casper.engine.episodes.agreeing import settle
from casper.engine.episodes.expanding import BEGINS, NEEDLESS, Bounds, Candidate, Expansion
from casper.engine.episodes.growing import Growing, Taken
from casper.engine.episodes.hypotheses import Closed, Hypothesis, Instance, Key, Level, Link, Outcome
from casper.engine.episodes.idling import SOON, Idling
from casper.engine.episodes.prices import Prices
from casper.engine.verification.observation import Seen

S = TypeVar("S")


@dataclass(frozen=True, slots=True)
class Event:
    """An observation with what it is known by: its number (from 1), who did it, and when."""

    seen: Seen
    agent: str | None
    t: float
    number: int


class Advance(Generic[S]):
    """How a day goes on with an observation, under fixed prices, priors and bounds."""

    def __init__(self, growing: Growing[S], prices: Prices, priors: Sequence[float], bounds: Bounds) -> None:
        self.growing, self.prices, self.bounds = growing, prices, bounds
        self._priors, self._idling = priors, Idling(prices.abandon)

    def observed(self, level: Level[S], event: Event) -> Level[S]:
        """The level after an observation that the plans may explain."""
        expansion = Expansion(self.growing, self.prices, self._priors, self._idling, self.bounds)
        expansion.run(level, event.seen, event.agent)
        found = self._lasting(expansion)
        counts = {**level.counts, event.agent: level.counts.get(event.agent, 0) + 1}
        made = [self._made(key, candidate, event) for key, candidate in found]
        dropped = expansion.dropped + sum(c.weight for c in expansion.candidates.values())
        dropped -= sum(candidate.weight for _, candidate in found)
        whole = dropped + sum(candidate.weight for _, candidate in found)
        hypotheses = self._closed(made, expansion, counts, event)
        total = sum(hypothesis.weight for hypothesis in hypotheses)
        current = {goal: weight / whole for goal, weight in expansion.current.items()}
        share = max(0.0, dropped / whole) if len(found) < len(expansion.candidates) or expansion.dropped else 0.0
        return self._level(level, event, counts, [_scaled(h, 1 / total) for h in hypotheses], current, share)

    def unknown(self, level: Level[S], event: Event, nearest: str | None, why: Sequence[str]) -> Level[S]:
        """The level after an action that no plan has: needless by every hypothesis."""
        counts = {**level.counts, event.agent: level.counts.get(event.agent, 0) + 1}
        expansion = Expansion(self.growing, self.prices, self._priors, self._idling, self.bounds)
        made = [_with_needless(h, h.weight, h.best * self.prices.needless, event.number) for h in level.hypotheses]
        hypotheses = self._closed(made, expansion, counts, event)
        total = sum(hypothesis.weight for hypothesis in hypotheses)
        after = self._level(level, event, counts, [_scaled(h, 1 / total) for h in hypotheses], {}, 0.0)
        return Level(**{**after.__dict__, "nearest": nearest, "why": tuple(why)})

    def _level(
        self,
        before: Level[S],
        event: Event,
        counts: Mapping[str | None, int],
        hypotheses: Sequence[Hypothesis[S]],
        current: Mapping[int, float],
        dropped: float,
    ) -> Level[S]:
        lag = self.bounds.lag
        agreed, settled = settle(hypotheses, event.number, lag)
        told = tuple(c for c in (*before.told, *settled) if c.number > event.number - lag)
        recent = [_recent(hypothesis, event.number - lag) for hypothesis in agreed]
        seen, agent, t, number = event.seen, event.agent, event.t, event.number
        return Level(recent, number, counts, seen, agent, t, current, dropped, told, tuple(settled))

    def _lasting(self, expansion: Expansion[S]) -> list[tuple[Key[S], Candidate[S]]]:
        """The candidates that are kept, the heaviest first."""
        candidates = expansion.candidates
        least = self.bounds.floor * max(candidate.weight for candidate in candidates.values())
        found = [pair for pair in candidates.items() if pair[1].weight >= least]
        if len(found) > self.bounds.keep:
            return heapq.nlargest(self.bounds.keep, found, key=lambda pair: pair[1].weight)
        return sorted(found, key=lambda pair: -pair[1].weight)

    # --- making and closing ------------------------------------------------------------------------------------------

    def _made(self, key: Key[S], candidate: Candidate[S], event: Event) -> Hypothesis[S]:
        """The hypothesis with the story of its heaviest derivation."""
        parent, move, at = candidate.parent, candidate.move, candidate.at
        if at == NEEDLESS or move is None:
            return _with_needless(parent, candidate.weight, candidate.best, event.number)
        taken = Taken(move.step, event.seen, event.agent)
        gone = candidate.restarted if at == BEGINS else at
        links, closed = parent.links, parent.closed
        before = links[at] if at != BEGINS else None
        if at == BEGINS and gone is not None:
            closed = (*closed, self._over(parent.instances[gone], links[gone], event.number))
        if gone is not None:
            links = links[:gone] + links[gone + 1 :]
        link = Link(event.number, event.t, taken, before)
        goal = move.instance.goal
        if move.closes:
            closed = (*closed, Closed(goal, move.instance.owner, "finished", link, 0, event.number))
        else:
            links = (*links, link)
        return Hypothesis(key, candidate.weight, candidate.best, links, closed, parent.needless, goal)

    def _closed(
        self,
        hypotheses: Sequence[Hypothesis[S]],
        expansion: Expansion[S],
        counts: Mapping[str | None, int],
        event: Event,
    ) -> list[Hypothesis[S]]:
        """Close what was left alone for too long; what is equal then is one. The heaviest come first."""
        if not any(self._expired(hypothesis.instances, counts, event.agent) for hypothesis in hypotheses):
            return list(hypotheses)
        found: dict[Key[S], Hypothesis[S]] = {}
        for hypothesis in hypotheses:
            expired = self._expired(hypothesis.instances, counts, event.agent)
            left = self._without(hypothesis, expired, expansion, event.number) if expired else hypothesis
            known = found.get(left.instances)
            found[left.instances] = left if known is None else _joined(known, left)
        return sorted(found.values(), key=lambda hypothesis: -hypothesis.weight)

    def _expired(self, instances: Key[S], counts: Mapping[str | None, int], agent: str | None) -> list[int]:
        """The numbers of the agent's instances that are closed now."""
        now = counts.get(agent, 0)
        own = [(at, instance) for at, instance in enumerate(instances) if instance.owner == agent]
        most = len(self._idling.alive(len(own))) if own else 0
        return [at for at, i in own if now - i.touched >= (min(SOON, most) if i.is_done else most)]

    def _without(
        self, hypothesis: Hypothesis[S], expired: Sequence[int], expansion: Expansion[S], number: int
    ) -> Hypothesis[S]:
        factor, closed = 1.0, list(hypothesis.closed)
        for at in expired:
            factor *= expansion.closing(hypothesis.instances[at])
            closed.append(self._over(hypothesis.instances[at], hypothesis.links[at], number))
        kept = [at for at in range(len(hypothesis.instances)) if at not in expired]
        instances = tuple(hypothesis.instances[at] for at in kept)
        links = tuple(hypothesis.links[at] for at in kept)
        scaled = _scaled(hypothesis, factor)
        return scaled._replace(instances=instances, links=links, closed=tuple(closed))

    def _over(self, instance: Instance[S], link: Link[S], number: int) -> Closed[S]:
        """An instance that closed undone: finished unseen, or given up, whichever is cheaper to believe."""
        left = self.growing.least_left(instance.state)
        is_finished = self.prices.missed**left >= self.prices.abandon
        outcome: Outcome = "finished" if is_finished else "abandoned"
        return Closed(instance.goal, instance.owner, outcome, link, left, number)


def _with_needless(parent: Hypothesis[S], weight: float, best: float, number: int) -> Hypothesis[S]:
    return parent._replace(weight=weight, best=best, needless=(*parent.needless, number), last=None)


def _scaled(hypothesis: Hypothesis[S], factor: float) -> Hypothesis[S]:
    return hypothesis._replace(weight=hypothesis.weight * factor, best=hypothesis.best * factor)


def _joined(one: Hypothesis[S], other: Hypothesis[S]) -> Hypothesis[S]:
    heavier = one if one.best >= other.best else other
    return heavier._replace(weight=one.weight + other.weight)


def _recent(hypothesis: Hypothesis[S], before: int) -> Hypothesis[S]:
    """Without what lies too far back."""
    if hypothesis.needless and hypothesis.needless[0] <= before:
        return hypothesis._replace(needless=tuple(number for number in hypothesis.needless if number > before))
    return hypothesis
