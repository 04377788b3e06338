"""What the fast engines share: they count in numbers of their own, and hand over to `Counting` for single explanations.

Their plans are chains, their observations names. Explanations of a plan are listed by counting it once more, alone.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Mapping, Sequence
from heapq import heapify, heappop, heappush
from itertools import islice
from typing import Any, Self

from casper.engine.explanation.explanation import Explanation
from casper.engine.recognition.counting import Counting, posterior_by
from casper.engine.recognition.standing import Standing
from casper.engine.verification.matching import Binding, Matcher, Mismatch, NameMatcher
from casper.engine.verification.observation import Seen
from casper.plans.trees.plan import Plan


class Replay(ABC):
    """An engine for chains by names; priors weigh, everything else is as the paper has it."""

    def __init__(self, plans: Sequence[Plan], matcher: Matcher, priors: Sequence[float] | None = None) -> None:
        self.plans, self.matcher = plans, matcher
        self.priors = priors or (1.0,) * len(plans)
        self.evenly = all(prior == 1.0 for prior in self.priors)
        self.labels = [plan.label for plan in plans]
        self.observations: list[Seen] = []

    @property
    def mismatches(self) -> Sequence[Mapping[int, Sequence[Mismatch]]]:
        """No name ever clashes with a parameter."""
        return ({},) * (len(self.observations) + 1)

    @property
    def is_exact(self) -> bool:
        """Every explanation is counted."""
        return True

    def counting(self) -> Counting:
        """The same as a `Counting`, which takes uncertain observations too."""
        counting = Counting(self.plans, self.matcher, priors=self.priors)
        for seen in self.observations:
            counting.observe(seen)
        return counting

    @abstractmethod
    def ends(self) -> Iterator[tuple[tuple[tuple[int, int, Binding], ...], float]]:
        """Where explanations end: (plan, mask of closed leaves, binding), and the share of all scores."""

    def undo(self) -> None:
        """Take back the last observation."""
        self.observations.pop()

    def fork(self) -> Self:
        """A copy that goes its own way."""
        other = object.__new__(type(self))
        other.__dict__.update(self.__dict__)
        other.observations = list(self.observations)
        return other

    @abstractmethod
    def observe(self, seen: Seen) -> None:
        """Advance every plan that has the action."""

    @abstractmethod
    def alive(self, level: int) -> set[int]:
        """The plans that explain the first so many observations."""

    @property
    @abstractmethod
    def count(self) -> int:
        """The exact number of explanations; before the first observation, of plans."""

    @abstractmethod
    def score_sums(self) -> list[float]:
        """Per plan the sum of the scores of its explanations."""

    @abstractmethod
    def tops(self) -> Iterable[tuple[float, int, int, int]]:
        """Per plan that explains the observations: weight of its best explanation, plan, leaves right of it, ties."""

    @abstractmethod
    def standing(self) -> Standing | None:
        """The best explanation and its rivals; None when there is none."""

    def posterior(self) -> Mapping[str, float]:
        """Each goal's share of the sum of all scores, weighed by its prior."""
        return posterior_by(self.labels, [p * s for p, s in zip(self.priors, self.score_sums())])

    def total(self) -> float:
        """The sum of all scores, weighed by priors."""
        return sum([p * s for p, s in zip(self.priors, self.score_sums())])

    @abstractmethod
    def best(self) -> tuple[float, int, int, int] | None:
        """The best explanation: weight, plan, leaves right of its last marked one, ties."""

    def first(self, goal: str | None = None) -> Explanation | None:
        """The best explanation, of all or of one goal; None when there is none."""
        if goal is not None:
            return self.first_of(goal)
        best = self.best()
        return None if best is None else self._leftmost(best[1], self.total())

    def first_of(self, goal: str) -> Explanation | None:
        """The best explanation of a goal: its plans are looked at one by one."""
        alive, whole = self.alive(len(self.observations)), self.total()
        plans = [plan for plan, label in enumerate(self.labels) if label == goal and plan in alive]
        found = [next(self._alone(plan, whole), None) for plan in plans]
        return max((best for best in found if best is not None), key=lambda best: best.share, default=None)

    def explanations(self) -> Iterator[Explanation]:
        """Every explanation, best first, lazily: by weight, then plan, then marked leaves."""
        best = self.best()
        if best is None:
            return
        whole, first = self.total(), best[1]
        yield self._leftmost(first, whole)
        heap: list[tuple[float, int, tuple[int, ...], Explanation | None, Iterator[Explanation] | None]] = []
        for weight, plan, _, _ in self.tops():
            if plan != first:
                heap.append((-weight / whole, plan, (), None, None))
        heapify(heap)
        self._go_on(heap, first, self._rest(first, whole))
        while heap:
            _, plan, _, found, rest = heappop(heap)
            yield found if found is not None else self._leftmost(plan, whole)
            self._go_on(heap, plan, rest if rest is not None else self._rest(plan, whole))

    def _go_on(self, heap: list[Any], plan: int, rest: Iterator[Explanation]) -> None:
        following = next(rest, None)
        if following is not None:
            heappush(heap, (-following.share, plan, following.marks, following, rest))

    def _leftmost(self, plan: int, whole: float) -> Explanation:
        """The best explanation of a plan: every observation is the first leaf that it can be."""
        leaves, at, marks = self.plans[plan].leaves, 0, []
        for seen in self.observations:
            while leaves[at][0] != seen.action:
                at += 1
            marks.append(at)
            at += 1
        return self._told(plan, tuple(marks), whole)

    def _told(self, plan: int, marks: tuple[int, ...], whole: float) -> Explanation:
        leaves, k = len(self.plans[plan].leaves), len(marks)
        score = k * (leaves - marks[-1] - 1 + k) / (leaves * leaves) if marks else 0.0
        share = self.priors[plan] * score / whole if whole else 0.0
        return Explanation(self.plans[plan], marks, self._binding(plan), score, share)

    def _rest(self, plan: int, whole: float) -> Iterator[Explanation]:
        """The explanations of one plan but the best."""
        return islice(self._alone(plan, whole), 1, None)

    def _alone(self, plan: int, whole: float) -> Iterator[Explanation]:
        """The explanations of one plan, best first."""
        counting = Counting((self.plans[plan],), NameMatcher((self.plans[plan],)))
        for seen in self.observations:
            counting.observe(seen)
        for found in counting.stream():
            yield self._told(plan, found.marks, whole)

    def _binding(self, plan: int) -> tuple[None, ...]:
        binding = self.matcher.initial(plan)
        return (None,) * len(binding) if isinstance(binding, tuple) else ()
