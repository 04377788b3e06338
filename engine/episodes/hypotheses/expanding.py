"""Where one observation leads from the hypotheses of a day: an instance goes on, one begins, or it is needless.

From a hypothesis of weight w, ``beta``, ``nu`` and ``mu`` being the prices of beginning, needless and missed actions,
an observation of agent a leads to

* an instance going on: w * (1 - beta) * share / choices * mu ** missed, where ``share`` is the instance's part of the
  probabilities that a's instances are still pursued (`idling`), and ``choices`` how many leaves could come next; an
  instance that somebody else began costs the price of helping besides, unless its plan says that the step is a's;
* a goal beginning: w * beta * prior / choices * mu ** missed, with 1 for beta where a has nothing open;
* nothing: w * nu.

Each argument that nothing has settled before, of a leaf or of a needless action, costs the price of that besides.

This is the pending set of PHATT (Geib and Goldman, Artificial Intelligence 173, 2009, section 4) with prices for what
it lacks, and with the goals of what began summed out. Work is bounded (`growth.Bounds`).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Generic, NamedTuple, TypeVar

from casper.engine.episodes.growing import Growing
from casper.engine.episodes.hypotheses.growth import Bounds, Finish, Grower, Growth
from casper.engine.episodes.hypotheses.hypothesis import Event, Hypothesis, Instance, Key, Level
from casper.engine.episodes.hypotheses.idling import Idling
from casper.engine.episodes.prices import Prices
from casper.engine.verification.observation import options_of

S = TypeVar("S")
NEEDLESS, BEGINS = -2, -1  # in place of the number of the instance that goes on
CONTRADICTION = 1e-9  # the factor of taking for needless what is known to serve a goal


class Way(NamedTuple, Generic[S]):
    """How a hypothesis came out of another: which instance went on (or began, or none), how, and what it finished."""

    parent: Hypothesis[S]
    at: int
    growth: Growth[S] | None
    finish: Finish[S] | None


class Candidate(Generic[S]):
    """A hypothesis to be: its weight, that of its heaviest derivation, and that one's last step with what it adds."""

    __slots__ = ("best", "share", "way", "weight")

    def __init__(self, weight: float, best: float, way: Way[S]) -> None:
        self.weight, self.best, self.way, self.share = weight, best, way, weight


class Expansion(Generic[S]):
    """All that one observation leads to.

    ``candidates`` are the hypotheses by their instances, ``current`` what the observation was taken for by goal,
    ``dropped`` the weight of what was too light to be looked at, ``passed_over`` that of the hypotheses themselves for
    which no tries were left.
    """

    def __init__(
        self, growing: Growing[S], prices: Prices, priors: list[float], idling: Idling, bounds: Bounds, event: Event
    ) -> None:
        self._prices, self._priors, self._idling, self._event = prices, priors, idling, event
        self._least, self._tries = bounds.floor, bounds.tries
        self.grower = Grower(growing, prices, bounds, event)
        self._weights: dict[Growth[S], float] = {}
        self.candidates: dict[Key[S], Candidate[S]] = {}
        self.dropped = self.passed_over = self._floor = 0.0

    def run(self, level: Level[S]) -> None:
        """Expand every hypothesis, the heaviest first, while there are tries left."""
        self._counts = level.counts
        begun, needless = self.grower.begun(self._priors), needless_price(self._prices, self._event)
        for at, hypothesis in enumerate(level.hypotheses):
            if self.grower.tried >= self._tries:
                self.passed_over = sum(lighter.weight for lighter in level.hypotheses[at:])
                break
            key = hypothesis.key
            is_free = self._go_on(hypothesis, key)
            if begun is not None:
                begin = 1.0 if is_free else self._prices.begin
                self._grow(hypothesis, key, BEGINS, begun, begin)
            self._add(key, needless, Way(hypothesis, NEEDLESS, None, None))

    @property
    def current(self) -> dict[int, float]:
        """The weight of what the observation was taken for, by goal."""
        found: dict[int, float] = {}
        for growth, weight in self._weights.items():
            for goal, factor in growth.goals.items():
                found[goal] = found.get(goal, 0.0) + weight * factor
        return found

    def _go_on(self, hypothesis: Hypothesis[S], key: Key[S]) -> bool:
        """Every instance that can take the observation does; whether the agent has nothing open."""
        agent, grown = self._event.agent, self.grower.grown
        growths = [grown(body) for body in key]
        own = [at for at, body in enumerate(key) if body.owner == agent]
        for group in (own, [at for at in range(len(key)) if at not in own] if len(own) < len(key) else []):
            if any(growths[at] is not None for at in group):
                alive = [self._alive(key, at, len(group)) for at in group]
                each = (1 - self._prices.begin) / sum(alive)
                for at, still in zip(group, alive):
                    growth = growths[at]
                    if growth is not None:
                        self._grow(hypothesis, key[:at] + key[at + 1 :], at, growth, each * still)
        return not own

    def _grow(
        self, hypothesis: Hypothesis[S], remaining: Key[S], at: int, growth: Growth[S], factor: float
    ) -> None:
        weight = hypothesis.weight * factor
        self._weights[growth] = self._weights.get(growth, 0.0) + weight
        self.dropped += weight * growth.dropped
        if growth.body is not None:
            self._add((*remaining, growth.body), factor * growth.whole, Way(hypothesis, at, growth, None))
        for finish in growth.finished:
            self._add(remaining, factor * finish.factor, Way(hypothesis, at, growth, finish))

    def _add(self, key: Key[S], factor: float, way: Way[S]) -> None:
        weight = way.parent.weight * factor
        if weight < self._floor:
            self.dropped += weight
            return
        self._floor = max(self._floor, weight * self._least)
        best = way.parent.best * factor
        known = self.candidates.get(key)
        if known is None:
            self.candidates[key] = Candidate(weight, best, way)
            return
        known.weight += weight
        if best > known.best:
            known.best, known.way, known.share = best, way, weight

    def _alive(self, key: Key[S], at: int, together: int) -> float:
        """The probability that an instance is still pursued."""
        body, table = key[at], self._idling.alive(together)
        return table[min(self._counts.get(body.owner, 0) - body.touched, len(table) - 1)]


def needless_price(prices: Prices, event: Event) -> float:
    """What it costs that an observation serves no goal; next to nothing may come of one that is known to serve some."""
    weights = [weight * prices.settled**option.known_args for option, weight in options_of(event.seen)]
    return prices.needless * sum(weights) * (CONTRADICTION if event.only else 1.0)


def closing_prices(growing: Growing[S], prices: Prices, instance: Instance[S]) -> Sequence[float]:
    """By entry what it costs to give it up, or to take what is left of it for done and unseen: the cheaper one."""
    lefts = [growing.least_left(entry.state) for entry in instance.body.entries]
    return [max(prices.abandon, prices.missed**left) if left else 1.0 for left in lefts]
