"""Conditions in plans, ``{Goal}``: each is a relation of the knowledge base, defined by what it asks.

    clean(V) --> {vessel(V), \\+ at(V, sink)}, pick_and_place(V, sink), wash(V, sink).

becomes a plan that asks ``'{vessel(V), \\+ at(V, sink)}'(V)`` where the condition stands, and the rule

    '{vessel(V), \\+ at(V, sink)}'(V) :- vessel(V), \\+ at(V, sink).

So whatever the base does with a rule it does with a condition: it checks it, answers it in every direction, and says
why it does not hold. Conditions on parameters that have nothing to do with one another (``{person(X), place(Y)}``) are
relations of their own: nobody needs all the pairs.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import lru_cache

from casper.kb.errors import Place, PlanError, ReadError
from casper.kb.terms.clauses import Clause, Literal, Production
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, Variable
from casper.kb.terms.unification import renamed, variables_of
from casper.kb.text.reader import read_query
from casper.plans.grammar.shapes import items_in

ASKED = ("{}", 1)


def is_condition(item: Term) -> bool:
    """Whether an item of a body is a condition."""
    return isinstance(item, Compound) and item.indicator == ASKED


def relations_of(item: Compound) -> list[Compound]:
    """The relations that stand for a condition, each with what it is about: its named variables."""
    return [Compound((f"{{{_text(goal)}}}", *_named(goal))) for goal in _parts(item[1])]


def _text(goal: Term) -> str:
    (named,) = renamed([goal], 0)  # under the author's names, whichever copy of the production it is in
    return term_text(named, 1200)


def _named(goal: Term) -> list[Variable]:
    return [variable for variable in variables_of(goal) if not variable.is_anonymous]


def _parts(goal: Term) -> list[Term]:
    """A conjunction in parts that share no named variable, in the author's order."""
    if not (isinstance(goal, Compound) and goal[0] == ","):
        return [goal]
    groups: list[tuple[set[Variable], list[int]]] = []
    for at, conjunct in enumerate(goal.args):
        names, members = set(_named(conjunct)), [at]
        for group in [group for group in groups if group[0] & names]:
            names |= group[0]
            members = [*group[1], *members]
            groups.remove(group)
        groups.append((names, members))
    groups.sort(key=lambda group: min(group[1]))
    parts = [[goal.args[at] for at in sorted(members)] for _, members in groups]
    return [part[0] if len(part) == 1 else Compound((",", *part)) for part in parts]


def condition_clauses(productions: Iterable[Production]) -> Iterator[Clause]:
    """The rules that define the conditions of productions, each once, at the place of the first that has it.

    Raises:
        PlanError: what stands in the braces is no condition.
    """
    seen: set[Compound] = set()
    for production in productions:
        for item in items_in(production.body):
            for relation in relations_of(item) if is_condition(item) else ():
                if relation not in seen:
                    seen.add(relation)
                    place = production.place
                    for literals in _asked(relation.functor[1:-1], place):
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
