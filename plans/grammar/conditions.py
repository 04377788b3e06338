"""Conditions in plans, ``{Goal}``: each is a relation of the knowledge base, defined by what it asks.

    clean(V) --> {vessel(V), \\+ at(V, sink)}, pick_and_place(V, sink), wash(V, sink).

becomes a plan that asks ``'{vessel(V), \\+ at(V, sink)}'(V)`` where the condition stands, and the rule

    '{vessel(V), \\+ at(V, sink)}'(V) :- vessel(V), \\+ at(V, sink).

So whatever the base does with a rule it does with a condition: it checks it, answers it in every direction, and says
why it does not hold.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import lru_cache

from casper.kb.errors import Place, PlanError, ReadError
from casper.kb.terms.clauses import Clause, Literal, Production
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term
from casper.kb.terms.unification import renamed, variables_of
from casper.kb.text.reader import read_query
from casper.plans.grammar.shapes import items_in

ASKED = ("{}", 1)


def is_condition(item: Term) -> bool:
    """Whether an item of a body is a condition."""
    return isinstance(item, Compound) and item.indicator == ASKED


def relation_of(item: Compound) -> Compound:
    """The relation that stands for a condition, with what it is about: its named variables."""
    (named,) = renamed([item], 0)  # under the author's names, whichever copy of the production it is in
    return Compound((term_text(named), *(v for v in variables_of(item) if not v.is_anonymous)))


def condition_clauses(productions: Iterable[Production]) -> Iterator[Clause]:
    """The rules that define the conditions of productions, each once, at the place of the first that has it.

    Raises:
        PlanError: what stands in the braces is no condition.
    """
    seen: set[Compound] = set()
    for production in productions:
        for item in items_in(production.body):
            if is_condition(item) and (relation := relation_of(item)) not in seen:
                seen.add(relation)
                place = production.place
                for literals in _asked(term_text(item[1], 1200), place):
                    yield Clause(relation, tuple(replace(literal, place=place) for literal in literals), place)


@lru_cache(maxsize=4096)
def _read(text: str) -> tuple[tuple[Literal, ...], ...]:
    return read_query(text)


def _asked(text: str, place: Place) -> tuple[tuple[Literal, ...], ...]:
    """The alternatives of what is asked."""
    try:
        return _read(text)
    except ReadError as mistake:
        raise PlanError(f"{{{text}}} asks nothing: {mistake.sentence}", place) from None
