"""Which kernel counts for a partner: a table, of which the first row that fits is taken.

All give the same answers where they fit; `tree_copying` and brute force (tests) say which.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from importlib.util import find_spec
from typing import Any, NamedTuple

from casper.engine.recognition.arrays.arrays import Arrays
from casper.engine.recognition.arrays.noisy_arrays import NoisyArrays
from casper.engine.recognition.arrays.pair_states import fits
from casper.engine.recognition.arrays.pairs import Pairs
from casper.engine.recognition.kernels.chains import Chains
from casper.engine.recognition.kernels.counting import Counting, Interleaving
from casper.engine.recognition.kernels.kernel import Kernel
from casper.engine.recognition.options import Options
from casper.engine.recognition.scoring import paper
from casper.engine.recognition.teller import Teller
from casper.engine.verification.matching import Matcher, NameMatcher, ParameterMatcher
from casper.plans.trees.plan import Plan

MANY_PAIRS = 5
MANY_LEAVES = 400  # of one name: from here on arrays beat plain Python (benchmarks/recognition/growth.py)
MANY_NOISY_LEAVES = 12  # the same where observations may be needless: a state more for each needless one
MANY_PLANS = 2000  # here too: a posterior is no longer copied for each observation


@dataclass(frozen=True)
class Wanted:
    """What is to be counted."""

    plans: Sequence[Plan]
    matcher: Matcher
    options: Options
    priors: Sequence[float] | None

    @property
    def noisy(self) -> bool:
        """Whether observations may be needless."""
        return self.options.noise is not None

    @cached_property
    def by_name(self) -> bool:
        """Whether nothing but the order of names matters, and the score is the paper's."""
        named = type(self.matcher) is NameMatcher
        if not named and type(self.matcher) is ParameterMatcher:
            named = all(len(leaf) == 1 for plan in self.plans for leaf in plan.leaves)
            named = named and not any(plan.says_who for plan in self.plans)
        return named and self.options.measure is paper and all(plan.is_plain for plan in self.plans)

    @cached_property
    def is_large(self) -> bool:
        """Whether an observation has on average so many leaves of its name that arrays pay; and there is numpy."""
        names = Counter(leaf[0] for plan in self.plans for leaf in plan.leaves)
        of_a_name = sum(number * number for number in names.values()) / sum(names.values())
        many = of_a_name >= (MANY_NOISY_LEAVES if self.noisy else MANY_LEAVES)
        return (many or (not self.noisy and len(self.plans) >= MANY_PLANS)) and find_spec("numpy") is not None

    @property
    def pairs_fit(self) -> bool:
        """Whether there are pairs enough for arrays, and they fit into memory; and there is numpy."""
        return len(self.plans) >= MANY_PAIRS and find_spec("numpy") is not None and fits(self.plans, self.noisy)


class Row(NamedTuple):
    """A kernel, when it is taken, and why then."""

    reason: str
    fits: Callable[[Wanted], bool]
    make: Callable[[Wanted], Kernel[Any]]


TABLE = (
    Row(
        "small libraries of rows of names: a look-up for each leaf of the name, a few µs",
        lambda w: w.options.goals == 1 and w.by_name and not w.noisy and not w.is_large,
        lambda w: Chains(w.plans, w.matcher, w.priors),
    ),
    Row(
        "large ones: all leaves of all goals in one sum",
        lambda w: w.options.goals == 1 and w.by_name and not w.noisy,
        lambda w: Arrays(w.plans, w.matcher, w.priors),
    ),
    Row(
        "large ones with needless actions: the same, for each number of marked ones",
        lambda w: w.options.goals == 1 and w.by_name and w.is_large,
        lambda w: NoisyArrays(w.plans, w.matcher, w.options.noise or 1.0, w.priors),
    ),
    Row(
        "one goal whatever its plans and its matcher are: state by state",
        lambda w: w.options.goals == 1,
        lambda w: Counting(w.plans, w.matcher, w.options.noise, w.priors, w.options.measure, w.options.budget),
    ),
    Row(
        "two goals of rows of names, needless actions or none: all pairs of leaves, exactly",
        lambda w: w.options.goals == 2 and w.by_name and w.pairs_fit,
        lambda w: Pairs(w.plans, w.matcher, w.options.noise, w.priors),
    ),
    Row(
        "everything else: hypotheses of plans and states, the most promising where there are too many",
        lambda w: True,
        lambda w: Interleaving(
            w.plans, w.matcher, w.options.goals, w.options.noise, w.priors, w.options.measure, w.options.budget
        ),
    ),
)


def recogniser(plans: Sequence[Plan], matcher: Matcher, options: Options) -> Teller:
    """The fastest recogniser that does what is asked.

    Raises:
        CasperError: options that make no sense.
    """
    options.check()
    priors = [options.priors[plan.label] for plan in plans] if options.priors else None
    wanted = Wanted(plans, matcher, options, priors)
    row = next(row for row in TABLE if row.fits(wanted))
    return Teller(row.make(wanted), matcher)
