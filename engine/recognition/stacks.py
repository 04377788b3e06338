"""What an engine keeps after each observation: stacks that grow and shrink together, so that undoing is popping."""

from __future__ import annotations

from typing import ClassVar, Self

from casper.engine.verification.matching import Matcher, Mismatch
from casper.engine.verification.observation import Seen


class Stacks:
    """One entry for each observation on every stack of ``STACKS``; entries are never changed, so forks share them.

    ``mismatches`` and ``exact`` have one entry more, for what was before the first observation.
    """

    STACKS: ClassVar[tuple[str, ...]] = ("observations", "mismatches", "exact")

    def __init__(self, matcher: Matcher) -> None:
        self.matcher = matcher
        self.observations: list[Seen] = []
        self._noted: dict[int, list[Mismatch]] = {}
        self.mismatches = [self._noted]  # after each observation, by plan: why it was cut
        self.exact = [True]

    @property
    def is_exact(self) -> bool:
        """Whether every explanation was counted; otherwise counts and sums are lower bounds."""
        return self.exact[-1]

    def undo(self) -> None:
        """Take back the last observation."""
        for name in self.STACKS:
            getattr(self, name).pop()
        self.matcher.forget()

    def fork(self) -> Self:
        """A copy that goes its own way; what was counted so far is shared."""
        other = object.__new__(type(self))
        other.__dict__.update(self.__dict__)
        other.matcher = self.matcher.fork()
        for name in self.STACKS:
            setattr(other, name, list(getattr(self, name)))
        return other

    def _note(self, plan: int, mismatch: Mismatch) -> None:
        """Remember why a plan was cut by the observation that is being taken in."""
        self._noted.setdefault(plan, []).append(mismatch)
