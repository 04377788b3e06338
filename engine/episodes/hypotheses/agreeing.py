"""Which episodes that closed are told: those on which the hypotheses agree, and those that can wait no longer."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TypeVar

from casper.engine.episodes.hypotheses.hypothesis import Closed, Hypothesis, Link

S = TypeVar("S")
SURE = 0.99  # the share of the weight of the hypotheses that agree


def settle(
    hypotheses: Sequence[Hypothesis[S]], number: int, lag: int, told: Sequence[Closed[S]]
) -> tuple[Sequence[Hypothesis[S]], list[Closed[S]]]:
    """The hypotheses without the episodes that are settled, and those, in the order in which they closed.

    An episode is settled when hypotheses that hold `SURE` of the weight have it, or when it has waited for ``lag``
    observations in the best hypothesis: its outcome is then "unclear" unless most of the weight is for it. What rivals
    made of the same observations is settled with it, and never told.

    Args:
        hypotheses: the best first.
        number: of the last observation.
        lag: how many observations an episode may wait for.
        told: what was settled before, lately.
    """
    shares: dict[tuple[int, str | None, str, int], float] = {}
    for hypothesis in hypotheses:
        for closed in hypothesis.closed:
            shares[closed.key] = shares.get(closed.key, 0.0) + hypothesis.weight * closed.sure
    if not shares:
        return hypotheses, []
    taken = {at for closed in told for at in numbers(closed.link)}
    settled: list[Closed[S]] = []
    for closed in hypotheses[0].closed:
        is_sure, is_old = shares[closed.key] >= SURE, closed.number <= number - lag
        if (is_sure or is_old) and not contradicts(closed, taken):
            is_likely = is_sure or shares[closed.key] > 0.5
            settled.append(closed if is_likely else closed._replace(outcome="unclear"))
            taken.update(numbers(closed.link))
    return [_without(hypothesis, taken, number - lag) for hypothesis in hypotheses], settled


def numbers(link: Link[S]) -> list[int]:
    """The numbers of the observations that an instance took."""
    return [each.number for each in link.all()]


def contradicts(closed: Closed[S], taken: Iterable[int]) -> bool:
    """Whether an episode cannot be told beside others that took these observations: an action serves one goal.

    One that was finished stands for itself, unless most of its observations are among them.
    """
    own = numbers(closed.link)
    shared = len(set(own).intersection(taken))
    return 2 * shared > len(own) or (shared > 0 and closed.outcome == "abandoned")


def _without(hypothesis: Hypothesis[S], taken: set[int], before: int) -> Hypothesis[S]:
    """The hypothesis without the closed episodes whose observations were settled otherwise, or that are too old."""
    if not hypothesis.closed:
        return hypothesis
    kept = tuple(c for c in hypothesis.closed if c.number > before and not contradicts(c, taken))
    return hypothesis._replace(closed=kept) if len(kept) < len(hypothesis.closed) else hypothesis
