"""Clauses: what a text says, as frozen data; ``str()`` of one reads in again as the same.

A place never takes part in equality: two texts can say the same thing.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TypeAlias

from casper.kb.errors import Place
from casper.kb.terms.syntax import COMPARISONS, statement_text, term_text
from casper.kb.terms.terms import Compound, Term, Variable, as_term
from casper.kb.terms.unification import variables_of

NOWHERE = Place()

Indicator: TypeAlias = tuple[str, int]
DID: Indicator = ("did", 2)
SITUATION: tuple[Indicator, ...] = (("claim", 1), DID)
COMPUTED: tuple[Indicator, ...] = (("valid", 1), ("never", 1))
SYSTEM: tuple[Indicator, ...] = (*SITUATION, *COMPUTED)


@dataclass(frozen=True, slots=True)
class Literal:
    """One condition of a body: an atom, perhaps negated, or a comparison (an atom whose functor is an operator)."""

    atom: Compound
    negated: bool = False
    place: Place = field(default=NOWHERE, compare=False)

    @property
    def is_comparison(self) -> bool:
        """Whether the condition is tested on values rather than looked up."""
        return len(self.atom) == 3 and self.atom[0] in COMPARISONS

    def variables(self) -> list[Variable]:
        """The variables of the condition, in order."""
        return list(variables_of(self.atom))

    def __str__(self) -> str:
        text = term_text(self.atom, 700) if self.is_comparison else statement_text(self.atom)
        return f"\\+ {text}" if self.negated else text


@dataclass(frozen=True, slots=True)
class Clause:
    """A fact (no body) or a rule: the head holds when every literal of the body does."""

    head: Compound
    body: tuple[Literal, ...] = ()
    place: Place = field(default=NOWHERE, compare=False)

    @property
    def is_constraint(self) -> bool:
        """Whether the clause belongs to never/1: its head's argument is the sentence a person is shown."""
        return self.head.indicator == ("never", 1)

    def variables(self) -> Iterator[Variable]:
        """Every variable of the clause."""
        return variables_of(self.head, *(literal.atom for literal in self.body))

    def __str__(self) -> str:
        head = statement_text(self.head)
        return f"{head} :- {', '.join(map(str, self.body))}." if self.body else f"{head}."


@dataclass(frozen=True, slots=True)
class Production:
    """A grammar clause ``head --> body``: the head is done by doing what the body lists, in order.

    ``body`` is a term: ``','``/n of items, ``';'``/n of alternatives, or a single item.
    """

    head: Compound
    body: Term
    place: Place = field(default=NOWHERE, compare=False)

    def __str__(self) -> str:
        return f"{statement_text(self.head)} --> {term_text(self.body, 1199, sequences=True)}."


@dataclass(frozen=True, slots=True)
class Directive:
    """A ``:- name(arguments).`` line."""

    term: Compound
    place: Place = field(default=NOWHERE, compare=False)

    def __str__(self) -> str:
        return f":- {term_text(as_term(self.term), 1199)}."


Sentence: TypeAlias = Clause | Production | Directive
