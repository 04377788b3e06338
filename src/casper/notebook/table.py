"""What shows which type: one row each; whatever else prints lines is shown by them.

A new thing to be shown: inherit from `casper.kb.text.lines.Shown`, and a row here.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from casper.engine.collaboration.collaboration import CollaborativePlan
from casper.engine.domain.domain import Domain
from casper.engine.events.curves import FocusCurve
from casper.engine.explanation.explanation import Explanation, Interleaved
from casper.engine.reading.reading import Reading
from casper.kb.reasons.doubt import Doubt
from casper.kb.reasons.proof import Proof
from casper.kb.reasons.repair import Repair
from casper.kb.reasons.validity import Verdict
from casper.kb.reasons.why_not import Refusal
from casper.kb.text.lines import Form
from casper.notebook.asked import Asked
from casper.notebook.curves import curve_svg
from casper.notebook.domains import domain_html, library_html, plan_svg
from casper.notebook.markup import Markup, page, tag
from casper.notebook.parts import lines_html
from casper.notebook.pictures import alone
from casper.notebook.readings import collaboration_html, explanation_html, reading_html
from casper.notebook.reasons import asked_html, doubt_html, proof_html, refusal_html, repair_html, verdict_html
from casper.notebook.trees import tree_svg
from casper.plans.library import PlanLibrary
from casper.plans.trees.plan import Plan

HTML: dict[type, Callable[[Any], Markup]] = {
    Reading: reading_html,
    Explanation: explanation_html,
    Interleaved: explanation_html,
    CollaborativePlan: collaboration_html,
    FocusCurve: curve_svg,
    Proof: proof_html,
    Doubt: doubt_html,
    Refusal: refusal_html,
    Verdict: verdict_html,
    Repair: repair_html,
    Plan: plan_svg,
    PlanLibrary: library_html,
    Domain: domain_html,
    Asked: asked_html,
}
PICTURES: dict[type, Callable[[Any], Markup]] = {
    Explanation: lambda explanation: tree_svg(explanation.tree()),
    Plan: plan_svg,
    FocusCurve: curve_svg,
}


def shown(thing: object, form: Form) -> str | None:
    """The thing as HTML, or as a picture; None of what has no picture."""
    show = _found(PICTURES if form == "svg" else HTML, type(thing))
    if show is not None:
        return alone(show(thing)) if form == "svg" else page(show(thing))
    return page(_plain(thing)) if form == "html" else None


def _found(rows: dict[type, Callable[[Any], Markup]], kind: type) -> Callable[[Any], Markup] | None:
    return next((rows[each] for each in kind.__mro__ if each in rows), None)


def _plain(thing: object) -> Markup:
    lines = getattr(thing, "lines", None)
    return tag("pre", str(thing)) if lines is None else lines_html(lines())
