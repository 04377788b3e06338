"""What can be asked of a served domain: a table of methods, each a function of the conversation and its parameters.

A method's parameters are those of its function: their annotations say which JSON values they take (`signatures`), their
defaults which may be left out. ``changes`` marks those that change something: they are never stopped half way.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import islice
from typing import Any

from casper.kb.reasons.doubt import Doubt
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import as_term
from casper.kb.text.writer import answer_json
from casper.server.answers import verdict_json
from casper.server.conversation import DEFAULT, Conversation
from casper.sim_adapter.checking import check_whole

MOST_ANSWERS = 10_000


@dataclass(frozen=True, slots=True)
class Method:
    """A method: what does it, and what it gives (a JSON Schema).

    ``changes``: it changes something. ``of_base``: it asks the knowledge base alone and gives little, so its answer is
    remembered until the base changes.
    """

    run: Callable[..., Any]
    gives: Mapping[str, Any]
    changes: bool = False
    of_base: bool = False

    @property
    def summary(self) -> str:
        """What it is for, in a line."""
        return (self.run.__doc__ or "").strip().split("\n")[0]


# --- the knowledge base ---------------------------------------------------------------------------------------------


def ask(served: Conversation, statement: str) -> bool:
    """Whether a statement holds; with unknown parts, whether it holds for some value."""
    return served.kb.ask(statement)


def query(served: Conversation, goal: str, limit: int = 1000) -> dict[str, Any]:
    """Answers to a conjunction in any direction, each an object of its variables; ``more`` says there are others."""
    limit = max(0, min(limit, MOST_ANSWERS))
    answers = served.kb.query(goal, limit + 1)
    found = [answer_json(answer) for answer in islice(answers, limit)]
    return {"answers": found, "more": next(answers, None) is not None}


def truth(served: Conversation, statement: str) -> str:
    """``"true"``, ``"false"`` or ``"undefined"``."""
    return served.kb.truth(statement)


def why(served: Conversation, statement: str) -> dict[str, Any] | None:
    """A proof (or, of an undefined statement, why it is so) as a tree and as text; null when it does not hold."""
    found = served.kb.why(statement)
    if found is None:
        return None
    return {"kind": "doubt" if isinstance(found, Doubt) else "proof", "tree": found.to_json(), "text": str(found)}


def why_not(served: Conversation, statement: str) -> list[str] | None:
    """The reasons why a statement is not provable or not valid, a sentence each; null when it is both."""
    refusal = served.kb.why_not(statement)
    return None if refusal is None else list(refusal.reasons)


def repair(served: Conversation, statement: str, limit: int = 3) -> list[dict[str, list[str]]]:
    """The smallest changes of base facts that would make a statement valid."""
    return [found.to_json() for found in served.kb.repair(statement, limit=limit)]


def verify(served: Conversation, statement: str, proof: bool = False) -> dict[str, Any]:
    """Is it valid, and why not: what ``casper verify --json`` prints; with its proof only where it is asked for."""
    return verdict_json(served.kb, statement, with_proof=proof)


def assert_(served: Conversation, fact: str) -> bool:
    """Add a fact, with all that follows from it; false when it was given already."""
    return served.kb.assert_(fact)


def retract(served: Conversation, fact: str) -> bool:
    """Take a fact back, with all that followed from it alone; false when it was not given."""
    return served.kb.retract(fact)


# --- readings -------------------------------------------------------------------------------------------------------


def open_(
    served: Conversation,
    reading: str = DEFAULT,
    policy: str = "strict",
    verification: bool = True,
    noise: float | None = None,
    goals: int = 1,
) -> str:
    """Begin a reading (anew, where there is one of that name), with options; its name."""
    return served.open(reading, policy=policy, verification=verification, noise=noise, goals=goals)


def close(served: Conversation, reading: str = DEFAULT) -> bool:
    """Forget a reading; false when there was none of that name."""
    return served.close(reading)


def fork(served: Conversation, into: str, reading: str = DEFAULT) -> str:
    """Copy a reading, for "what if the next is …"; the name of the copy."""
    return served.keep(into, served.reading(reading).fork())


def observe(served: Conversation, action: str | dict[str, float], reading: str = DEFAULT) -> dict[str, Any]:
    """Take in an action, or what it may be with likelihoods; how many explanations are left, goals and their shares.

    An action that fits no plan leaves no explanation: ``undo`` goes back to where the reading was.
    """
    read = served.reading(reading)
    read.observe(action)
    return {
        "observations": len(read.observations),
        "explanations": read.count,
        "confidence": read.confidence,
        "outcome": read.outcome,
        "posterior": dict(read.posterior),
    }


def undo(served: Conversation, reading: str = DEFAULT) -> int:
    """Take back the last observation; how many are left."""
    read = served.reading(reading)
    read.undo()
    return len(read.observations)


def posterior(served: Conversation, reading: str = DEFAULT) -> dict[str, float]:
    """Each goal's share of the sum of all scores."""
    return dict(served.reading(reading).posterior)


def frontier(served: Conversation, reading: str = DEFAULT) -> list[str]:
    """What the best explanation leaves to be done, in order."""
    return [term_text(as_term(action)) for action in served.reading(reading).frontier]


def explain(served: Conversation, reading: str = DEFAULT, top: int = 3) -> dict[str, Any]:
    """The whole reading with its best explanations and reasons: what ``casper explain --json`` prints."""
    return served.reading(reading).to_json(max(0, min(top, MOST_ANSWERS)))


def plan_for(served: Conversation, agent: str = "", reading: str = DEFAULT) -> dict[str, Any] | None:
    """What an agent (the domain's robot, where none is named) can do for the goal of the best explanation."""
    plan = served.reading(reading).plan_for(agent or served.domain.robot)
    return None if plan is None else plan.to_json()


# --- the domain -----------------------------------------------------------------------------------------------------


def check(served: Conversation) -> list[dict[str, Any]]:
    """All that is wrong with the domain's files as they are now: what ``casper check --json`` prints."""
    return [finding.to_json() for finding in check_whole(served.domain.folder)]


TEXT, TRUTH, NUMBER = {"type": "string"}, {"type": "boolean"}, {"type": "integer"}
TEXTS = {"type": "array", "items": TEXT}
SHARES = {"type": "object", "additionalProperties": {"type": "number"}}
THING = {"type": "object"}


def or_null(schema: Mapping[str, Any]) -> dict[str, Any]:
    """The schema of what may be missing."""
    return {"anyOf": [schema, {"type": "null"}]}


def an_object(**properties: Mapping[str, Any]) -> dict[str, Any]:
    """The schema of an object with just these properties, each of them there."""
    return {
        "type": "object",
        "properties": properties,
        "required": list(properties),
        "additionalProperties": False,
    }


METHODS: dict[str, Method] = {
    "ask": Method(ask, TRUTH, of_base=True),
    "query": Method(query, an_object(answers={"type": "array", "items": THING}, more=TRUTH)),
    "truth": Method(truth, {"enum": ["true", "false", "undefined"]}, of_base=True),
    "why": Method(why, or_null(an_object(kind={"enum": ["proof", "doubt"]}, tree=THING, text=TEXT)), of_base=True),
    "why_not": Method(why_not, or_null(TEXTS), of_base=True),
    "repair": Method(
        repair, {"type": "array", "items": {"type": "object", "additionalProperties": TEXTS}}, of_base=True
    ),
    "verify": Method(
        verify,
        an_object(
            statement=TEXT,
            valid=or_null(TRUTH),
            completed=or_null(TEXT),
            proof=or_null(THING),
            reasons=TEXTS,
            repair={"type": "array", "items": THING},
        ),
        of_base=True,
    ),
    "assert": Method(assert_, TRUTH, changes=True),
    "retract": Method(retract, TRUTH, changes=True),
    "open": Method(open_, TEXT, changes=True),
    "close": Method(close, TRUTH, changes=True),
    "fork": Method(fork, TEXT, changes=True),
    "observe": Method(
        observe,
        an_object(
            observations=NUMBER,
            explanations=NUMBER,
            confidence={"type": "number"},
            outcome=or_null(TEXT),
            posterior=SHARES,
        ),
        changes=True,
    ),
    "undo": Method(undo, NUMBER, changes=True),
    "posterior": Method(posterior, SHARES),
    "frontier": Method(frontier, TEXTS),
    "explain": Method(explain, THING),
    "plan_for": Method(plan_for, or_null(an_object(agent=TEXT, goal=TEXT, waiting=TEXTS, actions=TEXTS))),
    "check": Method(check, {"type": "array", "items": THING}),
}
