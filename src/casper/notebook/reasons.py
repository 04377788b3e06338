"""Answers, proofs, doubts, refusals and verdicts as HTML."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from casper.kb.reasons.doubt import Doubt
from casper.kb.reasons.proof import DEEPEST_JSON, Proof
from casper.kb.reasons.repair import Repair
from casper.kb.reasons.validity import Verdict
from casper.kb.reasons.why_not import Refusal
from casper.kb.reasons.wording import holding_sentence
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import as_term
from casper.notebook.asked import Asked
from casper.notebook.markup import Markup, joined, tag
from casper.notebook.parts import folded, lines_html, listed, table

MOST_STEPS = 300  # of a proof: a page is slower than a terminal
OPEN = 4  # levels of a proof that are not folded
_NOTES = {"fact": "given", "rule": "", "test": "compared", "absence": "not known", "check": "computed"}


def proof_html(proof: Proof) -> Markup:
    """A proof as a tree to fold; what is used twice stands there once."""
    told = proof.to_json(MOST_STEPS, DEEPEST_JSON)
    entries = proof.outlined(MOST_STEPS, DEEPEST_JSON).entries
    said = iter([holding_sentence(entry.node.literal, proof.words) for entry in entries])
    more = [tag("p", f"… {told['more']:,} more steps", class_="faint")] if told.get("more") else []
    return joined([_step(told, said, 0), *more])


def _step(told: dict[str, Any], said: Iterator[str | None], depth: int) -> Markup:
    """One step and its premises, each in the author's words too, where there are any.

    ``said`` is in the order of the lines; recursion is bounded by `DEEPEST_JSON`.
    """
    sentence = next(said)
    words = [f"{sentence} "] if sentence else []
    term = tag("code", told["fact"], class_="faint" if words else None)
    shown = joined([*words, term, *(tag("span", f"  [{note}]", class_="faint") for note in _notes(told))])
    if not told["because"]:
        return shown
    return folded(shown, listed(_step(premise, said, depth + 1) for premise in told["because"]), is_open=depth < OPEN)


def _notes(told: dict[str, Any]) -> list[str]:
    if "as" in told:
        return [f"as above, {told['as']}"]
    cut = "its premises lie deeper" if told.get("cut") else None
    found = (told.get("id"), _NOTES[told["by"]], told["place"], told.get("cites"), cut)
    return [str(note) for note in found if note]


def doubt_html(doubt: Doubt) -> Markup:
    """Why a statement is neither true nor false."""
    told = doubt.to_json()
    steps = [_doubted(step["needs"], step["failure"] or "undefined", step["place"]) for step in told["steps"]]
    return joined([tag("p", tag("span", "? ", class_="warning"), told["reason"]), listed(steps) if steps else ""])


def _doubted(needs: str, note: str, place: str | None) -> Markup:
    notes = f"  [{note}]" + (f"  [{place}]" if place else "")
    return joined([tag("code", needs), tag("span", notes, class_="faint")])


def refusal_html(refusal: Refusal) -> Markup:
    """The reasons against a statement."""
    sign = tag("span", "? " if refusal.doubt else "✘ ", class_="warning" if refusal.doubt else "bad")
    return joined([tag("p", sign, tag("code", term_text(as_term(refusal.statement)))), listed(refusal.reasons)])


def verdict_html(verdict: Verdict) -> Markup:
    """Valid and what was filled in, or every reason why not."""
    return lines_html(verdict.lines())


def repair_html(repair: Repair) -> Markup:
    """Facts to add and to remove."""
    rows = [(verb, fact) for verb, facts in repair.to_json().items() for fact in facts]
    return listed(joined([f"{verb} ", tag("code", fact)]) for verb, fact in rows)


def asked_html(answers: Asked) -> Markup:
    """Answers as a table; yes or no to a question that has no open parts."""
    if not answers.names:
        return lines_html(answers.lines())
    rows = ([tag("code", value) for value in row] for row in answers.rows)
    return joined([table(rows, answers.names), lines_html(answers.closing())])
