"""Collaboration: which part of the frontier the robot takes, and what it waits for (paper section III-G).

The paper's frontier is a row, and the robot's part the longest run of it that the robot can do. Where a plan leaves the
order open, a run is a set of open leaves that can be done in one go: nothing that others must do comes between two of
them. The robot waits only for what must come before its run.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from casper.engine.events.printing import plan_lines
from casper.engine.explanation.situation import Situation
from casper.engine.verification.matching import ROBOT
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.kb.text.lines import Line, Shown, one_line, text_of


@dataclass(frozen=True, slots=True)
class CollaborativePlan(Shown):
    """What an agent will do for a goal.

    ``actions`` is the longest run of the frontier that it can do; ``waiting`` what the partner does before that.
    ``leaves`` and ``awaited`` are the numbers of the plan's leaves behind ``actions`` and ``waiting``.
    """

    agent: str
    goal: str
    waiting: tuple[Compound, ...]
    actions: tuple[Compound, ...]
    leaves: tuple[int, ...]
    awaited: tuple[int, ...] = ()

    def after(self, situation: Situation) -> CollaborativePlan:
        """What is left of it when its plan stands there: what was done since is left out."""

        def left(leaves: Sequence[int], actions: Sequence[Compound]) -> list[tuple[int, Compound]]:
            return [pair for pair in zip(leaves, actions) if not situation.closed >> pair[0] & 1]

        return _plan(self.agent, self.goal, left(self.awaited, self.waiting), left(self.leaves, self.actions))

    def to_json(self) -> dict[str, Any]:
        """``{"agent", "goal", "waiting": [action], "actions": [action]}``."""
        return {
            "agent": self.agent,
            "goal": self.goal,
            "waiting": [term_text(as_term(action)) for action in self.waiting],
            "actions": [term_text(as_term(action)) for action in self.actions],
        }

    def lines(self) -> Iterator[Line]:
        """What a person is shown: what the agent waits for, and what it will do."""
        told = self.to_json()
        return plan_lines(told["agent"], told["waiting"], told["actions"])

    def __str__(self) -> str:
        return text_of(self.lines())

    def __repr__(self) -> str:
        return one_line(f"CollaborativePlan for {self.goal}: {'; '.join(str(self).splitlines())}")


Capability: TypeAlias = Callable[[Situation, int, str], tuple[Compound, bool]]
"""(situation, number of a leaf, agent) -> the action with every part filled in that can be; whether the agent can."""


def collaborative_plan(agent: str, situation: Situation, capability: Capability) -> CollaborativePlan:
    """The agent's part in finishing a plan: the longest run of its frontier that the agent can do.

    It waits for no optional part that was not begun: it may never come. What the plan leaves to the agent alone it does
    as soon as that is due, however short the run is: nobody else would, and the others wait for it.
    """
    before = situation.plan.chart.before
    actions: dict[int, Compound] = {}
    able: list[int] = []
    for leaf in situation.open_leaves:
        actions[leaf], can = capability(situation, leaf, agent)
        if can:
            able.append(leaf)
    others = [leaf for leaf in actions if leaf not in able and situation.belonging >> leaf & 1]
    own = next((leaf for leaf in able if situation.plan.actions[leaf].by in (ROBOT, agent)), None)
    run = longest_run(able, others, before, own)
    needed = _union(before[leaf] for leaf in run) if run else -1  # nothing to do: everything is left to the partner
    awaited = [leaf for leaf in actions if (needed & situation.belonging) >> leaf & 1 and leaf not in run]
    return _plan(agent, situation.goal, [(a, actions[a]) for a in awaited], [(a, actions[a]) for a in run])


def longest_run(
    able: Sequence[int], others: Sequence[int], before: Sequence[int], own: int | None = None
) -> tuple[int, ...]:
    """The most leaves of ``able`` found that can be done in one go once some of the ``others`` are done.

    Of two equally long runs the one that more comes before: the partner is least disturbed, and the agent has most
    time to get ready. Tried are the others that one able leaf waits for, and those that it and all to its left do.

    Args:
        able: the open leaves that the agent can do, in order.
        others: the open leaves that it cannot do.
        before: per leaf of the plan the mask of those that come before it.
        own: an able leaf that must be in the run.
    """
    theirs = _union(1 << leaf for leaf in others)
    best: tuple[int, int, tuple[int, ...]] = (0, 0, ())
    for done in _stages(able, theirs, before):
        past = _union(before[leaf] for leaf in others if done >> leaf & 1)
        run = tuple(leaf for leaf in able if not (before[leaf] & theirs & ~done or past >> leaf & 1))
        if own is None or own in run:
            best = max(best, (len(run), done.bit_count(), run))
    return best[2]


def _stages(able: Sequence[int], theirs: int, before: Sequence[int]) -> Iterator[int]:
    """Masks of what the others may have done when the agent begins."""
    together = 0
    for leaf in able:
        needed = before[leaf] & theirs
        together |= needed
        yield needed
        yield together


def _plan(
    agent: str, goal: str, waiting: Sequence[tuple[int, Compound]], actions: Sequence[tuple[int, Compound]]
) -> CollaborativePlan:
    awaited, waits = tuple(at for at, _ in waiting), tuple(action for _, action in waiting)
    return CollaborativePlan(agent, goal, waits, tuple(a for _, a in actions), tuple(at for at, _ in actions), awaited)


def _union(masks: Iterable[int]) -> int:
    total = 0
    for mask in masks:
        total |= mask
    return total
