"""Where an instance of a goal stands in a plan that is listed, and whose verdicts decide how it goes on."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, Protocol, TypeAlias, runtime_checkable

from casper.engine.episodes.past import Past
from casper.engine.verification.binding import Binding, Slot
from casper.engine.verification.matching import Matcher
from casper.kb.terms.terms import Compound


@runtime_checkable
class LooksBack(Protocol):
    """A matcher whose verdicts depend on who acts, and may depend on what was done earlier."""

    partner: str  # whom observations are of that name nobody

    @property
    def changes(self) -> int:
        """How often that has changed which verdicts rest on."""

    @property
    def looks_back(self) -> bool:
        """Whether anything depends on what was done earlier."""

    def of(self, agent: str | None, pasts: Sequence[Past], gone: int) -> Matcher:
        """The matcher for an agent after these pasts, of each moment since the first ``gone`` observations."""


# what its arguments are (None: not known apart), its action, what is closed and entered after it, missed, parameters
OpenLeaf: TypeAlias = "tuple[tuple[Slot, ...] | None, Compound, tuple[int, int], int, int]"


class Standing(NamedTuple):
    """Where an instance stands: its goal, its plan (None: none was chosen yet), closed leaves, open parts, binding."""

    goal: int
    plan: int | None = None
    closed: int = 0
    entered: int = 0
    binding: Binding = ()
