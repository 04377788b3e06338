"""What the stages before the reading hand over, as events."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict

from casper.engine.actions.prediction import Misread
from casper.engine.events import Event
from casper.engine.movements.movements import Movement
from casper.engine.verification.verification import Statement
from casper.kb.reasons.validity import Verdict
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import as_term


def movement_event(movement: Movement, agent: str) -> Event:
    """Which movement of an agent it is, and what it was told by."""
    seen = movement.features
    data = {"agent": agent, "movement": movement.name, "features": dict(zip(seen._fields, seen))}
    return Event("movement", movement.t, data)


def action_event(statement: Statement, score: float, t: float, misread: Iterable[Misread]) -> Event:
    """Which action seems to have happened, and which movements were probably misread."""
    told = {"statement": str(statement), "score": score, "misread": [asdict(each) for each in misread]}
    return Event("action", t, told)


def verdict_event(t: float, verdict: Verdict) -> Event:
    """What the knowledge base says of a statement."""
    data = {
        "statement": term_text(as_term(verdict.statement)),
        "valid": verdict.valid,
        "completed": term_text(as_term(verdict.completed)),
        "reasons": list(verdict.reasons),
    }
    return Event("verdict", t, data)
