"""Plans nobody can do: the knowledge base lets no agent take one of their steps, or they never end."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from casper.engine.domain.domain import Domain
from casper.engine.domain.trying.grown import grown_plans
from casper.engine.domain.trying.listed import listed_plans
from casper.engine.verification.matching import ROBOT
from casper.kb.checks.finding import Finding, error
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound
from casper.plans.grammar.shapes import BY, items_in


def plans_nobody_can_do(domain: Domain) -> Iterator[Finding]:
    """Goals that cannot be pursued, parts that cannot be done, steps of strangers."""
    yield from _strangers(domain)
    yield from listed_plans(domain) if domain.library.is_listed else grown_plans(domain)


def _strangers(domain: Domain) -> Iterator[Finding]:
    """Steps of agents who are not in the world."""
    agents = {str(row[0]) for kind in ("human", "robot", "agent") for row in domain.kb.rows(kind, 1)}
    agents |= {domain.partner, domain.robot}
    for production in domain.library.productions:
        for item in items_in(production.body):
            who = item[1] if isinstance(item, Compound) and item.indicator == BY else None
            if isinstance(who, str) and who != ROBOT and who not in agents:
                close = get_close_matches(who, sorted(agents), n=1)
                hint = f"did you mean {close[0]}?" if close else f"the agents are {', '.join(sorted(agents))}"
                yield error(production.place, f"{who} of {term_text(item)} is no agent of this world; {hint}")
