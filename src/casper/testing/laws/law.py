"""A law: what must hold of a domain, as a function that fails with the smallest counterexample it finds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

from casper.engine.domain.domain import Domain
from casper.plans.library import PlanLibrary

Check: TypeAlias = Callable[[Domain], None]


class NotApplicable(Exception):
    """A law that has nothing to say of this domain; the sentence says why."""


@dataclass(frozen=True, slots=True)
class Law:
    """``check`` raises AssertionError where the law is broken, `NotApplicable` where it says nothing."""

    name: str
    check: Check

    @property
    def sentence(self) -> str:
        """What must hold, in a line."""
        return (self.check.__doc__ or "").strip().split("\n")[0]


def with_rules(domain: Domain) -> Domain:
    """The domain, if it verifies statements.

    Raises:
        NotApplicable: it has no ontology.
    """
    if not domain.verifies:
        raise NotApplicable("the domain has no ontology.pl")
    return domain


def with_plans(domain: Domain) -> PlanLibrary:
    """The domain's plans.

    Raises:
        NotApplicable: it has none.
    """
    if not domain.library.ways:
        raise NotApplicable("the domain has no plans")
    return domain.library
