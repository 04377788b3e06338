"""Which engine reads a partner: one interface, and the choice among those that give the same answers."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol, Self

from casper.engine.explanation.explanation import Explanation, Interleaved
from casper.engine.recognition.counting import Counting
from casper.engine.recognition.scoring import Score, paper
from casper.engine.recognition.standing import Standing
from casper.engine.recognition.states import MOST_STATES
from casper.engine.verification.matching import Binding, Matcher, Mismatch, NameMatcher, ParameterMatcher
from casper.engine.verification.observation import Seen
from casper.kb.errors import CasperError
from casper.plans.trees.plan import Plan

MANY_PAIRS = 5
MANY_LEAVES = 400  # of one name: from here on arrays beat plain Python (benchmarks/recognition/growth.py)
MANY_NOISY_LEAVES = 12  # the same where observations may be needless: a state more for each needless one
MANY_PLANS = 2000  # here too: a posterior is no longer copied for each observation


class Recogniser(Protocol):
    """What a reading asks of its engine. Levels count from 0, before the first observation."""

    observations: list[Seen]

    @property
    def mismatches(self) -> Sequence[Mapping[int, Sequence[Mismatch]]]:
        """After each observation, by plan, the reasons why it could not go on."""

    @property
    def count(self) -> int:
        """The exact number of explanations; before the first observation, of plans."""

    @property
    def is_exact(self) -> bool:
        """Whether every explanation was counted; otherwise counts and sums are lower bounds."""

    def observe(self, seen: Seen) -> None:
        """Take in an observation."""

    def undo(self) -> None:
        """Take back the last one."""

    def fork(self) -> Self:
        """A copy that goes its own way."""

    def alive(self, level: int) -> set[int]:
        """The plans that take part in explaining the first so many observations."""

    def posterior(self) -> Mapping[str, float]:
        """Each goal's probability of being pursued."""

    def standing(self) -> Standing | None:
        """The best explanation and its rivals."""

    def first(self, goal: str | None = None) -> Explanation | Interleaved | None:
        """The best explanation, of all or of a goal (goals pursued together are joined by " + "); None for none."""

    def explanations(self) -> Iterator[Explanation | Interleaved]:
        """Every explanation, best first, lazily."""

    def ends(self) -> Iterator[tuple[tuple[tuple[int, int, Binding], ...], float]]:
        """Where explanations end: per goal pursued (plan, mask of closed leaves, binding), and their share."""


@dataclass(frozen=True, slots=True)
class Options:
    """What may be switched on: everything off is the paper's recogniser.

    ``noise`` is the factor on a score for each needless or misread observation (None: there are none), ``goals`` how
    many goals may be pursued at once, ``priors`` each goal's prior by label, ``measure`` the score, ``budget`` how many
    states may be kept (None: 20,000; of two goals at once 50,000, of more 3,000).
    """

    noise: float | None = None
    goals: int = 1
    priors: Mapping[str, float] | None = None
    measure: Score = paper
    budget: int | None = None

    def check(self) -> None:
        """Refuse what makes no sense.

        Raises:
            CasperError: a price that is no number above 0 and at most 1, or no whole number of goals above 0.
        """
        noise: Any = self.noise
        if noise is not None and (not _is_number(noise) or not 0 < noise <= 1):
            raise CasperError(f"the price of a needless observation is a factor above 0 and at most 1, not {noise}")
        if isinstance(self.goals, bool) or not isinstance(self.goals, int) or self.goals < 1:
            raise CasperError(f"the number of goals pursued at once is a whole number from 1, not {self.goals}")
        budget: Any = self.budget
        if budget is not None and (isinstance(budget, bool) or not isinstance(budget, int) or budget < 1):
            raise CasperError(f"a budget is a whole number of states from 1, not {budget}")


PAPER = Options()


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def recogniser(plans: Sequence[Plan], matcher: Matcher, options: Options) -> Recogniser:
    """The fastest engine that does what is asked."""
    options.check()
    by_name = options.measure is paper and _by_name(plans, matcher)
    priors = [options.priors[plan.label] for plan in plans] if options.priors else None
    plain = by_name and options.noise is None
    if options.goals > 1:
        from casper.engine.recognition.interleaving import Interleaving

        if plain and options.goals == 2 and len(plans) >= MANY_PAIRS and _has_numpy():
            from casper.engine.recognition.pairs import Pairs, fits

            if fits(plans):
                return Pairs(plans, matcher, priors)
        elif by_name and options.goals == 2 and len(plans) >= MANY_PAIRS and _has_numpy():
            from casper.engine.recognition import noisy_pairs

            if options.noise is not None and noisy_pairs.fits(plans):
                return noisy_pairs.NoisyPairs(plans, matcher, options.noise, priors)
        return Interleaving(plans, matcher, options.goals, options.noise, priors, options.measure, options.budget)
    if by_name and options.noise is not None and _leaves_looked_at(plans) >= MANY_NOISY_LEAVES and _has_numpy():
        from casper.engine.recognition.noisy_arrays import NoisyArrays

        return NoisyArrays(plans, matcher, options.noise, priors)
    if not plain:
        budget = options.budget or MOST_STATES
        return Counting(plans, matcher, options.noise, priors, options.measure, budget)
    if not _is_large(plans) or not _has_numpy():
        from casper.engine.recognition.chains import Chains

        return Chains(plans, matcher, priors)
    from casper.engine.recognition.arrays import Arrays

    return Arrays(plans, matcher, priors)


def _by_name(plans: Sequence[Plan], matcher: Matcher) -> bool:
    """Whether nothing but the order of names matters."""
    named = type(matcher) is NameMatcher
    if not named and type(matcher) is ParameterMatcher:
        named = all(len(leaf) == 1 for plan in plans for leaf in plan.leaves)
    return named and all(plan.is_plain for plan in plans)


def _is_large(plans: Sequence[Plan]) -> bool:
    """Whether an observation has so many leaves to look at that arrays pay."""
    return len(plans) >= MANY_PLANS or _leaves_looked_at(plans) >= MANY_LEAVES


def _leaves_looked_at(plans: Sequence[Plan]) -> float:
    """How many leaves have an observation's name, on average."""
    names = Counter(leaf[0] for plan in plans for leaf in plan.leaves)
    return sum(number * number for number in names.values()) / sum(names.values())


def _has_numpy() -> bool:
    from importlib.util import find_spec

    return find_spec("numpy") is not None
