"""Domains, plan libraries and plans as HTML: what there is, and a tree for each goal."""

from __future__ import annotations

from collections.abc import Iterator

from casper.engine.domain.domain import Domain
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import as_term
from casper.kb.text.lines import text_of
from casper.kb.text.writer import program_lines
from casper.notebook.markup import Markup, joined, tag
from casper.notebook.parts import folded, lines_html, listed
from casper.notebook.trees import tree_svg
from casper.plans.library import PlanLibrary
from casper.plans.trees.plan import Plan
from casper.plans.trees.tree import plan_tree

NEVER = ("never", 1)
MOST = 20  # plans or constraints that are shown


def domain_html(domain: Domain) -> Markup:
    """Who watches whom, goals, actions, constraints, and the plans."""
    never = [str(clause.head[1]) for clause in domain.kb.clauses if clause.head.indicator == NEVER]
    said = [folded(_counted(len(never), "constraint"), listed(_few(never)), is_open=False)] if never else []
    plans = [library_html(domain.library)] if domain.library.productions else []
    return joined([lines_html(domain.lines()), *said, *plans])


def library_html(library: PlanLibrary) -> Markup:
    """A tree for each plan; of a grammar that is not unrolled its text."""
    if not library.productions:
        return tag("p", "no plans", class_="faint")
    if not library.is_listed:
        text = text_of(program_lines(library.productions))
        return folded("plans that are never unrolled", tag("pre", text), is_open=False)
    ways = library.ways
    trees = joined(folded(tag("code", plan_name(plan)), plan_svg(plan), is_open=False) for plan in ways[:MOST])
    left = [tag("p", f"… and {len(ways) - MOST} more", class_="faint")] if len(ways) > MOST else []
    return joined([tag("p", _counted(len(ways), "plan")), trees, *left])


def plan_svg(plan: Plan) -> Markup:
    """The plan as a tree of which nothing was observed."""
    return tree_svg(plan_tree(plan))


def plan_name(plan: Plan) -> str:
    """What a plan is of."""
    return term_text(as_term(plan.goal))


def _few(texts: list[str]) -> Iterator[str]:
    yield from texts[:MOST]
    if len(texts) > MOST:
        yield f"… and {len(texts) - MOST} more"


def _counted(count: int, kind: str) -> str:
    return f"{count} {kind}{'' if count == 1 else 's'}"
