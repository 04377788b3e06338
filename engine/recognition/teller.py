"""The teller: what the counts of a kernel mean, whichever kernel it is.

    >>> engine = Teller(Counting(plans, matcher), matcher)
    >>> engine.observe(Observation("eat"))
    >>> engine.count, engine.posterior(), engine.standing(), engine.first()
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from casper.engine.explanation.explanation import Explanation, Interleaved
from casper.engine.recognition.kernels.kernel import Kernel, Parts, Plans
from casper.engine.recognition.kernels.moves import is_certain
from casper.engine.recognition.listing import Explanations, levels_of, listing
from casper.engine.recognition.standing import Standing
from casper.engine.verification.matching import Matcher
from casper.engine.verification.mismatch import Mismatch
from casper.engine.verification.observation import Observation, Seen, Uncertain, options_of


class Teller:
    """What a kernel says of a growing list of observations. Levels count from 0, before the first one."""

    def __init__(self, kernel: Kernel[Any], matcher: Matcher) -> None:
        self.kernel, self.matcher = kernel, matcher
        self.observations: list[Seen] = []
        self._levels: list[Any] = [kernel.begin()]

    def observe(self, seen: Seen) -> None:
        """Take in an observation; where nothing comes of it because something raised, nothing was taken in."""
        kernel = self.kernel
        if not kernel.asks and isinstance(seen, Uncertain):
            kernel = self._hand_over()
        level = kernel.advance(self._levels[-1], seen, self.matcher)
        if kernel.asks:
            self.matcher.observed(options_of(seen)[0][0] if is_certain(seen) else Observation(seen.action))
        self._levels.append(level)
        self.observations.append(seen)

    def _hand_over(self) -> Kernel[Any]:
        """Go on with a kernel that takes uncertain actions, from where this one is."""
        kernel = listing(self.kernel, self.kernel.plans, self.matcher, self.kernel.priors)
        self._levels = list(levels_of(kernel, self.observations, self.matcher))
        self.kernel = kernel
        return kernel

    def undo(self) -> None:
        """Take back the last observation."""
        self.observations.pop()
        self._levels.pop()
        if self.kernel.asks:
            self.matcher.forget()

    def fork(self) -> Teller:
        """A copy that goes its own way; what was counted so far is shared."""
        other = object.__new__(Teller)
        other.kernel, other.matcher = self.kernel, self.matcher.fork()
        other.observations, other._levels = self.observations.copy(), self._levels.copy()
        return other

    @property
    def level(self) -> Any:
        """What the kernel counted."""
        return self._levels[-1]

    @property
    def mismatches(self) -> Sequence[Mapping[int, Sequence[Mismatch]]]:
        """After each observation, by plan, the reasons why it could not go on."""
        return [self.kernel.mismatches(level) for level in self._levels]

    @property
    def is_exact(self) -> bool:
        """Whether every explanation was counted; otherwise counts and sums are lower bounds."""
        return self.kernel.is_exact(self._levels[-1])

    @property
    def count(self) -> int:
        """The exact number of explanations; before the first observation, of plans."""
        return self.kernel.count(self._levels[-1])

    def alive(self, level: int) -> set[int]:
        """The plans that take part in explaining the first so many observations."""
        return self.kernel.alive(self._levels[level])

    def posterior(self) -> Mapping[str, float]:
        """Each goal's probability of being pursued: its share of all weights."""
        return self.kernel.posterior(self._levels[-1])

    def best(self) -> tuple[float, Plans] | None:
        """What the best explanation weighs, and its plans."""
        return self.kernel.best(self._levels[-1])

    def standing(self) -> Standing | None:
        """The best explanation and its rivals; None when there is none."""
        leading = self.kernel.leading(self._levels[-1])
        if leading is None:
            return None
        _, plans, missed, rivals, ties = leading
        return Standing(self.kernel.count(self._levels[-1]), self._goal(plans), missed, rivals, ties)

    def _goal(self, plans: Plans) -> str:
        return " + ".join(self.kernel.goals_of(plans))

    def ends(self) -> Iterator[tuple[Parts, float]]:
        """Where explanations end: per goal pursued (plan, mask of closed leaves, binding), and their share."""
        if self.observations:
            whole = self.kernel.total(self._levels[-1])
            for parts, mass in self.kernel.ends(self._levels[-1]):
                yield parts, mass / whole if whole else 0.0

    def first(self, goal: str | None = None) -> Explanation | Interleaved | None:
        """The best explanation, of all or of a goal (goals pursued together are joined by " + "); None for none."""
        if not self.observations:
            return None
        if goal is None:
            best = self.kernel.best(self._levels[-1])
        else:
            tops = [top for top in self.kernel.tops(self._levels[-1]) if self._goal(top[1]) == goal]
            best = min(tops, key=lambda top: (-top[0], top[1]), default=None)
        return None if best is None else self._list().first(best[1])

    def explanations(self) -> Iterator[Explanation | Interleaved]:
        """Every explanation, best first, lazily: by weight, then plans, then marks."""
        return self._list().all() if self.observations else iter(())

    def _list(self) -> Explanations:
        return Explanations(self.kernel, self._levels[-1], self.observations)
