"""What a reading says of what was observed: explanations, goals and how likely they are, what comes next, why not."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping, Sequence
from itertools import islice

from casper.engine.collaboration.collaboration import Capability, CollaborativePlan, collaborative_plan
from casper.engine.events.telling import Telling
from casper.engine.explanation.explanation import Explanation, Interleaved
from casper.engine.reading.outlook import Outlook
from casper.engine.reading.policy import Policy
from casper.engine.reading.questions import Question, in_words, questions
from casper.engine.recognition.teller import Teller
from casper.engine.verification.matching import ROBOT
from casper.engine.verification.observation import Seen, options_of
from casper.kb.terms.terms import Compound
from casper.plans.library import PlanLibrary


class Explained:
    """What can be asked of a reading at any time; `reading.Reading` is how it comes about."""

    library: PlanLibrary
    policy: Policy
    _engine: Teller
    _capability: Capability
    _numbers: dict[str, list[int]]
    _rejected: list[dict[str, tuple[str, ...]]]

    @property
    def observations(self) -> Sequence[Seen]:
        """What was observed, in order."""
        return tuple(self._engine.observations)

    @property
    def tell(self) -> Telling:
        """What tells goals and steps in the author's words."""
        raise NotImplementedError

    @property
    def count(self) -> int:
        """The exact number of explanations."""
        return self._engine.count if self.observations else 0

    @property
    def posterior(self) -> Mapping[str, float]:
        """Each goal's share of the sum of all scores; before anything is seen, and after nonsense, all zero."""
        return self._engine.posterior() if self._engine.observations else dict.fromkeys(self._numbers, 0.0)

    @property
    def confidence(self) -> float:
        """The best explanation's share of the sum of all scores (not its goal's posterior)."""
        best = self.first
        return best.share if best is not None else 0.0

    @property
    def ties(self) -> int:
        """How many explanations weigh as much as the best one, itself among them; 0 when there is none."""
        standing = self._engine.standing() if self.observations else None
        return 0 if standing is None else standing.ties

    @property
    def outcome(self) -> str | None:
        """The goal the policy commits to, or None."""
        standing = self._engine.standing() if self.observations else None
        return None if standing is None else self.policy(standing)

    @property
    def first(self) -> Explanation | Interleaved | None:
        """The best explanation; None when there is none."""
        return self._engine.first() if self._engine.observations else None

    def best_of(self, goal: str) -> Explanation | Interleaved | None:
        """The best explanation of a goal; None when there is none. Goals pursued together are joined by " + "."""
        return self._engine.first(goal) if self._engine.observations else None

    def explanations(self) -> Iterator[Explanation | Interleaved]:
        """Every explanation, best first, lazily."""
        return self._engine.explanations() if self.observations else iter(())

    @property
    def is_exact(self) -> bool:
        """Whether every explanation was counted; with more than two goals at once a search may hold lower bounds."""
        return self._engine.is_exact

    def best(self, count: int = 1) -> list[Explanation | Interleaved]:
        """The best few explanations."""
        if count == 1:
            best = self.first
            return [] if best is None else [best]
        return list(islice(self.explanations(), min(max(count, 0), sys.maxsize)))

    @property
    def frontier(self) -> tuple[Compound, ...]:
        """What the best explanation leaves to be done."""
        best = self.first
        return best.frontier if best is not None else ()

    @property
    def rejected(self) -> dict[str, tuple[str, ...]]:
        """Every goal that explains nothing any more, with the reasons why.

        Where observations may be needless, or a step of another goal, a later one may bring it back.
        """
        for level in range(len(self._rejected), len(self.observations) + 1):
            self._rejected.append(self._reject(level))
        return self._rejected[-1]

    def plan_for(self, agent: str, explanation: Explanation | Interleaved | None = None) -> CollaborativePlan | None:
        """What the agent can do for the goal of the best explanation; None when there is none to help with.

        Of several goals pursued at once it helps with the one of which it can do most.
        """
        chosen = explanation or self.first
        if chosen is None:
            return None
        plans = [collaborative_plan(agent, part.situation, self._capability) for part in chosen.parts]
        return max(plans, key=lambda plan: len(plan.actions))

    def next_part(
        self, agent: str, explanation: Explanation | Interleaved, done: CollaborativePlan
    ) -> CollaborativePlan | None:
        """What the agent can do after a part that it has done, where others have waited for that; else None.

        None, too, where the part was one that anybody could have done: the goal is taken to be reached with it.
        """
        part = next((part for part in explanation.parts if part.goal == done.goal), None)
        if part is None:
            return None
        plan, mask = part.situation.plan, sum(1 << leaf for leaf in done.leaves)
        after = part.situation.after(mask)
        waited_for = any(plan.chart.before[leaf] & mask for leaf in after.open_leaves if after.belonging >> leaf & 1)
        if not waited_for or not any(plan.actions[leaf].by in (ROBOT, agent) for leaf in done.leaves):
            return None
        return collaborative_plan(agent, after, self._capability)

    # --- what is likely to come ------------------------------------------------------------------------------------

    @property
    def next_actions(self) -> dict[str | None, float]:
        """The probability of each action to be the next step; None: the plan is complete."""
        return self._outlook.next_actions() if self.observations else {}

    @property
    def frontiers(self) -> dict[tuple[Compound, ...], float]:
        """The probability of each frontier, over all explanations."""
        return self._outlook.frontiers() if self.observations else {}

    def plans_for(self, agent: str) -> dict[CollaborativePlan, float]:
        """The probability of each collaborative plan of the agent, over all explanations."""
        return self._outlook.collaborative_plans(agent, self._capability) if self.observations else {}

    def questions(self) -> list[Question]:
        """What to find out, most telling first: is it this goal, is this step still to come, is this the next one?"""
        found = questions(self._outlook) if self.observations else []
        return [in_words(question, self.tell) for question in found] if self.tell.is_used else found

    @property
    def _outlook(self) -> Outlook:
        return Outlook(self.library.ways, self._engine)

    # --- why not ---------------------------------------------------------------------------------------------------

    def _reject(self, level: int) -> dict[str, tuple[str, ...]]:
        """The goals without an explanation: those that fell earlier keep their reasons, new ones get theirs."""
        plans = self.library.ways
        alive = {plans[number].label for number in self._engine.alive(level)}
        before = self._rejected[level - 1] if level else {}
        rejected: dict[str, tuple[str, ...]] = {}
        for label in self._numbers:
            if label not in alive:
                rejected[label] = before.get(label) or self._reasons(label, level)
        return rejected

    def _reasons(self, label: str, level: int) -> tuple[str, ...]:
        found: dict[str, None] = {}
        plans, mismatches = self.library.ways, self._engine.mismatches[level]
        for number in self._numbers[label] if mismatches else ():
            for mismatch in mismatches.get(number, ()):
                found.update(dict.fromkeys(mismatch.told(self.tell)))
        if found or not level:
            return tuple(found)
        names = {leaf.functor for number in self._numbers[label] for leaf in plans[number].leaves}
        actions = [option.action for option, _ in options_of(self.observations[level - 1])]
        if not names.intersection(actions):
            return (self.tell.phrase("no step", self.tell.goal(label), " or ".join(actions)),)
        return (self.tell.phrase("no step left", self.tell.goal(label), " or ".join(actions)),)
