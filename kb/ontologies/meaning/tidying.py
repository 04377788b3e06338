"""Clauses as a person would write them: nothing to compute that is known, ``_`` for what stands alone, all bound."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator
from itertools import chain, count

from casper.kb.ontologies.vocabulary.refusals import Beyond
from casper.kb.ontologies.vocabulary.scope import LETTERS, literal
from casper.kb.program.listing import is_range_restricted
from casper.kb.terms.clauses import Clause, Literal
from casper.kb.terms.comparison import compare
from casper.kb.terms.terms import Compound, Term, Variable
from casper.kb.terms.unification import Bindings, is_ground, substitute, unify, variables_of
from casper.kb.terms.values.arithmetic import EvaluationFailed


def tidied(clause: Clause, data: Collection[Variable] = (), *, rename: bool = False) -> Clause | None:
    """The clause in its shortest form, or None when it says nothing.

    Args:
        clause: as the translation made it.
        data: its variables for data values.
        rename: call its variables X, Y, Z in their order.

    Raises:
        Beyond: nothing binds one of these.
    """
    if not clause.body and is_ground(clause.head):
        return clause
    settled = _settled(clause)
    if settled is None:
        return None
    bound = _bound(settled, data)
    if Literal(bound.head) in bound.body:
        return None
    short = _anonymous(bound)
    return _lettered(short) if rename else short


def _settled(clause: Clause) -> Clause | None:
    """Without equations and comparisons that can be decided here; None when one of them fails."""
    bindings: Bindings = {}
    for condition in clause.body:
        if condition.atom[0] == "=" and condition.is_comparison and not condition.negated:
            extended = unify(condition.atom[1], condition.atom[2], bindings)
            if extended is None:
                return None
            bindings = extended
    kept: dict[Literal, None] = {}
    for condition in clause.body:
        put_in = Literal(substitute(condition.atom, bindings), condition.negated)
        if not (condition.atom[0] == "=" and condition.is_comparison and not condition.negated):
            verdict = _decided(put_in)
            if verdict is False:
                return None
            if verdict is None:
                kept[put_in] = None
    head: Compound = substitute(clause.head, bindings)
    body = tuple(kept) or _always(clause)
    return Clause(head, body)


def _always(clause: Clause) -> tuple[Literal, ...]:
    """A constraint needs a body; one that is always broken compares something with itself."""
    if not clause.is_constraint:
        return ()
    return (literal("=<", 0, 0),)


def _decided(condition: Literal) -> bool | None:
    """What becomes of a comparison whatever the facts, or None."""
    if not condition.is_comparison:
        return None
    if is_ground(condition.atom):
        return _holds(condition)
    operator, left, right = condition.atom
    return False if operator == "\\=" and left == right and not condition.negated else None


def _holds(condition: Literal) -> bool:
    """Whether a comparison of constants does. One that is no number is in no range of numbers, and that is certain.

    Raises:
        Beyond: it computes what has no value.
    """
    try:
        return compare(condition, {}) is not None
    except EvaluationFailed as mistake:
        if condition.atom[0] == "is":
            raise Beyond(f"{mistake}; mend the rule") from None
        return condition.negated


def _bound(clause: Clause, data: Collection[Variable]) -> Clause:
    """With ``thing(X)`` for every variable that ranges over all there is."""
    if is_range_restricted(clause):
        return clause
    lookups = [x.atom for x in clause.body if not x.negated and not x.is_comparison]
    bound = set(variables_of(*lookups))
    free = [v for v in clause.variables() if v not in bound and v not in data and not v.is_anonymous]
    completed = Clause(clause.head, (*(literal("thing", v) for v in free), *clause.body))
    if not is_range_restricted(completed):
        raise Beyond("nothing in the conditions gives one of its values; add a condition that does")
    return completed


def _anonymous(clause: Clause) -> Clause:
    """With ``_`` for every variable that occurs once."""
    times = Counter(_occurrences(clause))
    alone = [v for v, count in times.items() if count == 1 or v.is_anonymous]
    names: Bindings = {v: Variable(f"_#{number}") for number, v in enumerate(alone)}
    body = tuple(Literal(_put(x.atom, names), x.negated) for x in clause.body)
    return Clause(_put(clause.head, names), body)


def _lettered(clause: Clause) -> Clause:
    """With X, Y, Z for the variables in their order."""
    named = [v for v in clause.variables() if not v.is_anonymous]
    letters = chain(LETTERS, (f"X{number}" for number in count(1)))
    names: Bindings = {v: Variable(letter) for v, letter in zip(named, letters)}
    return Clause(_put(clause.head, names), tuple(Literal(_put(x.atom, names), x.negated) for x in clause.body))


def _occurrences(clause: Clause) -> Iterator[Variable]:
    waiting: list[Term] = [x.atom for x in reversed(clause.body)] + [clause.head]
    while waiting:
        term = waiting.pop()
        if isinstance(term, Variable):
            yield term
        elif isinstance(term, tuple):
            waiting.extend(reversed(term))


def _put(term: Term, names: Bindings) -> Term:
    if isinstance(term, Compound):
        return Compound([_put(part, names) for part in term])
    return names.get(term, term) if isinstance(term, Variable) else term
