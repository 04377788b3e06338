"""A day by sheer enumeration: every way to give each observation an instance, a goal that begins, or nothing.

Nothing is merged, summed out or dropped. A derivation is its weight, the open instances, and its story: which instance
(numbered in the order in which they began) took each observation, and which goal each finished instance was of.
"""

from __future__ import annotations

from typing import Any, NamedTuple


class Open(NamedTuple):
    number: int
    goal: int
    state: Any
    owner: str | None
    touched: int


class Derivation(NamedTuple):
    weight: float
    open: tuple[Open, ...]
    story: tuple[int | None, ...]
    finished: frozenset
    last: int | None  # the goal of the last observation
    then: float = 1.0  # its weight before anything closed for being left alone


def alive(prices, together, idle):
    passes = 0.9 if together == 1 else 1 - 1 / (2 * together)
    odds = (1 - prices.abandon) / prices.abandon * passes**idle
    return odds / (1 + odds)


def lasts(prices, together):
    """For how many observations an instance is kept that nothing touches."""
    idle = 1
    while alive(prices, together, idle) >= 0.02:
        idle += 1
    return idle


def pursued(prices, together, idle):
    return alive(prices, together, min(idle, lasts(prices, together) - 1))


def derivations(growing, prices, observations):
    """Every derivation of the observations, pairs of what was seen and by whom."""
    found, counts = [Derivation(1.0, (), (), frozenset(), None)], {}
    for seen, agent in observations:
        found = [after for before in found for after in _after(growing, prices, before, seen, agent, counts)]
        counts = {**counts, agent: counts.get(agent, 0) + 1}
        found = [_expired(growing, prices, derivation, agent, counts) for derivation in found]
    return found


def posterior(growing, prices, found, counts):
    """By goal: that some open instance is of it, and still pursued. Instances are independent, given the story."""
    by_story: dict[Any, list[Derivation]] = {}
    for derivation in found:
        by_story.setdefault((derivation.story, derivation.finished), []).append(derivation)
    whole, shares = sum(d.weight for d in found), dict.fromkeys(growing.goals, 0.0)
    for group in by_story.values():
        for goal, label in enumerate(growing.goals):
            for derivation in group:
                none = 1.0
                for instance in derivation.open:
                    if instance.goal == goal and not growing.is_done(instance.state):
                        together = sum(other.owner == instance.owner for other in derivation.open)
                        none *= 1 - pursued(prices, together, counts.get(instance.owner, 0) - instance.touched)
                shares[label] += derivation.weight * (1 - none) / whole
    return shares


def _after(growing, prices, before, seen, agent, counts):
    own = [instance for instance in before.open if instance.owner == agent]
    others = [instance for instance in before.open if instance.owner != agent]
    settled = prices.settled
    for group, factor in ((own, 1.0), (others, prices.helping)):
        weights = [pursued(prices, len(group), counts.get(i.owner, 0) - i.touched) for i in group]
        for instance, weight in zip(group, weights):
            for step in growing.steps(instance.state, seen, agent):
                each = (1 - prices.begin) * weight / sum(weights) / max(1, growing.choices(instance.state))
                each *= step.weight * step.part * prices.missed**step.missed * settled**step.settled
                each *= 1.0 if step.is_theirs else factor
                rest = tuple(other for other in before.open if other is not instance)
                touched = counts.get(agent, 0) + 1 if instance.owner == agent else instance.touched
                grown = Open(instance.number, instance.goal, step.state, instance.owner, touched)
                yield _taken(growing, before, rest, grown, each)
    for goal in range(len(growing.goals)):
        state = growing.begin(goal)
        for step in growing.steps(state, seen, agent):
            each = (prices.begin if own else 1.0) / len(growing.goals) / max(1, growing.choices(state))
            each *= step.weight * step.part * prices.missed**step.missed * settled**step.settled
            number = 1 + max((n for n in before.story if n is not None), default=-1)
            grown = Open(number, goal, step.state, agent, counts.get(agent, 0) + 1)
            yield _taken(growing, before, before.open, grown, each)
    price = prices.needless * settled**seen.known_args
    yield Derivation(before.weight * price, before.open, (*before.story, None), before.finished, None)


def _taken(growing, before, rest, grown, factor):
    story = (*before.story, grown.number)
    if growing.is_done(grown.state) and not growing.choices(grown.state):
        finished = before.finished | {(grown.number, grown.goal)}
        return Derivation(before.weight * factor, rest, story, finished, grown.goal)
    return Derivation(before.weight * factor, (*rest, grown), story, before.finished, grown.goal)


def _expired(growing, prices, derivation, agent, counts):
    own = sum(instance.owner == agent for instance in derivation.open)
    weight, kept = derivation.weight, []
    for instance in derivation.open:
        idle = counts.get(instance.owner, 0) - instance.touched
        if instance.owner == agent and idle >= lasts(prices, own):
            left = growing.least_left(instance.state)
            weight *= max(prices.abandon, prices.missed**left) if left else 1.0
        else:
            kept.append(instance)
    return derivation._replace(weight=weight, open=tuple(kept), then=derivation.weight)
