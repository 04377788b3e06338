"""Axioms about properties: each a function from its arguments to clauses."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import combinations, pairwise

from casper.kb.ontologies.citing import cited
from casper.kb.ontologies.expressions import THING, Expression, Part
from casper.kb.ontologies.meaning.class_heads import at_most, equal, implied, never
from casper.kb.ontologies.meaning.data_ranges import Body, outside
from casper.kb.ontologies.vocabulary.refusals import Beyond, Said
from casper.kb.ontologies.vocabulary.scope import Scope, literal
from casper.kb.terms.clauses import Clause
from casper.kb.terms.terms import Term, Variable


def _edge(scope: Scope, on: Part) -> tuple[Variable, Variable]:
    """Fresh variables for what a property relates."""
    return scope.fresh(), scope.fresh(scope.vocabulary.is_data(on))


def sub_property(scope: Scope, lower: Part, upper: Part) -> Iterator[Said]:
    """What the lower property (or a chain of them) relates, the upper does."""
    if isinstance(lower, Expression) and lower.name == "PropertyChain":
        links = [scope.fresh() for _ in range(len(lower.args) + 1)]
        steps = zip(lower.args, pairwise(links))
        body = tuple(literal(*scope.held(on, start, end)) for on, (start, end) in steps)
        yield Clause(scope.held(upper, links[0], links[-1]), body)
        return
    start, end = _edge(scope, lower)
    if scope.vocabulary.is_data(lower) != scope.vocabulary.is_data(upper):
        raise Beyond("one of the two has values and the other individuals; mend the axiom")
    yield Clause(scope.held(upper, start, end), (literal(*scope.held(lower, start, end)),))


def equivalent_properties(scope: Scope, one: Part, other: Part) -> Iterator[Said]:
    """Both relate the same."""
    yield from sub_property(scope, one, other)
    yield from sub_property(scope, other, one)


def inverse_properties(scope: Scope, one: Part, other: Part) -> Iterator[Said]:
    """What one relates, the other relates the other way round."""
    start, end = _edge(scope, one)
    there, back = scope.held(one, start, end), scope.held(other, end, start)
    yield Clause(back, (literal(*there),))
    yield Clause(there, (literal(*back),))


def disjoint_properties(scope: Scope, *properties: Part) -> Iterator[Said]:
    """No two of them relate the same."""
    for one, other in combinations(properties, 2):
        start, end = _edge(scope, one)
        yield never(scope, (literal(*scope.held(one, start, end)), literal(*scope.held(other, start, end))))


def property_domain(scope: Scope, on: Part, concept: Part) -> Iterator[Said]:
    """Whatever has the property is one."""
    start, end = _edge(scope, on)
    yield from implied(concept, start, (literal(*scope.held(on, start, end)),), scope)


def property_range(scope: Scope, on: Part, concept: Part) -> Iterator[Said]:
    """Whatever the property leads to is one, or is such a value."""
    start, end = _edge(scope, on)
    body = (literal(*scope.held(on, start, end)),)
    if scope.vocabulary.is_data(on):
        yield from (never(scope, (*body, *way)) for way in outside(concept, end, scope, on))
    else:
        yield from implied(concept, end, body, scope)


def functional(scope: Scope, on: Part) -> Iterator[Said]:
    """A thing has at most one value."""
    yield from at_most(1, on, THING, scope.fresh(), (), scope)


def inverse_functional(scope: Scope, on: Part) -> Iterator[Said]:
    """A value is at most one thing's."""
    one, other, value = scope.fresh(), scope.fresh(), scope.fresh()
    yield equal(one, other, tuple(literal(*scope.held(on, thing, value)) for thing in (one, other)))


def reflexive(scope: Scope, on: Part) -> Iterator[Said]:
    """Everything is related to itself."""
    thing = scope.fresh()
    yield Clause(scope.held(on, thing, thing), (literal("thing", thing),))


def symmetric(scope: Scope, on: Part) -> Iterator[Said]:
    """What is related is related back."""
    start, end = _edge(scope, on)
    yield Clause(scope.held(on, end, start), (literal(*scope.held(on, start, end)),))


def transitive(scope: Scope, on: Part) -> Iterator[Said]:
    """What two steps relate, one does."""
    start, middle, end = (scope.fresh() for _ in range(3))
    yield Clause(scope.held(on, start, end), _two(scope, on, (start, middle), (middle, end)))


def irreflexive(scope: Scope, on: Part) -> Iterator[Said]:
    """Nothing is related to itself."""
    thing = scope.fresh()
    yield never(scope, (literal(*scope.held(on, thing, thing)),))


def asymmetric(scope: Scope, on: Part) -> Iterator[Said]:
    """What is related is never related back."""
    start, end = _edge(scope, on)
    yield never(scope, _two(scope, on, (start, end), (end, start)))


def _two(scope: Scope, on: Part, first: tuple[Term, Term], second: tuple[Term, Term]) -> Body:
    return literal(*scope.held(on, *first)), literal(*scope.held(on, *second))


def objects_only(make: Callable[[Scope, Part], Iterator[Said]]) -> Callable[[Scope, Part], Iterator[Said]]:
    """Refuse an axiom about a data property that is for properties between individuals."""

    def made(scope: Scope, on: Part) -> Iterator[Said]:
        if scope.vocabulary.is_data(on):
            raise Beyond(f"{cited(on)} has data values, and OWL says this of properties between individuals only")
        yield from make(scope, on)

    return made
