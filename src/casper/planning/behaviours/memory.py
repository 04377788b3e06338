"""What a behaviour tree knows of the course of things: what was seen of the partner, and what the robot did itself."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from casper.engine.collaboration.collaboration import CollaborativePlan
from casper.engine.domain.domain import Domain
from casper.engine.reading.reading import Reading
from casper.engine.verification.history import Done, in_order
from casper.engine.verification.observation import Observation, Seen, options_of
from casper.kb.errors import CasperError
from casper.kb.reasons.validity import Verdict
from casper.kb.terms.terms import Compound, as_term
from casper.kb.terms.unification import unify


@dataclass
class Memory:
    """``own`` are the numbers of the observations that the robot itself told the reading."""

    plan: CollaborativePlan
    domain: Domain
    reading: Reading
    own: set[int] = field(default_factory=set)
    kept: list[Compound] = field(default_factory=list)  # what the robot did, and the reading could not take in
    begun: int = 0

    def __post_init__(self) -> None:
        self.begun = len(self.reading.observations)

    def is_done(self, leaf: int, action: Compound) -> bool:
        """Whether a step that is waited for has been done: it was seen since, or its plan counts it as done."""
        wanted = [each for each in self.plan.waiting if each == action]
        nth = sum(1 for at, each in zip(self.plan.awaited, self.plan.waiting) if each == action and at <= leaf)
        seen = sum(self._was(action, seen) for seen in self.reading.observations[self.begun :])
        return seen >= min(nth, len(wanted)) or self._is_closed(leaf, action)

    def _was(self, action: Compound, seen: Seen) -> bool:
        """Whether what was seen is that action, as far as one can tell."""
        if len(options_of(seen)) > 1:
            return False
        (observation, _), *_ = options_of(seen)
        if observation.action != action.functor:
            return False
        arguments = action.args if observation.args is None else observation.args
        return unify(as_term(action), as_term(Compound((action.functor, *arguments))), {}) is not None

    def _is_closed(self, leaf: int, action: Compound) -> bool:
        best = self.reading.best_of(self.plan.goal)
        for part in best.parts if best is not None else ():
            leaves = part.situation.leaves
            if part.goal == self.plan.goal and leaf < len(leaves) and leaves[leaf].functor == action.functor:
                own_plan = getattr(self.plan, "situation", None)  # a planner's: its leaves are not the library's
                return own_plan is None and bool(part.situation.done >> leaf & 1)
        return False

    def verdict(self, action: Compound) -> Verdict:
        """What the knowledge base says of the robot's doing an action now."""
        return self.domain.kb.verify(self._by(self.plan.agent, action), self._history())

    def tell(self, action: Compound) -> str:
        """Tell the reading what the robot has done.

        Returns:
            What became of it, in a sentence.
        """
        before = len(self.reading.observations)
        try:
            self.reading.observe(Observation(action.functor, action.args))
        except CasperError as mistake:
            self.kept.append(action)
            return f"done; the reading cannot take it in: {mistake.sentence}"
        if self.reading.count == 0:
            self.reading.undo()
            self.kept.append(action)
            return "done; no plan of the library has it here"
        self.own.add(before)
        return "done"

    def _history(self) -> Sequence[Done]:
        told: list[Compound] = []
        for number, seen in enumerate(self.reading.observations):
            (observation, _), *others = options_of(seen)
            if not others and observation.is_plain:
                agent = self.plan.agent if number in self.own else self.domain.partner
                told.append(self._by(agent, Compound((observation.action, *(observation.args or ())))))
        told += [self._by(self.plan.agent, action) for action in self.kept]
        return in_order(told)

    def _by(self, agent: str, action: Compound) -> Compound:
        return Compound((action.functor, agent, *action.args))
