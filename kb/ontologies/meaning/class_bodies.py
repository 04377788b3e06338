"""Class expressions as conditions: what has to hold of a thing that is one, by what is known."""

from __future__ import annotations

from math import prod

from casper.kb.ontologies.citing import cited
from casper.kb.ontologies.expressions import NOTHING, THING, Expression, Iri, Part
from casper.kb.ontologies.meaning.data_ranges import Body, conjoined, within
from casper.kb.ontologies.vocabulary.kinds import is_data_range
from casper.kb.ontologies.vocabulary.refusals import Beyond
from casper.kb.ontologies.vocabulary.scope import Scope, literal
from casper.kb.terms.terms import Term

MOST_ALTERNATIVES = 256  # of one class expression


def conditions(concept: Part, thing: Term, scope: Scope) -> list[Body]:
    """Alternatives, each a conjunction of conditions, under which the thing is known to be one.

    Raises:
        Beyond: being one cannot be known from facts, or rules would be too many.
    """
    if concept == THING:
        return [()]
    if concept == NOTHING:
        return []
    match concept:
        case Iri():
            return [(literal(scope.vocabulary.name(concept), thing),)]
        case Expression("IntersectionOf", parts):
            found = [conditions(part, thing, scope) for part in parts]
            if prod(map(len, found)) > MOST_ALTERNATIVES:
                raise Beyond(f"its alternatives are more than {MOST_ALTERNATIVES}; give the unions names of their own")
            return conjoined(*found)
        case Expression("UnionOf", parts):
            return [body for part in parts for body in conditions(part, thing, scope)]
        case Expression("OneOf", individuals):
            return [body for one in individuals for body in is_same(thing, scope.vocabulary.constant(one), scope)]
        case Expression("HasValue", (on, value)):
            return [(literal(*scope.held(on, thing, scope.vocabulary.constant(value))),)]
        case Expression("HasSelf", (on,)):
            return [(literal(*scope.held(on, thing, thing)),)]
        case Expression("SomeValuesFrom", (on, filler)) | Expression("MinCardinality", (1, on, filler)):
            return _some(on, filler, thing, scope)
        case Expression("MinCardinality", (1, on)):
            return _some(on, THING, thing, scope)
        case Expression("MinCardinality", (0, *_)):
            return [()]
    raise Beyond(_reason(concept))


def _some(on: Part, filler: Part, thing: Term, scope: Scope) -> list[Body]:
    is_data = scope.vocabulary.is_data(on)
    other = scope.fresh(is_data)
    edge = literal(*scope.held(on, thing, other))
    if is_data and filler != THING:
        return [(edge, *rest) for rest in within(filler, other, scope, on)]
    if is_data_range(filler, scope.vocabulary.ontology):
        raise Beyond(f"{cited(on)} relates individuals, and {cited(filler)} has values; declare the property")
    return [(edge, *rest) for rest in conditions(filler, other, scope)]


def is_same(one: Term, other: Term, scope: Scope) -> list[Body]:
    """That two individuals are the same: the same name, or known to be equal."""
    alike: Body = (literal("=", one, other),)
    return [alike, (literal("same", one, other),)] if scope.vocabulary.equality else [alike]


def _reason(concept: Part) -> str:
    name = concept.name if isinstance(concept, Expression) else ""
    shown = cited(concept)
    if name in ("ComplementOf", "AllValuesFrom"):
        return f"that something is {shown} follows from no facts: what is not stated may be so all the same"
    if name in ("MaxCardinality", "ExactCardinality"):
        return f"that something is {shown} follows from no facts: there may be more than is stated"
    if name == "MinCardinality":
        return f"whether something is {shown} needs counting what differs; at least 1 is what rules can tell"
    return f"{shown} is no class expression that rules can test"
