"""Which episodes that closed are told: those on which the hypotheses agree, and those that can wait no longer."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

from casper.engine.episodes.hypotheses import Closed, Hypothesis

S = TypeVar("S")
SURE = 0.99  # the share of the weight of the hypotheses that agree


def settle(
    hypotheses: Sequence[Hypothesis[S]], number: int, lag: int
) -> tuple[Sequence[Hypothesis[S]], list[Closed[S]]]:
    """The hypotheses without the episodes that are settled, and those, in the order in which they ended.

    An episode is settled when hypotheses that hold `SURE` of the weight have it, or when it has waited for ``lag``
    observations in the best hypothesis: its outcome is then "unclear" unless most of the weight is for it. What rivals
    made of the same observations is settled with it, and never told.
    """
    shares: dict[tuple[int, str | None, str, int], float] = {}
    for hypothesis in hypotheses:
        for closed in hypothesis.closed:
            shares[closed.key] = shares.get(closed.key, 0.0) + hypothesis.weight * closed.sure
    if not shares:
        return hypotheses, []
    best = hypotheses[0]
    settled: list[Closed[S]] = []
    for closed in best.closed:
        if shares[closed.key] >= SURE:
            settled.append(closed)
        elif closed.number <= number - lag:
            settled.append(closed if shares[closed.key] > 0.5 else closed._replace(outcome="unclear"))
    is_old = any(closed.number <= number - lag for hypothesis in hypotheses for closed in hypothesis.closed)
    if not settled and not is_old:
        return hypotheses, []
    taken = {link.number for closed in settled for link in closed.link.all()}
    return [_without(hypothesis, taken, number - lag) for hypothesis in hypotheses], settled


def _without(hypothesis: Hypothesis[S], taken: set[int], before: int) -> Hypothesis[S]:
    """The hypothesis without the closed episodes that share observations with what is settled, or are too old."""
    if not hypothesis.closed:
        return hypothesis
    kept = [
        closed
        for closed in hypothesis.closed
        if closed.number > before and not any(link.number in taken for link in closed.link.all())
    ]
    return hypothesis._replace(closed=tuple(kept))
