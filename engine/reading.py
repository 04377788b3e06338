"""A reading: what the partner's actions so far say about their goal, and why.

    >>> reading = Domain.load("kitchen").reading()
    >>> reading.observe("pick_and_place(meal, hobs)")
    >>> reading.outcome, reading.confidence
    ('lunch', 1.0)
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice
from typing import Any

from casper.engine.collaboration import Capability, CollaborativePlan, collaborative_plan
from casper.engine.counting import Counting, posterior_by
from casper.engine.explanation import Explanation
from casper.engine.matching import Matcher
from casper.engine.observation import Observation, Observed, observation_of
from casper.engine.policy import Policy, Standing, strict
from casper.kb.errors import CasperError
from casper.kb.terms import Compound, as_term
from casper.kb.writer import term_text
from casper.plans.library import PlanLibrary


class Reading:
    """Explanations of a growing list of observations.

    Args:
        library: the plans.
        matcher: what can be taken for what (`engine.matching`); verification lives there.
        policy: when to commit to a goal.
        capability: what an agent can do of a plan's leaves; by default nobody can do anything.
    """

    def __init__(
        self,
        library: PlanLibrary,
        matcher: Matcher,
        policy: Policy = strict,
        capability: Capability = lambda explanation, leaf, agent: (explanation.leaves[leaf], False),
    ) -> None:
        self.library, self.policy = library, policy
        self._actions = list(library.actions)
        self._capability = capability
        self._counting = Counting(library.plans, matcher)
        self._rejected: list[dict[str, tuple[str, ...]]] = [{}]  # after each observation
        self._rejected[0] = self._reject(None)

    # --- observing -------------------------------------------------------------------------------------------------

    def observe(self, observed: Observed) -> None:
        """Take in one action of the partner: ``"eat"`` or ``"eat(biscuits, plate)"``.

        An observation that fits no plan leaves zero explanations; `undo` goes back to where the reading was.

        Raises:
            ReadError, PlanError: the text is no action, or no plan has it.
        """
        observation = observation_of(observed, self._actions)
        self._counting.observe(observation)
        self._rejected.append(self._reject(observation))

    def undo(self) -> None:
        """Take back the last observation.

        Raises:
            CasperError: there is none.
        """
        if not self._counting.observations:
            raise CasperError("there is no observation to take back")
        self._counting.undo()
        self._rejected.pop()

    @property
    def observations(self) -> Sequence[Observation]:
        """What was observed, in order."""
        return tuple(self._counting.observations)

    # --- what it says ----------------------------------------------------------------------------------------------

    @property
    def count(self) -> int:
        """The exact number of explanations."""
        return self._counting.count if self.observations else 0

    @property
    def posterior(self) -> dict[str, float]:
        """Each goal's share of the sum of all scores; before anything is seen, and after nonsense, all zero."""
        return posterior_by((plan.label for plan in self.library.plans), self._counting.score_sums())

    @property
    def confidence(self) -> float:
        """The best explanation's share of the sum of all scores (not its goal's posterior)."""
        best = next(self.explanations(), None)
        return best.share if best is not None else 0.0

    @property
    def outcome(self) -> str | None:
        """The goal the policy commits to, or None."""
        groups = self._counting.groups()
        if not self.observations or not groups:
            return None
        plans, top = self.library.plans, groups[0]
        label = plans[top.plan].label
        rivals = sum(g.count for g in groups if g.score == top.score and plans[g.plan].label != label)
        missed = top.last + 1 - len(self.observations)
        return self.policy(Standing(self.count, label, missed, rivals))

    def explanations(self) -> Iterator[Explanation]:
        """Every explanation, best first, lazily."""
        if not self.observations:
            return
        whole = sum(self._counting.score_sums())
        for group, (marks, binding) in self._counting.stream():
            share = group.score / whole if whole else 0.0
            yield Explanation(self.library.plans[group.plan], marks, binding, group.score, share)

    def best(self, count: int = 1) -> list[Explanation]:
        """The best few explanations."""
        return list(islice(self.explanations(), count))

    @property
    def frontier(self) -> tuple[Compound, ...]:
        """What the best explanation leaves to be done."""
        best = next(self.explanations(), None)
        return best.frontier if best is not None else ()

    @property
    def rejected(self) -> dict[str, tuple[str, ...]]:
        """Every goal that explains nothing any more, with the reasons why."""
        return self._rejected[-1]

    def plan_for(self, agent: str, explanation: Explanation | None = None) -> CollaborativePlan | None:
        """What the agent can do for the goal of the best explanation; None when there is none to help with."""
        chosen = explanation or next(self.explanations(), None)
        return None if chosen is None else collaborative_plan(agent, chosen, self._capability)

    def to_json(self, top: int = 3) -> dict[str, Any]:
        """The design's object for ``casper explain --json``."""
        best = self.best(max(top, 1))
        return {
            "observations": [str(observation) for observation in self.observations],
            "explanations": self.count,
            "confidence": best[0].share if best else 0.0,
            "outcome": self.outcome,
            "posterior": self.posterior,
            "best": [explanation.to_json() for explanation in best[:top]],
            "frontier": [term_text(as_term(action)) for action in (best[0].frontier if best else ())],
            "rejected": [{"goal": goal, "reasons": list(reasons)} for goal, reasons in self.rejected.items()],
        }

    # --- why not ---------------------------------------------------------------------------------------------------

    def _reject(self, observation: Observation | None) -> dict[str, tuple[str, ...]]:
        """The goals without an explanation: those that fell earlier keep their reasons, new ones get theirs."""
        plans, levels = self.library.plans, self._counting.levels[-1]
        alive = {plan.label for plan, level in zip(plans, levels) if level}
        before = self._rejected[-1]
        rejected: dict[str, tuple[str, ...]] = {}
        for label in dict.fromkeys(plan.label for plan in plans):
            if label not in alive:
                rejected[label] = before.get(label) or self._reasons(label, observation)
        return rejected

    def _reasons(self, label: str, observation: Observation | None) -> tuple[str, ...]:
        found: dict[str, None] = {}
        for number, plan in enumerate(self.library.plans):
            if plan.label == label:
                found.update(self._counting.mismatches.get(number, {}))
        if found or observation is None:
            return tuple(found)
        names = {leaf.functor for plan in self.library.plans if plan.label == label for leaf in plan.leaves}
        if observation.action not in names:
            return (f"{label} has no {observation.action}",)
        return (f"no {observation.action} is left in {label} after what was observed",)
