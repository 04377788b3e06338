"""Where one observation leads from the hypotheses of a day: an instance goes on, a goal begins, or it is needless.

From a hypothesis of weight w, ``beta``, ``alpha``, ``nu`` and ``mu`` being the prices of beginning, giving up, needless
and missed actions, an observation of agent a leads to

* an instance going on: w * (1 - beta) * share / choices * mu ** missed, where ``share`` is the instance's part of the
  probabilities that a's instances are still pursued (`idling`), and ``choices`` how many leaves could come next; an
  instance that somebody else began costs the price of helping besides, unless its plan says that the step is a's;
* a goal beginning: w * beta * prior / choices * mu ** missed, with 1 for beta where a has nothing open. An instance of
  the same goal that it could be mistaken for is given up by that;
* nothing: w * nu.

This is the pending set of PHATT (Geib and Goldman, Artificial Intelligence 173, 2009, section 4) with prices for what
it lacks. Work is bounded: see `Bounds`.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Generic, NamedTuple, TypeVar

from casper.engine.episodes.growing import Growing, Step
from casper.engine.episodes.hypotheses import Hypothesis, Instance, Key, Level
from casper.engine.episodes.idling import Idling
from casper.engine.episodes.prices import Prices
from casper.engine.verification.observation import Seen
from casper.kb.terms.unification import renamed, unify

S = TypeVar("S")
NEEDLESS, BEGINS = -2, -1  # in place of the number of the instance that goes on


@dataclass(frozen=True, slots=True)
class Bounds:
    """How much is kept: the ``keep`` heaviest hypotheses, none below ``floor`` of the heaviest one's weight.

    What was believed, and what has closed, is kept for ``lag`` observations.
    """

    keep: int = 300
    floor: float = 1e-6
    lag: int = 100


class Move(NamedTuple, Generic[S]):
    """An instance after a step, and the factor of the step; ``closes``: nothing at all is left of it."""

    factor: float
    instance: Instance[S]
    step: Step[S]
    closes: bool


class Sprout(NamedTuple, Generic[S]):
    """A goal that begins, and the factors of this one and all that come after it, which are no larger."""

    move: Move[S]
    tail: float


class Candidate(Generic[S]):
    """A hypothesis to be: its weight, and how its heaviest derivation came out of which other one."""

    __slots__ = ("at", "best", "move", "parent", "restarted", "weight")

    def __init__(
        self, weight: float, best: float, parent: Hypothesis[S], at: int, move: Move[S] | None, restarted: int | None
    ) -> None:
        self.weight, self.best, self.parent = weight, best, parent
        self.at, self.move, self.restarted = at, move, restarted


class Expansion(Generic[S]):
    """All that one observation leads to.

    ``candidates`` are the hypotheses by their instances, ``current`` what the observation was taken for by goal,
    ``dropped`` the weight of what was too light to be looked at.
    """

    def __init__(
        self, growing: Growing[S], prices: Prices, priors: Sequence[float], idling: Idling, bounds: Bounds
    ) -> None:
        self._growing, self._prices, self._priors = growing, prices, priors
        self._idling, self._bounds = idling, bounds
        self.candidates: dict[Key[S], Candidate[S]] = {}
        self.current: dict[int, float] = {}
        self.dropped = self._floor = 0.0
        self._made: dict[tuple[int, Any, str | None], Instance[S]] = {}
        self._moves: dict[Instance[S], list[Move[S]]] = {}
        self._alike: dict[tuple[Instance[S], Instance[S]], bool] = {}

    def run(self, level: Level[S], seen: Seen, agent: str | None) -> None:
        """Expand every hypothesis."""
        counts = {**level.counts, agent: level.counts.get(agent, 0) + 1}
        self._seen, self._agent, self._counts = seen, agent, counts
        sprouts = self._sprouts()
        needless = self._prices.needless
        for hypothesis in level.hypotheses:
            owned = self._go_on(hypothesis)
            self._begin(hypothesis, owned, sprouts)
            self._add(hypothesis.instances, needless, hypothesis, NEEDLESS, None)

    def _go_on(self, hypothesis: Hypothesis[S]) -> list[Instance[S]]:
        """Every instance that can take the observation does; the agent's own instances."""
        instances = hypothesis.instances
        moving = [(at, self._moves_of(instance)) for at, instance in enumerate(instances)]
        owned = [instance for instance in instances if instance.owner == self._agent]
        if any(moves for _, moves in moving):
            own = self._alive(owned)
            others = self._alive([instance for instance in instances if instance.owner != self._agent])
            whole, rest = sum(own.values()), sum(others.values())
            for at, moves in moving:
                if moves:
                    self._move(hypothesis, at, moves, own, whole, others, rest)
        return owned

    def _move(
        self,
        hypothesis: Hypothesis[S],
        at: int,
        moves: Sequence[Move[S]],
        own: dict[Instance[S], float],
        whole: float,
        others: dict[Instance[S], float],
        rest: float,
    ) -> None:
        instances = hypothesis.instances
        instance, stays = instances[at], 1 - self._prices.begin
        remaining = instances[:at] + instances[at + 1 :]
        is_own = instance.owner == self._agent
        share = stays * (own[instance] / whole if is_own else others[instance] / rest)
        for move in moves:
            factor = share * move.factor
            if not is_own and not move.step.is_theirs:
                factor *= self._prices.helping
            key = remaining if move.closes else (*remaining, move.instance)
            self._add(key, factor, hypothesis, at, move)

    def _begin(self, hypothesis: Hypothesis[S], owned: Sequence[Instance[S]], sprouts: Sequence[Sprout[S]]) -> None:
        instances, weight = hypothesis.instances, hypothesis.weight
        begin = self._prices.begin if owned else 1.0
        for move, tail in sprouts:
            if weight * begin * move.factor < self._floor:
                self.dropped += weight * begin * tail
                break
            fresh, factor, kept, restarted = move.instance, begin * move.factor, instances, None
            for instance in owned:
                if instance.goal == fresh.goal and self._are_alike(instance, fresh):
                    restarted = instances.index(instance)
                    factor *= self.closing(instance)
                    kept = instances[:restarted] + instances[restarted + 1 :]
                    break
            self._add(kept if move.closes else (*kept, fresh), factor, hypothesis, BEGINS, move, restarted)

    def _add(
        self,
        key: Key[S],
        factor: float,
        parent: Hypothesis[S],
        at: int,
        move: Move[S] | None,
        restarted: int | None = None,
    ) -> None:
        weight = parent.weight * factor
        if move is not None:
            goal = move.instance.goal
            self.current[goal] = self.current.get(goal, 0.0) + weight
        if weight < self._floor:
            self.dropped += weight
            return
        self._floor = max(self._floor, weight * self._bounds.floor)
        best = parent.best * factor
        known = self.candidates.get(key)
        if known is None:
            self.candidates[key] = Candidate(weight, best, parent, at, move, restarted)
            return
        known.weight += weight
        if best > known.best:
            known.best, known.parent, known.at, known.move, known.restarted = best, parent, at, move, restarted

    # --- instances ---------------------------------------------------------------------------------------------------

    def closing(self, instance: Instance[S]) -> float:
        """What it costs to give an instance up, or to take what is left of it for done and unseen: the cheaper one."""
        left = self._growing.least_left(instance.state)
        return max(self._prices.abandon, self._prices.missed**left) if left else 1.0

    def _alive(self, instances: Sequence[Instance[S]]) -> dict[Instance[S], float]:
        """The probability of each that it is still pursued."""
        found: dict[Instance[S], float] = {}
        for instance in instances:
            before = self._counts.get(instance.owner, 0) - (instance.owner == self._agent)
            table = self._idling.alive(len(instances))
            found[instance] = table[min(before - instance.touched, len(table) - 1)]
        return found

    def _moves_of(self, instance: Instance[S]) -> list[Move[S]]:
        moves = self._moves.get(instance)
        if moves is None:
            steps = self._growing.steps(instance.state, self._seen, self._agent)
            moves = self._moves[instance] = self._weighed(instance.goal, instance.state, instance.owner, steps, 1.0)
        return moves

    def _sprouts(self) -> list[Sprout[S]]:
        found: list[Move[S]] = []
        for goal in self._growing.begins_with(self._seen):
            state = self._growing.begin(goal)
            steps = self._growing.steps(state, self._seen, self._agent)
            found += self._weighed(goal, state, self._agent, steps, self._priors[goal])
        found.sort(key=lambda move: -move.factor)
        sprouts, tail = list[Sprout[S]](), 0.0
        for move in reversed(found):
            tail += move.factor
            sprouts.append(Sprout(move, tail))
        return sprouts[::-1]

    def _weighed(
        self, goal: int, state: S, owner: str | None, steps: Iterable[Step[S]], prior: float
    ) -> list[Move[S]]:
        choices, growing = max(1, self._growing.choices(state)), self._growing
        moves: list[Move[S]] = []
        for step in steps:
            factor = prior * step.weight * self._prices.missed**step.missed / choices
            key = (goal, step.state, owner)
            instance = self._made.get(key)
            if instance is None:
                is_done = growing.is_done(step.state)
                touched = self._counts.get(owner, 0)
                instance = self._made[key] = Instance(goal, step.state, owner, touched, is_done)
            closes = instance.is_done and not growing.choices(step.state)
            moves.append(Move(factor, instance, step, closes))
        return moves

    def _are_alike(self, old: Instance[S], new: Instance[S]) -> bool:
        """Whether the parameters of two instances of one goal agree as far as they are known."""
        known = self._alike.get((old, new))
        if known is None:
            first, second = self._growing.goal_of(old.state), self._growing.goal_of(new.state)
            known = self._alike[old, new] = unify(renamed((first,), -1)[0], renamed((second,), -2)[0], {}) is not None
        return known
