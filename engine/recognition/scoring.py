"""Scores of an explanation, as exact fractions: the paper's, and others that weigh the same counts differently.

A score is a function of (leaves of the plan, observed leaves, missed leaves) and gives numerator and denominator. From
integers by one division it is correctly rounded: equal scores are equal floats. Prices and priors round once more; so
weights tie that differ by no more than `TIE`. An optional part that nothing was observed of is no part of the plan: its
leaves are neither counted nor missed.

The table `SCORES` is the registry.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TypeAlias

from casper.kb.errors import CasperError

Score: TypeAlias = Callable[[int, int, int], tuple[int, int]]

TIE = 1e-12  # relative; different scores of plans of up to a thousand leaves differ by more


def posterior_by(labels: Iterable[str], sums: Sequence[float], whole: float) -> dict[str, float]:
    """Each label's share of the whole; all zero when nothing explains the observations."""
    totals: dict[str, float] = {}
    for label, part in zip(labels, sums):
        totals[label] = totals.get(label, 0.0) + part
    return {label: total / whole if whole else 0.0 for label, total in totals.items()}


def least_tie(top: float) -> float:
    """The least weight that ties with the best one."""
    return top * (1 - TIE)


def paper(leaves: int, observed: int, missed: int) -> tuple[int, int]:
    """(observed / leaves) * (1 - missed / leaves), over terminal nodes (paper equation "score")."""
    return observed * (leaves - missed), leaves * leaves


def coverage(leaves: int, observed: int, missed: int) -> tuple[int, int]:
    """The share of the plan's leaves that was observed: misses cost nothing."""
    return observed, leaves


def diligence(leaves: int, observed: int, missed: int) -> tuple[int, int]:
    """The share of what should be done by now that was observed: what is to come costs nothing."""
    return observed, observed + missed


def uniform(leaves: int, observed: int, missed: int) -> tuple[int, int]:
    """Every explanation counts alike."""
    return 1, 1


SCORES: dict[str, Score] = {"paper": paper, "coverage": coverage, "diligence": diligence, "uniform": uniform}


def score_named(name: str) -> Score:
    """The score of that name.

    Raises:
        CasperError: there is none; the sentence lists those there are.
    """
    if name not in SCORES:
        raise CasperError(f"there is no score {name!r}; choose {', '.join(SCORES)}")
    return SCORES[name]


def name_of(score: Score) -> str:
    """The name under which a score is registered.

    Raises:
        CasperError: it is not.
    """
    for name, registered in SCORES.items():
        if registered is score:
            return name
    raise CasperError("this score has no name")
