"""Collaboration: which part of the frontier the robot takes, and what it waits for (paper section III-G)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from casper.engine.explanation import Explanation
from casper.kb.terms import Compound, as_term
from casper.kb.writer import term_text


@dataclass(frozen=True, slots=True)
class CollaborativePlan:
    """What an agent will do for a goal.

    ``actions`` is the longest run of the frontier that it can do; ``waiting`` what the partner does before that.
    ``leaves`` are the numbers of the plan's leaves behind ``actions``.
    """

    agent: str
    goal: str
    waiting: tuple[Compound, ...]
    actions: tuple[Compound, ...]
    leaves: tuple[int, ...]

    def to_json(self) -> dict[str, Any]:
        """``{"agent", "goal", "waiting": [action], "actions": [action]}``."""
        return {
            "agent": self.agent,
            "goal": self.goal,
            "waiting": [term_text(as_term(action)) for action in self.waiting],
            "actions": [term_text(as_term(action)) for action in self.actions],
        }


Capability: TypeAlias = Callable[[Explanation, int, str], tuple[Compound, bool]]
"""(explanation, number of a leaf, agent) -> the action with every part filled in that can be; whether the agent can."""


def collaborative_plan(agent: str, explanation: Explanation, capability: Capability) -> CollaborativePlan:
    """The agent's part in finishing an explanation's plan: the longest run of its frontier that the agent can do."""
    frontier = explanation.open_leaves
    able = [capability(explanation, leaf, agent) for leaf in frontier]
    start, stop = longest_run([can for _, can in able])
    actions = [action for action, _ in able]
    return CollaborativePlan(
        agent, explanation.goal, tuple(actions[:start]), tuple(actions[start:stop]), frontier[start:stop]
    )


def longest_run(able: Sequence[bool]) -> tuple[int, int]:
    """The longest run of True as (start, stop); (n, n) when there is none.

    Of two equally long ones the later: the partner is least disturbed, and the robot has most time to get ready.
    """
    best = (len(able), len(able))
    start = 0
    for stop in range(len(able) + 1):
        if stop == len(able) or not able[stop]:
            if stop - start > 0 and stop - start >= best[1] - best[0]:
                best = (start, stop)
            start = stop + 1
    return best
