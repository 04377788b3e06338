"""Step by step: what was believed to happen, whether it can have, why; what it says about the goal, as marked trees."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from casper.engine.events.event import Event
from casper.engine.events.shares import shares_table
from casper.engine.events.telling import Telling
from casper.kb.reasons.doubt import Doubt
from casper.kb.reasons.why_not import Refusal
from casper.kb.terms.clauses import Clause, Literal
from casper.kb.text.writer import literal_text
from casper.notebook.markup import Markup, joined, tag
from casper.notebook.parts import bar, chips, folded, listed, number
from casper.notebook.readings import explanation_html
from casper.notebook.reasons import doubt_html, proof_html
from casper.report.recording import NO_EVIDENCE, Evidence, Recording
from casper.report.story import names_of, seconds

MOST_STEPS = 150  # that are shown with their reasons


def steps_html(recording: Recording) -> Markup:
    """Verdicts and readings in order."""
    numbered = [(at, e) for at, e in enumerate(recording.events) if e.type in ("verdict", "reading")]
    tell = names_of(recording).tell
    parts = list(_articles(recording, numbered[:MOST_STEPS], tell))
    if len(numbered) > MOST_STEPS:
        parts.append(tag("p", f"… and {len(numbered) - MOST_STEPS} more", class_="faint"))
    return joined(parts) if parts else tag("p", "No action was made out.")


def _articles(recording: Recording, numbered: list[tuple[int, Event]], tell: Telling) -> Iterator[Markup]:
    """A valid verdict and the reading that follows it are one step."""
    verdict: tuple[Event, Evidence] | None = None
    number = 0
    before: Mapping[str, list[str]] = {}
    for at, event in numbered:
        evidence = recording.evidence.get(at, NO_EVIDENCE)
        if event.type == "reading":
            number += 1
            yield _read(number, event, evidence, verdict, names_of(recording, event).tell, before)
            verdict, before = None, _against(event.data)
        elif event.data["valid"]:
            verdict = (event, evidence)
        else:
            yield _refused(event, evidence.refusal, tell)


def _refused(event: Event, refusal: Refusal | None, tell: Telling) -> Markup:
    statement, unknown = event.data["statement"], event.data["valid"] is None
    denied = None if unknown else tell.denied(statement)
    told = f"{'left open' if unknown else 'thrown out'}: {denied or tell.statement(statement)}"
    heading = tag("h3", seconds(event.t), tag("span", " ✘ ", class_="bad"), told)
    parts = [heading, tag("p", tag("code", event.data["statement"]), class_="faint"), listed(event.data["reasons"])]
    if refusal is not None and (refusal.attempts or refusal.violations):
        parts.append(folded("how that was found", listed(_tried(refusal)), is_open=False))
    return tag("article", *parts, class_="refused", data_t=repr(event.t))


def _tried(refusal: Refusal) -> Iterator[Markup]:
    """The rules that could have given it with the conditions that fail, and the constraints with what clashes."""
    for attempt in refusal.attempts:
        yield _rule(attempt.clause, [_condition("fails", each) for each in attempt.failed])
    for violation in refusal.violations:
        yield joined([violation.sentence, _rule(violation.clause, [_condition("holds", c) for c in violation.clash])])


def _condition(word: str, condition: Literal) -> Markup:
    return joined([tag("span", f"{word}: ", class_="bad"), tag("code", literal_text(condition))])


def _rule(clause: Clause, below: list[Markup]) -> Markup:
    place = f"  [{clause.place.brief}]" if clause.place.brief else ""
    return joined([tag("code", clause), tag("span", place, class_="faint"), listed(below)])


def _read(
    number_: int,
    event: Event,
    evidence: Evidence,
    verdict: tuple[Event, Evidence] | None,
    tell: Telling,
    before: Mapping[str, list[str]],
) -> Markup:
    data = event.data
    seen = tell.theirs(data["observations"][-1])
    if verdict is not None:
        seen = tell.statement(verdict[0].data["completed"])
    when = joined([tag("span", number_, class_="number"), seconds(event.t)])
    heading = tag("h3", when, tag("span", " ✔ ", class_="good"), seen)
    left = [*_accepted(verdict), *_marked(data, evidence)]
    right = [_count(data), _goals(data, tell, before), _coming(data, tell)]
    columns = tag("div", tag("div", *left), tag("div", *right), class_="columns")
    return tag("article", heading, columns, class_="read", data_t=repr(event.t))


def _accepted(verdict: tuple[Event, Evidence] | None) -> Iterator[Markup]:
    """The statement that was accepted, with its proof."""
    if verdict is None:
        return
    event, evidence = verdict
    yield tag("p", tag("code", event.data["completed"]), class_="faint")
    proof = evidence.proof
    if proof is not None:
        shown = doubt_html(proof) if isinstance(proof, Doubt) else proof_html(proof)
        yield folded("why this can be", shown, is_open=False)


def _marked(data: Mapping[str, Any], evidence: Evidence) -> Iterator[Markup]:
    """The best explanations as marked trees; without the trees their actions in a row."""
    if evidence.explanations:
        yield from (explanation_html(each, data["observations"]) for each in evidence.explanations)
        return
    for best in data["best"][:1]:
        marks = {"observed": "●", "missed": "✗", "unobserved": "○"}
        yield chips(f"{marks.get(leaf['status'], '–')} {leaf['action']}" for leaf in best["leaves"])


def _count(data: Mapping[str, Any]) -> Markup:
    plural = "" if data["explanations"] == 1 else "s"
    return tag("p", f"{data['explanations']} explanation{plural}, confidence ", number(data["confidence"]))


def _goals(data: Mapping[str, Any], tell: Telling, before: Mapping[str, list[str]]) -> Markup:
    """Each goal's share, and why it is ruled out; what was said the step before is not said again."""
    reasons, shares = _against(data), shares_table(data["posterior"])
    rows = []
    for goal, share in shares.shown:
        why = reasons.get(goal)
        told = [listed(why) if why != before.get(goal) else tag("p", "ruled out before", class_="faint")] if why else []
        rows.append(tag("div", tag("b", tell.goal(goal)), bar(share), number(share), tag("span"), *told, class_="goal"))
    rest = [tag("p", f"… and {shares.left_out} goals that are no likelier", class_="faint")] if shares.left_out else []
    return joined([*rows, *rest])


def _against(data: Mapping[str, Any]) -> dict[str, list[str]]:
    """By goal the reasons against it."""
    return {row["goal"]: row["reasons"] for row in data["rejected"]}


def _coming(data: Mapping[str, Any], tell: Telling) -> Markup:
    if not data["frontier"]:
        return tag("p", "nothing is left to be done", class_="faint")
    return tag("p", "still to be done: ", chips(map(tell.step, data["frontier"])))
