"""Single explanations, best first.

They come from a kernel that keeps what led to each of its states. Those for chains by names count in numbers of their
own; the explanations of a set of plans are then listed by counting these once more, alone.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from heapq import heapify, heappop, heappush
from itertools import count
from typing import Any

from casper.engine.explanation.explanation import Explanation, Interleaved
from casper.engine.recognition.kernels.counting import Counting, Interleaving
from casper.engine.recognition.kernels.kernel import NEEDLESS, Kernel, Path, Plans
from casper.engine.verification.matching import Matcher, NameMatcher
from casper.engine.verification.observation import Seen
from casper.plans.trees.plan import Plan

UNBOUNDED = 1 << 60  # states


class Explanations:
    """The explanations that a kernel counted at a level, of the observations so far."""

    def __init__(self, kernel: Kernel[Any], level: Any, seen: Sequence[Seen]) -> None:
        self.kernel, self.level, self.seen = kernel, level, seen
        self._whole, self._least = kernel.total(level), kernel.least(level)

    def first(self, plans: Plans) -> Explanation | Interleaved:
        """The best explanation of exactly these plans."""
        kernel = self.kernel
        marks = kernel.first_marks(self.level, plans[0], self.seen)
        if marks is None:
            return self._told(next(self._paths(plans)))
        plan = kernel.plans[plans[0]]
        needless: tuple[int, ...] = ()
        if kernel.noise is not None:
            needless = tuple([at for at, leaf in enumerate(marks) if leaf == NEEDLESS])
            marks = tuple([leaf for leaf in marks if leaf != NEEDLESS])
        missed = marks[-1] + 1 - len(marks)
        score, weight = self._scored(plans, len(plan.leaves), missed, len(needless))
        return Explanation(plan, marks, kernel.binding(plans[0]), score, self._share(weight), needless)

    def all(self) -> Iterator[Explanation | Interleaved]:
        """Every explanation, lazily: by weight, then plans, then marks."""
        bounds: dict[Plans, float] = {}
        for weight, plans in self.kernel.tops(self.level):
            bounds[plans] = max(weight, bounds.get(plans, weight))
        order = count()
        heap: list[tuple[float, Plans, int, Path | None, Iterator[Path]]] = [
            (-weight, plans, next(order), None, self._paths(plans)) for plans, weight in bounds.items()
        ]
        heapify(heap)
        while heap:
            _, plans, _, path, rest = heappop(heap)
            if path is not None:
                yield self._told(path)
            following = next(rest, None)
            if following is not None:
                heappush(heap, (-self._score_of(following)[1], plans, next(order), following, rest))

    def _paths(self, plans: Plans) -> Iterator[Path]:
        """The explanations of exactly these plans, best first."""
        if isinstance(self.kernel, Counting):
            yield from self.kernel.paths(self.level, plans)
            return
        chosen = [self.kernel.plans[plan] for plan in plans]
        matcher = NameMatcher(chosen)
        alone = listing(self.kernel, chosen, matcher, budget=UNBOUNDED)
        *_, level = levels_of(alone, self.seen, matcher)
        for path in alone.paths(level, tuple(range(len(plans)))):
            parts = tuple((plans[at], leaves, self.kernel.binding(plans[at])) for at, leaves, _ in path.parts)
            yield Path(parts, path.needless, path.size, path.missed)

    def _scored(
        self, plans: Plans, size: int, missed: int, needless: int, likelihood: float = 1.0
    ) -> tuple[float, float]:
        """The score, and what the explanation weighs."""
        kernel, prior = self.kernel, likelihood
        above, below = kernel.measure(size, len(self.seen) - needless, missed)
        for plan in plans:
            prior *= kernel.priors[plan]
        score = above / below
        if kernel.noise is None:
            return score * likelihood, score * prior
        weight = kernel.noise ** (needless - self._least) * score
        return kernel.noise**needless * score * likelihood, weight * prior

    def _share(self, weight: float) -> float:
        return weight / self._whole if self._whole else 0.0

    def _told(self, path: Path) -> Explanation | Interleaved:
        plans, index = self.kernel.plans, self.kernel.index
        score, weight = self._score_of(path)
        share = self._share(weight)
        parts = sorted(path.parts, key=lambda part: index[plans[part[0]].label])
        if not self.kernel.several:
            ((plan, leaves, binding),) = parts
            return Explanation(plans[plan], leaves, binding, score, share, path.needless)
        told = tuple(Explanation(plans[plan], leaves, binding, score, share) for plan, leaves, binding in parts)
        return Interleaved(told, score, share, path.needless)

    def _score_of(self, path: Path) -> tuple[float, float]:
        plans = tuple([plan for plan, _, _ in path.parts])
        return self._scored(plans, path.size, path.missed, len(path.needless), path.likelihood)


def listing(
    kernel: Kernel[Any],
    plans: Sequence[Plan],
    matcher: Matcher,
    priors: Sequence[float] | None = None,
    budget: int | None = None,
) -> Counting:
    """A kernel that counts these plans as the given one counts its own, and can list."""
    if not kernel.several:
        return Counting(plans, matcher, kernel.noise, priors, kernel.measure, budget)
    return Interleaving(plans, matcher, kernel.goals, kernel.noise, priors, kernel.measure, budget)


def levels_of(kernel: Kernel[Any], seen: Sequence[Seen], matcher: Matcher) -> Iterator[Any]:
    """The levels of a kernel that makes these observations, from that before the first."""
    level = kernel.begin()
    yield level
    for one in seen:
        yield (level := kernel.advance(level, one, matcher))
