"""Readings, explanations, plans and what the robot will do, as HTML: the numbers are those of ``to_json()``."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from casper.engine.collaboration.collaboration import CollaborativePlan
from casper.engine.events.shares import shares_table
from casper.engine.explanation.explanation import Explanation, Interleaved
from casper.engine.reading.reading import Reading
from casper.notebook.markup import Markup, joined, tag
from casper.notebook.parts import bar, chips, number, table
from casper.notebook.trees import tree_svg

TOP = 3  # explanations of a reading that are shown as trees


def reading_html(reading: Reading) -> Markup:
    """What was observed, each goal's share as a bar, the outcome, the best explanations as marked trees."""
    told = reading.to_json(TOP)
    best = reading.best(TOP)
    parts = [
        tag("p", chips(told["observations"]) or tag("span", "nothing observed", class_="faint")),
        tag("p", _count(told), ", confidence ", number(told["confidence"])),
        *(tag("p", f"needless: {told['observations'][row['observation'] - 1]}") for row in told.get("unknown", ())),
        _goals(told),
        tag("p", "outcome: ", _outcome(told["outcome"])),
        *(explanation_html(explanation, told["observations"]) for explanation in best),
    ]
    if told["frontier"]:
        parts.append(tag("p", "yet to come: ", chips(map(reading.tell.step, told["frontier"]))))
    return joined(parts)


def explanation_html(explanation: Explanation | Interleaved, observations: Sequence[str] = ()) -> Markup:
    """Score and share, a marked tree for each goal pursued, and what was needless."""
    told = explanation.to_json()
    heading = tag("p", "score ", number(told["score"], 3), ", share ", number(told["share"]), class_="faint")
    named = [observations[at - 1] if observations else f"observation {at}" for at in told.get("needless", ())]
    needless = [tag("p", f"needless: {', '.join(named)}")] if named else []
    return joined([heading, *(tree_svg(part.tree()) for part in explanation.parts), *needless])


def collaboration_html(plan: CollaborativePlan) -> Markup:
    """What an agent waits for, and what it will do."""
    told = plan.to_json()
    agent = tag("span", told["agent"], class_="strong")
    if not told["actions"]:
        return tag("p", agent, f" can do nothing of what is left of {told['goal']}")
    will = tag("p", "and will then " if told["waiting"] else joined([agent, "'s turn: "]), _ours(told["actions"]))
    waits = [tag("p", agent, " waits for ", chips(told["waiting"]))] if told["waiting"] else []
    return joined([*waits, will])


def _ours(actions: Sequence[str]) -> Markup:
    return chips(actions, "chip ours")


def _count(told: dict[str, Any]) -> Markup:
    least = "at least " if told.get("exact") is False else ""
    many = told["explanations"]
    return joined([least, tag("data", many, value=many), f" explanation{'' if many == 1 else 's'}"])


def _goals(told: dict[str, Any]) -> Markup:
    shares = shares_table(told["posterior"])
    reasons = {row["goal"]: row["reasons"] for row in told["rejected"]}
    rest = [tag("p", f"… and {shares.left_out} goals that are no likelier", class_="faint")] if shares.left_out else []
    return joined([table(_rows(shares.shown, reasons)), *rest])


def _rows(shown: Sequence[tuple[str, float]], reasons: dict[str, list[str]]) -> Iterator[tuple[object, ...]]:
    for goal, share in shown:
        why = "; ".join(reasons.get(goal, ()))
        yield goal, bar(share), number(share), tag("span", f"not this: {why}" if why else "", class_="faint")


def _outcome(outcome: str | None) -> Markup:
    return tag("span", outcome or "undecided", class_="outcome" if outcome else "faint")
