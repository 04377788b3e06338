"""Priors over goals: the facts ``prior(Goal, P)`` of a domain."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from typing import Any

from casper.kb.errors import CasperError, Place
from casper.kb.terms.numbers import as_float
from casper.kb.terms.syntax import term_text

TOLERANCE = 1e-6


def priors_of(
    rows: Iterable[tuple[Any, ...]],
    labels: Sequence[str],
    place: Callable[[tuple[Any, ...]], Place | None] = lambda row: None,
) -> dict[str, float]:
    """Each goal's prior by its label; all 1 where none is stated.

    Args:
        rows: the rows of prior/2.
        labels: the goals.
        place: where a row is stated, for mistakes.

    Raises:
        CasperError: a prior of something that is no goal, a goal without one or with two, one that is no positive
            number, or they do not sum to 1.
    """
    stated: dict[str, float] = {}
    known = set(labels)
    where: Place | None = None
    for row in rows:
        goal, prior = row
        name, where = term_text(goal), place(row)
        if name not in known:
            sentence = f"prior({name}, {prior}): {name} is no goal; the goals are {', '.join(labels)}"
            raise CasperError(sentence, where)
        if name in stated and stated[name] != prior:
            raise CasperError(f"{name} has two priors, {stated[name]} and {prior}", where)
        if not 0 < as_float(prior) <= 1 + TOLERANCE:
            raise CasperError(f"prior({name}, {term_text(prior):.40}): a prior is a number above 0, at most 1", where)
        stated[name] = as_float(prior)
    if not stated:
        return dict.fromkeys(labels, 1.0)
    lacking = [label for label in labels if label not in stated]
    if lacking:
        raise CasperError(f"some goals have a prior, so all need one; it lacks for {', '.join(lacking)}", where)
    total = math.fsum(stated.values())
    if abs(total - 1) > TOLERANCE:
        raise CasperError(f"the priors sum to {total:g}, not to 1", where)
    return stated
