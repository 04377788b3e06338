"""What stood behind an event, as a page of Markdown: the proof of an action, a refusal, the best explanations."""

from __future__ import annotations

from casper.engine.events.event import Event
from casper.report.recording import Evidence


def why(event: Event, evidence: Evidence) -> str:
    """A page; empty for events that have nothing behind them."""
    if event.type == "verdict":
        return _verdict(event, evidence)
    if event.type == "reading":
        return _reading(event, evidence)
    return ""


def _verdict(event: Event, evidence: Evidence) -> str:
    valid = event.data["valid"]
    head = f"# {event.data['completed' if valid else 'statement']}\n\n{'can have happened' if valid else 'thrown out'}"
    reasons = "".join(f"\n- {_plain(reason)}" for reason in event.data["reasons"])
    behind = evidence.proof if valid else evidence.refusal
    return "\n\n".join(part for part in (head, reasons, _block(str(behind)) if behind is not None else "") if part)


def _reading(event: Event, evidence: Evidence) -> str:
    data = event.data
    goals = "".join(f"\n| {goal} | {share:.3f} |" for goal, share in data["posterior"].items())
    parts = [f"# {data['outcome']}", f"| goal | posterior |\n|---|---|{goals}"]
    parts += [_block(str(explanation)) for explanation in evidence.explanations]
    for entry in data["rejected"]:
        reasons = "".join(f"\n- {_plain(reason)}" for reason in entry["reasons"])
        parts.append(f"**{entry['goal']}** is ruled out:{reasons}")
    return "\n\n".join(parts)


def _block(text: str) -> str:
    """Text as it stands: no line of it is markup."""
    return "\n".join(f"    {line}" for line in text.splitlines())


def _plain(text: str) -> str:
    """A sentence in which nothing is markup."""
    return "".join(f"\\{letter}" if letter in "\\`*_{}[]<>#|" else letter for letter in text)
