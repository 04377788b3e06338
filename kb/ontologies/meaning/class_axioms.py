"""Axioms about classes, individuals and keys: each a function from its arguments to clauses."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from itertools import combinations

from casper.kb.ontologies.citing import cited
from casper.kb.ontologies.expressions import Anonymous, Expression, Iri, Part
from casper.kb.ontologies.meaning.class_bodies import conditions
from casper.kb.ontologies.meaning.class_heads import equal, implied, never
from casper.kb.ontologies.meaning.data_ranges import is_out_of_range
from casper.kb.ontologies.vocabulary.refusals import Beyond, Said
from casper.kb.ontologies.vocabulary.scope import Scope, literal
from casper.kb.terms.clauses import Clause
from casper.kb.terms.terms import Compound

MOST_PAIRED = 12  # things that are told apart pair by pair; more share one constraint


def sub_class(scope: Scope, lower: Part, upper: Part) -> Iterator[Said]:
    """Everything that is one is the other, too."""
    if isinstance(lower, Expression) and lower.name == "UnionOf":
        for part in lower.args:
            yield from _sub_class(scope, part, upper)
    else:
        yield from _sub_class(scope, lower, upper)


def _sub_class(scope: Scope, lower: Part, upper: Part) -> Iterator[Said]:
    thing = scope.fresh()
    try:
        bodies = conditions(lower, thing, scope)
    except Beyond as reason:
        yield reason
        return
    for body in bodies:
        yield from implied(upper, thing, body, scope)


def equivalent_classes(scope: Scope, one: Part, other: Part) -> Iterator[Said]:
    """Each of the two is below the other."""
    yield from sub_class(scope, one, other)
    yield from sub_class(scope, other, one)


def disjoint_classes(scope: Scope, *concepts: Part) -> Iterator[Said]:
    """Nothing is two of them; many of them share one constraint over what kinds a thing has."""
    thing = scope.fresh()
    if len(concepts) <= MOST_PAIRED:
        for one, other in combinations(concepts, 2):
            for body in conditions(one, thing, scope):
                yield from (never(scope, (*body, *more)) for more in conditions(other, thing, scope))
        return
    kind, group = "kind_of", scope.vocabulary.group(concepts)
    for concept, name in zip(concepts, _told_apart(concepts, scope)):
        head = Compound((kind, thing, group, name))
        yield from (Clause(head, body) for body in conditions(concept, thing, scope))
    first, second = scope.fresh(), scope.fresh()
    kinds = (literal(kind, thing, group, first), literal(kind, thing, group, second))
    yield never(scope, (*kinds, literal("\\=", first, second)))


def _told_apart(concepts: tuple[Part, ...], scope: Scope) -> Iterator[str | int]:
    """A name or a number for each, which no other has: also where one stands twice, since then nothing is one."""
    times = Counter(concepts)
    for number, concept in enumerate(concepts, 1):
        iri = concept.text if isinstance(concept, Iri) and times[concept] == 1 else ""
        yield scope.vocabulary.names.get(iri, number)


def disjoint_union(scope: Scope, whole: Part, *parts: Part) -> Iterator[Said]:
    """The parts are below the whole, and nothing is two of them."""
    for part in parts:
        yield from sub_class(scope, part, whole)
    yield from disjoint_classes(scope, *parts)
    if len(parts) == 1:
        yield from sub_class(scope, whole, parts[0])
    else:
        reason = f"that each {cited(whole)} is one of them is not used: rules have no conclusion with a choice"
        yield Beyond(reason)


def class_assertion(scope: Scope, concept: Part, individual: Part) -> Iterator[Said]:
    """An individual is one."""
    yield from implied(concept, scope.vocabulary.constant(individual), (), scope)


def property_assertion(scope: Scope, on: Part, subject: Part, value: Part) -> Iterator[Said]:
    """A property holds between two individuals, or of one and a value."""
    constant = scope.vocabulary.constant
    yield Clause(scope.held(on, constant(subject), constant(value)))
    for range_ in scope.vocabulary.ranges_of(on):
        if not isinstance(value, (Iri, Anonymous)) and is_out_of_range(value, range_):  # type: ignore[arg-type]
            shown = f"the range of {cited(on)} is {cited(range_)}"
            yield Beyond(f"{shown}, and {cited(value)} is none: the ontology contradicts itself; mend the value")


def negative_assertion(scope: Scope, on: Part, subject: Part, value: Part) -> Iterator[Said]:
    """A property does not hold."""
    constant = scope.vocabulary.constant
    yield never(scope, (literal(*scope.held(on, constant(subject), constant(value))),))


def same_individual(scope: Scope, one: Part, other: Part) -> Iterator[Said]:
    """Two names are one individual's."""
    yield equal(scope.vocabulary.constant(one), scope.vocabulary.constant(other), ())


def different_individuals(scope: Scope, *individuals: Part) -> Iterator[Said]:
    """The names are of different individuals."""
    constants = [scope.vocabulary.constant(one) for one in individuals]
    group = scope.vocabulary.group(individuals)
    yield from (Clause(Compound(("apart", group, one))) for one in constants)
    if len(set(constants)) < len(constants):
        yield Beyond("it says that something differs from itself: the ontology contradicts itself; mend the axiom")
    if len(constants) == 2:
        yield never(scope, (literal("same", *constants),))
        return
    one, other = scope.fresh(), scope.fresh()
    members = (literal("apart", group, one), literal("apart", group, other))
    yield never(scope, (literal("same", one, other), *members))


def has_key(scope: Scope, concept: Part, *properties: Part) -> Iterator[Said]:
    """Two that agree on every property of the key are one."""
    one, other = scope.fresh(), scope.fresh()
    shared = [(on, scope.fresh(scope.vocabulary.is_data(on))) for on in properties]
    edges = [literal(*scope.held(on, thing, value)) for on, value in shared for thing in (one, other)]
    for body in conditions(concept, one, scope):
        for more in conditions(concept, other, scope):
            yield equal(one, other, (*body, *more, *edges))


def datatype_definition(scope: Scope, datatype: Part, range_: Part) -> Iterator[Said]:
    """A name for a data range: it is put in wherever the name stands."""
    yield from ()
