"""Where one observation leads from the states of a plan."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from casper.engine.verification.binding import Binding
from casper.engine.verification.matching import Matcher
from casper.engine.verification.mismatch import Mismatch
from casper.engine.verification.observation import Observation, Seen, options_of
from casper.plans.trees.chart import Chart
from casper.plans.trees.plan import Plan

State: TypeAlias = tuple[int, int, int, int, Binding]
"""Where a plan stands: closed leaves, open parts that were entered, leaves of the plan, missed ones, binding."""
Move: TypeAlias = tuple[int, State, float]  # leaf, state after, likelihood


class Moves(dict[State, list[Move]]):
    """Where an observation leads from the states of one plan: worked out when asked for, each match once.

    ``noted`` is where to write down what could not be matched.
    """

    def __init__(self, plan: int, chart: Chart, matcher: Matcher, noted: dict[int, list[Mismatch]]) -> None:
        self._plan, self._chart, self._matcher, self._noted = plan, chart, matcher, noted
        self._options: list[tuple[Observation, float, Sequence[int], dict[Binding, dict[int, Binding | None]]]] = []
        self._back: dict[State, list[tuple[State, int, float]]] | None = None

    def add(self, option: Observation, likelihood: float, leaves: Sequence[int]) -> None:
        """Something that may have been seen, and the leaves of its name."""
        self._options.append((option, likelihood, leaves, {}))

    def __missing__(self, state: State) -> list[Move]:
        closed, entered, size, missed, binding = state
        found = self[state] = list[Move]()
        for option, likelihood, leaves, matched in self._options:
            after = matched.setdefault(binding, {})
            for leaf in leaves:
                if closed >> leaf & 1:
                    continue
                if leaf not in after:
                    after[leaf] = self._match(leaf, option, binding)
                bound = after[leaf]
                if bound is not None and self._chart.guards:
                    bound = self._asked(state, leaf, option, bound)
                if bound is not None:
                    progress = self._chart.close((closed, entered, size, missed), leaf)
                    found.append((leaf, (*progress, bound), likelihood))
        return found

    def _asked(self, state: State, leaf: int, option: Observation, binding: Binding) -> Binding | None:
        """The binding after the conditions that the leaf asks, and those that are still open."""
        closed, entered, size, missed, _ = state
        due = self._chart.asked((closed, entered, size, missed), leaf)
        return self._noting(self._matcher.ask(self._plan, due, option, binding))

    def back(self) -> dict[State, list[tuple[State, int, float]]]:
        """By state after, what leads there: state before, leaf, likelihood."""
        if self._back is None:
            found: dict[State, list[tuple[State, int, float]]] = {}
            for before, moves in self.items():
                for leaf, after, likelihood in moves:
                    found.setdefault(after, []).append((before, leaf, likelihood))
            self._back = found
        return self._back

    def _match(self, leaf: int, option: Observation, binding: Binding) -> Binding | None:
        return self._noting(self._matcher.match(self._plan, leaf, option, binding))

    def _noting(self, result: Binding | Mismatch) -> Binding | None:
        if isinstance(result, Mismatch):
            self._noted.setdefault(self._plan, []).append(result)
            return None
        return result


def is_certain(seen: Seen) -> bool:
    """Whether it was made out what was done."""
    options = options_of(seen)
    return len(options) == 1 and options[0][1] == 1.0


def positions_of(plan: Plan) -> dict[str, list[int]]:
    """The leaves of each action name, from left to right."""
    positions: dict[str, list[int]] = {}
    for at, leaf in enumerate(plan.leaves):
        positions.setdefault(leaf.functor, []).append(at)
    return positions
