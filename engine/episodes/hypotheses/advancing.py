"""From one level of a day to the next: expand, drop the lightest, close what is over, and agree on what closed."""

from __future__ import annotations

import heapq
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Generic, TypeVar

from casper.engine.episodes.growing import Growing
from casper.engine.episodes.hypotheses.agreeing import contradicts, numbers, settle
from casper.engine.episodes.hypotheses.expanding import BEGINS, Candidate, Expansion, closing_prices
from casper.engine.episodes.hypotheses.growth import Bounds, Grower
from casper.engine.episodes.hypotheses.hypothesis import Closed, Event, Hypothesis, Instance, Key, Level, Outcome
from casper.engine.episodes.hypotheses.idling import SOON, Idling
from casper.engine.episodes.prices import Prices
from casper.engine.verification.vocabulary import Foreign

S = TypeVar("S")


class Advance(Generic[S]):
    """How a day goes on with an observation, under fixed prices, priors and bounds."""

    def __init__(self, growing: Growing[S], prices: Prices, priors: list[float], bounds: Bounds) -> None:
        self.growing, self.prices, self.bounds = growing, prices, bounds
        self.idling = Idling(prices.abandon)
        self._priors = priors

    def observed(self, level: Level[S], event: Event) -> Level[S]:
        """The level after an observation that the plans may explain."""
        expansion = Expansion(self.growing, self.prices, self._priors, self.idling, self.bounds, event)
        expansion.run(level)
        candidates = expansion.candidates
        found = self._lasting(candidates)
        kept = sum(candidate.weight for candidate in found)
        dropped = expansion.dropped
        if len(found) < len(candidates):
            dropped += max(0.0, sum(candidate.weight for candidate in candidates.values()) - kept)
        whole = kept + dropped
        current = {goal: weight / whole for goal, weight in expansion.current.items()}
        made = [self._made(candidate, event, expansion.grower) for candidate in found]
        passed_over = expansion.passed_over / sum(hypothesis.weight for hypothesis in level.hypotheses)
        left_out = passed_over + (1 - passed_over) * dropped / whole
        return self._level(level, event, made, current, left_out)

    def unknown(self, level: Level[S], event: Event, foreign: Foreign) -> Level[S]:
        """The level after an action that no plan has: needless by every hypothesis."""
        made = [_needless(h, h.weight, h.best, event.number) for h in level.hypotheses]
        return replace(self._level(level, event, made, {}, 0.0), foreign=foreign)

    def over(self, level: Level[S]) -> Level[S]:
        """The level when nothing more will be observed: everything open is closed.

        What is told is the heaviest hypothesis of the likeliest set of goals.
        """
        closed = [self._without(h, range(len(h.instances)), level.number) for h in level.hypotheses]
        shares: dict[tuple[tuple[int, str], ...], float] = {}
        for hypothesis in closed:
            shares[_goals(hypothesis)] = shares.get(_goals(hypothesis), 0.0) + hypothesis.weight
        best = max(closed, key=lambda hypothesis: (shares[_goals(hypothesis)], hypothesis.weight))
        taken = {at for told in level.told for at in numbers(told.link)}
        settled = tuple(found for found in best.closed if not contradicts(found, taken))
        told = (*level.told, *settled)
        return replace(level, hypotheses=(best._replace(weight=1.0, closed=()),), told=told, settled=settled)

    def _level(
        self,
        before: Level[S],
        event: Event,
        made: Sequence[Hypothesis[S]],
        current: Mapping[int, float],
        dropped: float,
    ) -> Level[S]:
        lag, counts = self.bounds.lag, {**before.counts, event.agent: event.own_number}
        closed = self._closed(made, counts, event)
        total = sum(hypothesis.weight for hypothesis in closed)
        scaled = [_scaled(hypothesis, 1 / total) for hypothesis in closed]
        agreed, settled = settle(scaled, event.number, lag, before.told)
        told = tuple(c for c in (*before.told, *settled) if c.number > event.number - lag)
        recent = [_recent(hypothesis, event.number - lag) for hypothesis in agreed]
        seen, agent, t, number, _, _ = event
        return Level(recent, number, counts, seen, agent, t, current, dropped, told, tuple(settled))

    def _lasting(self, candidates: Mapping[Key[S], Candidate[S]]) -> list[Candidate[S]]:
        """The candidates that are kept, the heaviest first."""
        least = self.bounds.floor * max(candidate.weight for candidate in candidates.values())
        found = [candidate for candidate in candidates.values() if candidate.weight >= least]
        return heapq.nlargest(self.bounds.keep, found, key=lambda candidate: candidate.weight)

    # --- making and closing ------------------------------------------------------------------------------------------

    def _made(self, candidate: Candidate[S], event: Event, grower: Grower[S]) -> Hypothesis[S]:
        """The hypothesis with the story of its heaviest derivation."""
        parent, at, growth, finish = candidate.way
        weight, best = candidate.weight, candidate.best
        if growth is None:
            return _needless(parent, weight, best, event.number)
        instances, closed = parent.instances, parent.closed
        before = None if at == BEGINS else instances[at]
        if before is not None:
            instances = instances[:at] + instances[at + 1 :]
        if finish is None:
            return Hypothesis((*instances, grower.instance(before, growth)), weight, best, closed, parent.needless)
        owner, sure = event.agent if before is None else before.body.owner, candidate.share / weight
        link = grower.link(before, finish)
        closed = (*closed, Closed(finish.goal, owner, "finished", link, 0, event.number, sure))
        return Hypothesis(instances, weight, best, closed, parent.needless)

    def _closed(
        self, hypotheses: Sequence[Hypothesis[S]], counts: Mapping[str | None, int], event: Event
    ) -> Sequence[Hypothesis[S]]:
        """Close what was left alone for too long; what is equal then is one. The heaviest come first."""
        expired = [self._expired(hypothesis.instances, counts, event.agent) for hypothesis in hypotheses]
        if not any(expired):
            return hypotheses
        found: dict[Key[S], Hypothesis[S]] = {}
        for hypothesis, gone in zip(hypotheses, expired):
            left = self._without(hypothesis, gone, event.number) if gone else hypothesis
            known = found.get(left.key)
            found[left.key] = left if known is None else _joined(known, left)
        return sorted(found.values(), key=lambda hypothesis: -hypothesis.weight)

    def _expired(
        self, instances: Sequence[Instance[S]], counts: Mapping[str | None, int], agent: str | None
    ) -> list[int]:
        """The numbers of the agent's instances that are closed now."""
        now = counts.get(agent, 0)
        own = [(at, instance.body) for at, instance in enumerate(instances) if instance.body.owner == agent]
        most = len(self.idling.alive(len(own))) if own else 0
        return [at for at, body in own if now - body.touched >= (min(SOON, most) if body.is_done else most)]

    def _without(self, hypothesis: Hypothesis[S], expired: Sequence[int], number: int) -> Hypothesis[S]:
        factor, closed = 1.0, list(hypothesis.closed)
        for at in expired:
            instance = hypothesis.instances[at]
            prices = closing_prices(self.growing, self.prices, instance)
            costs = [entry.share * price for entry, price in zip(instance.body.entries, prices)]
            factor *= sum(costs)
            closed.append(self._over(instance, costs, number))
        kept = tuple(instance for at, instance in enumerate(hypothesis.instances) if at not in expired)
        return _scaled(hypothesis, factor)._replace(instances=kept, closed=tuple(closed))

    def _over(self, instance: Instance[S], costs: Sequence[float], number: int) -> Closed[S]:
        """An instance that closed undone, of its likeliest goal: finished unseen or given up, the cheaper one."""
        entries, owner = instance.body.entries, instance.body.owner
        shares: dict[int, float] = {}
        for entry, cost in zip(entries, costs):
            shares[entry.goal] = shares.get(entry.goal, 0.0) + cost
        at = max(range(len(costs)), key=lambda number: (shares[entries[number].goal], costs[number]))
        entry = entries[at]
        left = self.growing.least_left(entry.state)
        outcome: Outcome = "finished" if self.prices.missed**left >= self.prices.abandon else "abandoned"
        sure = shares[entry.goal] / sum(costs)
        return Closed(entry.goal, owner, outcome, instance.links[at], left, number, sure)


def _needless(parent: Hypothesis[S], weight: float, best: float, number: int) -> Hypothesis[S]:
    return parent._replace(weight=weight, best=best, needless=(*parent.needless, number))


def _goals(hypothesis: Hypothesis[S]) -> tuple[tuple[int, str], ...]:
    """The goals of the episodes that closed, and whose they were."""
    return tuple(sorted((closed.goal, closed.owner or "") for closed in hypothesis.closed))


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
