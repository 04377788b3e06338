"""What a kernel is: it counts, level after level, and `teller` says what the counts mean.

A *level* is all that was counted after some observations; it is never changed once made, so an undo drops it and forks
share it. Where explanations *weigh* something, that is prior times price times score, without the price of those
needless observations that all explanations have: it would underflow.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, Generic, NamedTuple, TypeAlias, TypeVar

from casper.engine.recognition.scoring import Score, least_tie, paper, posterior_by
from casper.engine.verification.binding import Binding
from casper.engine.verification.matching import Matcher
from casper.engine.verification.mismatch import Mismatch
from casper.engine.verification.observation import Seen
from casper.plans.trees.plan import Plan

L = TypeVar("L")
T = TypeVar("T", bound=tuple[Any, ...])
Plans: TypeAlias = tuple[int, ...]  # the plans pursued, one for each goal, in the order of the library
Parts: TypeAlias = tuple[tuple[int, int, Binding], ...]  # per plan pursued: plan, mask of closed leaves, binding
Marks: TypeAlias = tuple[int, ...]  # a leaf for every observation, or NEEDLESS
NEEDLESS = -1  # the mark of an observation that was taken for no leaf

Top: TypeAlias = tuple[float, Plans, int, int]
"""The best explanations that end somewhere: what each weighs, their plans, how many leaves they miss, their number."""
Leading: TypeAlias = tuple[float, Plans, int, int, int]
"""The best explanation, by weight and then by plans: what it weighs, its plans, the fewest leaves that one of its
goals' misses, explanations of other goals that tie with it, and all that do, itself among them."""


class Path(NamedTuple):
    """One explanation: per plan pursued its marked leaves and binding, and the observations that are needless.

    ``size`` and ``missed`` count leaves of all its plans; ``likelihood`` is that of what it takes the observations for.
    """

    parts: tuple[tuple[int, tuple[int, ...], Binding], ...]
    needless: tuple[int, ...]
    size: int
    missed: int
    likelihood: float = 1.0


class Kernel(ABC, Generic[L]):
    """Counts explanations of some plans.

    ``matcher`` says what is known of their parameters before anything was seen, ``noise`` is the factor on a score for
    each needless observation (None allows none), ``priors`` are those of the plans' goals (None weighs all alike).
    """

    goals = 1  # how many may be pursued at once
    several = False  # whether explanations are told as of several goals
    asks = False  # whether parameters and the knowledge base count, and actions that were not made out for sure

    def __init__(
        self,
        plans: Sequence[Plan],
        matcher: Matcher,
        noise: float | None = None,
        priors: Sequence[float] | None = None,
        measure: Score = paper,
    ) -> None:
        self.plans, self.matcher = plans, matcher
        self.noise, self.measure = noise, measure
        self.priors = priors or (1.0,) * len(plans)
        self.evenly = all(prior == 1.0 for prior in self.priors)
        self.labels = [plan.label for plan in plans]
        self.index = {label: at for at, label in enumerate(dict.fromkeys(self.labels))}

    @abstractmethod
    def begin(self) -> L:
        """The level before the first observation."""

    @abstractmethod
    def advance(self, level: L, seen: Seen, matcher: Matcher) -> L:
        """The next level."""

    @abstractmethod
    def count(self, level: L) -> int:
        """The exact number of explanations; before the first observation, of plans."""

    @abstractmethod
    def alive(self, level: L) -> set[int]:
        """The plans that take part in an explanation."""

    @abstractmethod
    def masses(self, level: L) -> Sequence[float]:
        """Per plan the sum of the weights of the explanations that it takes part in."""

    def posterior(self, level: L) -> Mapping[str, float]:
        """Each goal's share of all weights."""
        return posterior_by(self.labels, self.masses(level), self.total(level))

    def total(self, level: L) -> float:
        """The sum of all weights."""
        return sum(self.masses(level))

    @abstractmethod
    def leading(self, level: L) -> Leading | None:
        """The best explanation and its rivals; None when there is none."""

    @abstractmethod
    def tops(self, level: L) -> Iterable[tuple[float, Plans]]:
        """What the best explanation weighs, once or oftener for each set of plans that explains anything."""

    @abstractmethod
    def ends(self, level: L) -> Iterator[tuple[Parts, float]]:
        """Where explanations end, and the sum of the weights of those that do there."""

    def best(self, level: L) -> tuple[float, Plans] | None:
        """What the best explanation weighs, and its plans."""
        leading = self.leading(level)
        return None if leading is None else leading[:2]

    def least(self, level: L) -> int:
        """The fewest needless observations of an explanation: weights leave out the price that all of them pay."""
        return 0

    def mismatches(self, level: L) -> Mapping[int, Sequence[Mismatch]]:
        """By plan, why it could not go on."""
        return {}

    def is_exact(self, level: L) -> bool:
        """Whether every explanation was counted."""
        return True

    def binding(self, plan: int) -> Binding:
        """What is known of a plan's parameters where only names count: nothing."""
        unknown = self.matcher.initial(plan)
        return (None,) * len(unknown) if isinstance(unknown, tuple) else ()

    def first_marks(self, level: L, plan: int, seen: Sequence[Seen]) -> Marks | None:
        """The first of a plan's best explanations, where it can be had without listing any."""
        return None

    def goals_of(self, plans: Plans) -> tuple[str, ...]:
        """The labels of the goals that the plans pursue, in the order of the library."""
        if len(plans) == 1:
            return (self.labels[plans[0]],)
        return tuple(sorted([self.labels[plan] for plan in plans], key=self.index.__getitem__))

    def leading_of(self, tops: Sequence[Top]) -> Leading | None:
        """The best of these and its rivals."""
        equal = best_of(tops)
        if len(equal) <= 1:
            return (*equal[0][:3], 0, equal[0][3]) if equal else None
        weight, plans = min([(-top[0], top[1]) for top in equal])
        goals = self.goals_of(plans)
        same = [top for top in equal if top[1] == plans or self.goals_of(top[1]) == goals]
        ties, ours = sum([top[3] for top in equal]), sum([top[3] for top in same])
        return -weight, plans, min([top[2] for top in same]), ties - ours, ties


def best_of(tops: Sequence[T]) -> list[T]:
    """Those that weigh as much as the best."""
    least = least_tie(max([top[0] for top in tops], default=0.0))
    return [top for top in tops if top[0] >= least]
