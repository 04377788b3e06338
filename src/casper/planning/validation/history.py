"""What became of a fluent: which step gave it the value it has, found by comparing the states."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from unified_planning.model import FNode, State


@dataclass(frozen=True)
class History:
    """States in order, the first before any step; ``steps[i]`` led from state i to state i + 1."""

    states: Sequence[State]
    steps: Sequence[str]

    @property
    def now(self) -> State:
        """The last state."""
        return self.states[-1]

    def value(self, fluent: FNode) -> Any:
        """What the fluent is now; None where it has no value."""
        return _value(self.now, fluent)

    def changed_by(self, fluent: FNode) -> str | None:
        """The last step that changed the fluent; None when it is as it was at the beginning."""
        now = self.value(fluent)
        for at in range(len(self.states) - 2, -1, -1):
            if _value(self.states[at], fluent) != now:
                return self.steps[at]
        return None


def _value(state: State, fluent: FNode) -> Any:
    from unified_planning.exceptions import UPUsageError, UPValueError

    try:
        return state.get_value(fluent)
    except (UPUsageError, UPValueError):
        return None
