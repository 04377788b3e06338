"""Observations: the partner's actions as they reach the explainer, with or without their arguments."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from difflib import get_close_matches
from typing import Any, TypeAlias

from casper.kb.errors import CasperError, PlanError
from casper.kb.terms.numbers import as_float
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, Variable, as_term, predication
from casper.kb.text.reader import read_statement


@dataclass(frozen=True, slots=True)
class Observation:
    """An action of the partner: its name, and its arguments where they are known.

    ``args`` is None when only the name was seen; an argument that was not made out is a `Variable`. ``t`` is when it
    was seen (seconds), where somebody looked at a clock; ``certainty`` how probable it is that it was seen.
    """

    action: str
    args: tuple[Term, ...] | None = None
    t: float | None = field(default=None, compare=False)
    certainty: float = field(default=1.0, compare=False)
    is_plain: bool = field(init=False, repr=False, compare=False)  # whether all its arguments are constants

    def __post_init__(self) -> None:
        plain = self.args is not None and not any(isinstance(arg, (Variable, tuple)) for arg in self.args)
        object.__setattr__(self, "is_plain", plain)

    @property
    def known_args(self) -> int:
        """How many arguments are known."""
        return sum(not isinstance(arg, Variable) for arg in self.args or ())

    def __str__(self) -> str:
        return self.action if self.args is None else term_text(as_term(Compound((self.action, *self.args))))


@dataclass(frozen=True, slots=True)
class Uncertain:
    """An action that was not made out for sure: what it may have been, with the likelihood of each.

    Each explanation is weighed by the likelihood of what it takes the action for.
    """

    options: tuple[tuple[Observation, float], ...]

    @property
    def action(self) -> str:
        """The likeliest action's name."""
        return max(self.options, key=lambda option: option[1])[0].action

    def __str__(self) -> str:
        return " | ".join(f"{observation}: {likelihood:g}" for observation, likelihood in self.options)


Seen: TypeAlias = Observation | Uncertain
Observed: TypeAlias = "str | Compound | tuple[Term, ...] | Observation | Uncertain | Mapping[Any, float]"


def at_time(seen: Seen, t: float | None) -> Seen:
    """What was seen, with its time (seconds); as it is where that is None."""
    if t is None:
        return seen
    if isinstance(seen, Observation):
        return replace(seen, t=t)
    return Uncertain(tuple((replace(option, t=t), likelihood) for option, likelihood in seen.options))


def certainty_of(seen: Seen) -> float:
    """How probable it is that what was seen was what it is most likely to have been."""
    if isinstance(seen, Uncertain):
        return max((likelihood for _, likelihood in seen.options), default=0.0)
    return seen.certainty


def options_of(seen: Seen) -> tuple[tuple[Observation, float], ...]:
    """What was seen as observations with their likelihoods; a plain one is certain."""
    return seen.options if isinstance(seen, Uncertain) else ((seen, 1.0),)


def seen_of(observed: Observed, actions: Iterable[tuple[str, int]]) -> Seen:
    """An observation, or an uncertain one of a mapping ``{"eat": 0.7, "sip": 0.2}``.

    Raises:
        ReadError, PlanError: as `observation_of`.
        CasperError: a likelihood is not above 0, or they sum to more than 1.
    """
    if isinstance(observed, Uncertain):
        observed = dict(observed.options)
    if not isinstance(observed, Mapping):
        return observation_of(observed, actions)
    likelihoods: dict[Observation, float] = {}
    for option, likelihood in observed.items():
        weight = as_float(likelihood)
        if not 0 < weight < math.inf:
            raise CasperError(f"the likelihood of {option} is {likelihood!r:.40}: it must be a number above 0")
        if weight > 1 + 1e-9:
            raise CasperError(f"the likelihoods of an uncertain action must sum to at most 1, not {weight:g}")
        seen = observation_of(option, actions)
        likelihoods[seen] = likelihoods.get(seen, 0.0) + weight
    total = math.fsum(likelihoods.values())
    if not 0 < total <= 1 + 1e-9:
        raise CasperError(f"the likelihoods of an uncertain action must sum to at most 1, not {total:g}")
    return Uncertain(tuple(likelihoods.items()))


def observation_of(
    observed: str | Compound | tuple[Term, ...] | Observation, actions: Iterable[tuple[str, int]]
) -> Observation:
    """Make an observation of text (``eat`` or ``eat(biscuits, plate)``), a term, or an observation.

    Args:
        observed: what was seen; the agent is left out, it is the partner.
        actions: the library's terminals by name and arity.

    Raises:
        ReadError: the text is no action.
        PlanError: no plan has the action, or not with this many arguments; the sentence says what may be meant.
    """
    if isinstance(observed, Observation):
        seen = observed
    else:
        term = read_statement(observed) if isinstance(observed, str) else predication(observed)
        seen = Observation(term.functor, term.args if len(term) > 1 else None)
    arities = sorted({arity for name, arity in actions if name == seen.action})
    if not arities:
        names = sorted({name for name, _ in actions})
        close = get_close_matches(seen.action, names, n=1)
        hint = f"did you mean {close[0]}?" if close else f"the plans have {', '.join(names)}"
        raise PlanError(f"no plan has the action {seen.action}; {hint}")
    if seen.args is not None and len(seen.args) not in arities:
        takes = " or ".join(map(str, arities))
        raise PlanError(f"{seen.action} takes {takes} arguments here (the agent is left out), not {len(seen.args)}")
    if seen.args is None and arities == [0]:
        return Observation(seen.action, (), seen.t)
    return seen
