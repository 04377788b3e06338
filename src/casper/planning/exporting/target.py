"""The problem that is being made: its types, objects, fluents, actions and tasks under the names of the language."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from casper.kb.errors import CasperError, Place
from casper.kb.terms.clauses import Clause
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, as_term, predication


class Unplanned(CasperError):
    """Something of a domain that has no place in a problem."""


@dataclass
class Target:
    """``types``, ``fluents``, ``actions`` and ``tasks`` are by their names in the problem."""

    problem: Any
    types: dict[str, Any] = field(default_factory=dict)
    fluents: dict[str, Any] = field(default_factory=dict)
    actions: dict[str, Any] = field(default_factory=dict)
    tasks: dict[str, Any] = field(default_factory=dict)
    agents: dict[str, int] = field(default_factory=dict)  # the number of the parameter that acts, by action

    @property
    def manager(self) -> Any:
        """What makes expressions."""
        return self.problem.environment.expression_manager

    def type_named(self, name: Term, place: Place) -> Any:
        """A type of objects.

        Raises:
            Unplanned: there is none of the name.
        """
        if name not in self.types:
            known = ", ".join(self.types) or "none"
            raise Unplanned(f"there is no type {shown(name)}; the types are {known}", place)
        return self.types[str(name)]

    def thing(self, name: Term, place: Place) -> Any:
        """An object, as an expression.

        Raises:
            Unplanned: there is none of the name.
        """
        if not isinstance(name, str) or not self.problem.has_object(name):
            raise Unplanned(f"{shown(name)} is no object of the problem; give it a type", place)
        return self.manager.ObjectExp(self.problem.object(name))

    def ordered(self, action: str, agent: Term, others: Sequence[Term]) -> tuple[Term, ...]:
        """The arguments of a statement in the order of the problem's parameters."""
        at = self.agents.get(action, 0)
        return (*others[: at - 1], agent, *others[at - 1 :]) if at else tuple(others)


def fluent_parts(term: Term) -> Compound:
    """A fluent as a name with arguments."""
    return predication(term)


def number_of(term: Term) -> Fraction | None:
    """The number that a term is, also one written as ``1 / 3``."""
    if isinstance(term, (int, float)) and not isinstance(term, bool):
        return Fraction(repr(term))
    if isinstance(term, Compound) and term.indicator == ("/", 2) and all(isinstance(x, int) for x in term.args):
        return Fraction(term[1], term[2])
    return None


def body_terms(clause: Clause) -> list[Term]:
    """The conditions of a clause as terms."""
    return [Compound(("\\+", as_term(x.atom))) if x.negated else as_term(x.atom) for x in clause.body]


def shown(term: Any) -> str:
    """A term as it is written."""
    return term_text(term)
