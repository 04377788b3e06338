"""What is likely to come: the next action, the frontier, collaborative plans (`questions` asks about it).

All of it is read off where explanations end (`Teller.ends`), so nothing is enumerated.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import Any

from casper.engine.collaboration.collaboration import Capability, CollaborativePlan, collaborative_plan
from casper.engine.explanation.situation import Situation
from casper.engine.recognition.teller import Teller
from casper.engine.verification.binding import Binding
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.plans.trees.chart import bits
from casper.plans.trees.plan import Plan


class Outlook:
    """What the engine's explanations have ahead of them.

    Args:
        plans: the engine's plans.
        engine: the engine, as it stands.
    """

    def __init__(self, plans: Sequence[Plan], engine: Teller) -> None:
        self.plans, self.engine = plans, engine
        self._known: dict[tuple[int, Binding], tuple[Compound, ...]] = {}

    def next_actions(self) -> dict[str | None, float]:
        """The probability of each action to be the next one of a plan; None: all plans pursued are complete, or may be.

        Where a plan leaves open what comes next, its explanations' share is split evenly.
        """
        found: dict[str | None, float] = {}
        for parts, share in self.engine.ends():
            candidates: list[str | None] = [shown(action) for part in parts for action in self.next(*part)]
            if not any(self._situation(*part).belonging for part in parts):
                candidates.append(None)  # what is left may be left out
            for action in candidates:
                found[action] = found.get(action, 0.0) + share / len(candidates)
        return _falling(found)

    def frontiers(self) -> dict[tuple[Compound, ...], float]:
        """The probability of each frontier: what is yet to be done, with what is known of the parameters."""
        found: dict[tuple[Compound, ...], float] = {}
        for parts, share in self.engine.ends():
            frontier = tuple(action for part in parts for action in self.frontier(*part))
            found[frontier] = found.get(frontier, 0.0) + share
        return _falling(found)

    def collaborative_plans(self, agent: str, capability: Capability) -> dict[CollaborativePlan, float]:
        """The probability that each is the agent's part (of several goals, the one where it can do most)."""
        known: dict[tuple[int, int, Binding], CollaborativePlan] = {}
        found: dict[CollaborativePlan, float] = {}
        for parts, share in self.engine.ends():
            for part in parts:
                if part not in known:
                    known[part] = collaborative_plan(agent, self._situation(*part), capability)
            best = max((known[part] for part in parts), key=lambda plan: len(plan.actions))
            found[best] = found.get(best, 0.0) + share
        return _falling(found)

    def _situation(self, plan: int, closed: int, binding: Binding) -> Situation:
        return Situation.of(self.plans[plan], closed, binding)

    def _actions(self, plan: int, binding: Binding) -> tuple[Compound, ...]:
        """The plan's actions with what is known of their parameters; made once, however many explanations end there."""
        found = self._known.get((plan, binding))
        if found is None:
            found = self._known[plan, binding] = Situation.of(self.plans[plan], 0, binding).leaves
        return found

    def next(self, plan: int, closed: int, binding: Binding) -> Iterator[Compound]:
        """What may be done next without missing anything."""
        actions = self._actions(plan, binding)
        return (actions[leaf] for leaf in self.plans[plan].chart.next_leaves(closed))

    def frontier(self, plan: int, closed: int, binding: Binding) -> tuple[Compound, ...]:
        """What is yet to be done."""
        actions = self._actions(plan, binding)
        return tuple(actions[leaf] for leaf in self.plans[plan].chart.coming_leaves(closed))

    def done(self, plan: int, closed: int, binding: Binding) -> Iterator[Compound]:
        """What was observed, or missed and so done unseen; of parts that may be left out nothing is told."""
        actions = self._actions(plan, binding)
        return (actions[leaf] for leaf in bits(self._situation(plan, closed, binding).done))

    def unsure(self, plan: int, closed: int, binding: Binding) -> Iterator[tuple[bool, Compound]]:
        """What may or may not be done, or have been: (whether it is over, action)."""
        actions, certain = self._actions(plan, binding), self.plans[plan].chart.certain(closed)
        for leaf, action in enumerate(actions):
            if not certain >> leaf & 1:
                yield bool(closed >> leaf & 1), action


@lru_cache(maxsize=65_536)
def shown(action: Compound) -> str:
    """The action as text."""
    return term_text(as_term(action))


def _falling(shares: dict[Any, float]) -> dict[Any, float]:
    return dict(sorted(shares.items(), key=lambda item: -item[1]))
