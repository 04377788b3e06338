"""Verification of single actions: the robot's common sense (paper section III-F).

An action the low level believes in becomes a statement; what the knowledge base refuses goes no further.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from casper.engine.verification.history import Done, History
from casper.engine.verification.observation import Observation
from casper.kb.base import KnowledgeBase
from casper.kb.reasons.validity import Verdict
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, Variable, as_term
from casper.kb.terms.unification import is_ground


@dataclass(frozen=True, slots=True)
class Statement:
    """What the low level believes: who did what, with what, where; None is unknown."""

    t: float
    agent: str
    action: str
    target: str | None
    destination: str | None

    @property
    def term(self) -> Compound:
        """``Action(Agent, Target, Destination)``; an unknown part is a variable, which the rules may fill in."""
        target: Term = Variable("Target") if self.target is None else self.target
        destination: Term = Variable("Destination") if self.destination is None else self.destination
        return Compound((self.action, self.agent, target, destination))

    def __str__(self) -> str:
        return term_text(as_term(self.term))


@dataclass
class Verifier:
    """Judges statements one after the other, remembering what was accepted for did/2."""

    kb: KnowledgeBase
    history: History = field(default_factory=History)
    seen: Callable[[], KnowledgeBase] | None = None  # the base with what was seen, where rules ask for that

    def judge(self, statement: Statement) -> Verdict:
        """Whether the statement is valid after what was accepted and seen, and why not."""
        kb = self.kb if self.seen is None else self.seen()
        return kb.verify(statement.term, self.looked_at)

    @property
    def looked_at(self) -> Sequence[Done]:
        """What was done earlier, as far as any rule asks."""
        return self.history if self.kb.depends_on_history else ()

    def accept(self, verdict: Verdict, t: float) -> Observation:
        """Remember a valid statement; the observation it is, with the parts the rules filled in."""
        if is_ground(verdict.completed):
            self.history.remember(verdict.completed, t)
        return Observation(verdict.completed.functor, verdict.completed.args[1:], t)
