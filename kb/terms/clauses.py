"""Clauses: what a text says, as frozen data; ``str()`` of one reads in again as the same.

A place never takes part in equality: two texts can say the same thing.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TypeAlias

from casper.kb.errors import Place
from casper.kb.terms.control import CONTROL
from casper.kb.terms.syntax import COMPARISONS, statement_text, term_text
from casper.kb.terms.terms import Compound, Term, Variable, as_term, predication
from casper.kb.terms.unification import Bindings, renamed, substitute, variables_of

NOWHERE = Place()

Indicator: TypeAlias = tuple[str, int]
DID: Indicator = ("did", 2)
SITUATION: tuple[Indicator, ...] = (("claim", 1), DID)
COMPUTED: tuple[Indicator, ...] = (("valid", 1), ("never", 1))
SYSTEM: tuple[Indicator, ...] = (*SITUATION, *COMPUTED)
AGGREGATE = "aggregate_all"  # as a condition of a program: aggregate_all(What, auxiliary(...), Result)
AUXILIARY = "goal: "  # in front of the names of predicates that stand for a goal inside a clause; no text has such


CALLING: dict[Indicator, int] = {  # built-ins that call their first argument, with so many arguments more
    **{("maplist", 1 + lists): lists for lists in (1, 2, 3)},
    ("include", 3): 1,
    ("exclude", 3): 1,
    ("partition", 4): 1,
    ("foldl", 4): 3,
    ("foldl", 5): 4,
}


def is_auxiliary(indicator: Indicator) -> bool:
    """Whether a predicate stands for a goal inside a clause."""
    return indicator[0].startswith(AUXILIARY)


@dataclass(frozen=True, slots=True)
class Literal:
    """One condition of a body: an atom, perhaps negated, a comparison (an atom whose functor is an operator), or an
    aggregate over the answers of an atom.
    """

    atom: Compound
    negated: bool = False
    place: Place = field(default=NOWHERE, compare=False)
    shown: Term | None = field(default=None, compare=False)  # how it was written, where that is not the atom
    remark: str = field(default="", compare=False)  # of an instance that fails: why, where the atom does not tell

    @property
    def is_comparison(self) -> bool:
        """Whether the condition is tested on values rather than looked up."""
        return len(self.atom) == 3 and self.atom[0] in COMPARISONS

    @property
    def is_aggregate(self) -> bool:
        """Whether the condition is worked out of all answers of another one: its second argument."""
        return len(self.atom) == 4 and self.atom[0] == AGGREGATE

    @property
    def is_strict(self) -> bool:
        """Whether all answers of what it needs must be known before it can be decided."""
        if self.negated and not self.is_comparison:
            return True
        return len(self.atom) == 4 and self.atom[0] == AGGREGATE

    @property
    def needed(self) -> Indicator | None:
        """The predicate that is looked up; None for a comparison."""
        inner = self.atom  # asked of every condition many times while a program is sorted: no calls
        if len(inner) == 3 and inner[0] in COMPARISONS:
            return None
        if len(inner) == 4 and inner[0] == AGGREGATE:
            inner = inner[2]
        return inner[0], len(inner) - 1

    @property
    def called(self) -> Indicator | None:
        """The predicate that a condition such as ``maplist(p, L)`` calls, where that is written there; else None."""
        extra = CALLING.get(self.atom.indicator)
        goal = self.atom[1] if extra is not None else None
        if extra is None or not isinstance(goal, (str, Compound)):
            return None
        name, arity = predication(goal).indicator
        return None if (name, arity) in CONTROL or name in (",", ";") else (name, arity + extra)

    def strict_variables(self) -> Iterator[Variable]:
        """What must be known before a negation or an aggregate can be decided."""
        return (v for v in variables_of(self.atom[2] if self.is_aggregate else self.atom) if not v.is_anonymous)

    def binds(self) -> set[Variable]:
        """The variables that are known once the condition is decided, besides those that were known before."""
        if self.is_aggregate:
            return set(variables_of(self.atom[3]))
        if self.negated or (self.is_comparison and self.atom[0] not in ("=", "is")):
            return set()
        return set(variables_of(self.atom))

    def instance(self, bindings: Bindings) -> Literal:
        """The condition with every bound variable replaced."""
        shown = None if self.shown is None else renamed([substitute(self.shown, bindings)], 0)[0]
        return Literal(substitute(self.atom, bindings), self.negated, self.place, shown)

    def variables(self) -> list[Variable]:
        """The variables of the condition, in order."""
        return list(variables_of(self.atom))

    def __str__(self) -> str:
        text = self._text()
        return f"\\+ {text}" if self.negated else text

    def _text(self) -> str:
        """The condition as it was written, without its negation."""
        term = as_term(self.atom) if self.shown is None else self.shown
        if self.is_comparison and self.shown is None:
            return term_text(term, 700)
        if not isinstance(term, Compound):
            return term_text(term)
        return term_text(term, 900 if self.negated else 999) if term.indicator in CONTROL else statement_text(term)


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
