"""Data ranges as conditions on a value, and the ways in which a value is outside of one."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import TypeAlias

from casper.kb.ontologies.citing import cited, local_name
from casper.kb.ontologies.expressions import RDFS, XSD, Expression, Iri, Part, Value
from casper.kb.ontologies.vocabulary.names import readable_name
from casper.kb.ontologies.vocabulary.refusals import Beyond
from casper.kb.ontologies.vocabulary.scope import Scope, literal
from casper.kb.ontologies.vocabulary.values import INTEGERS, is_number, is_string
from casper.kb.terms.clauses import Literal
from casper.kb.terms.terms import Compound, Term, Variable

Body: TypeAlias = tuple[Literal, ...]
_FACETS = {  # each with its opposite
    "minInclusive": (">=", "<"),
    "maxInclusive": ("=<", ">"),
    "minExclusive": (">", "=<"),
    "maxExclusive": ("<", ">="),
}


def within(range_: Part, value: Term, scope: Scope, on: Part | None = None) -> list[Body]:
    """Alternatives, each a conjunction of conditions, under which a value is in the range.

    Args:
        range_: a data range.
        value: the term that stands for the value.
        scope: the axiom under translation.
        on: the property whose value it is: what is known of it need not be tested.

    Raises:
        Beyond: no condition of the language tells.
    """
    match range_:
        case Iri(text) if text in scope.vocabulary.datatypes:
            return within(scope.vocabulary.datatypes[text], value, scope, on)
        case Iri(text):
            return [_of_type(text, value, scope, on)]
        case Expression("DatatypeRestriction", (Iri() as base, *facets)):
            tests = tuple(literal(_facet(facet, scope)[0], value, _limit(facet, scope)) for facet in facets)
            return [(*body, *tests) for body in within(base, value, scope, on)]
        case Expression("OneOf", values):
            return [(literal("=", value, scope.vocabulary.constant(x)),) for x in values]
        case Expression("IntersectionOf", parts):
            return [sum(choice, ()) for choice in product(*(within(p, value, scope, on) for p in parts))]
        case Expression("UnionOf", parts):
            return [body for part in parts for body in within(part, value, scope, on)]
        case Expression("ComplementOf", (part,)):
            return outside(part, value, scope, on, complete=True)
    raise Beyond(f"{cited(range_)} is no data range that rules can test")


def outside(range_: Part, value: Term, scope: Scope, on: Part | None = None, *, complete: bool = False) -> list[Body]:
    """Alternatives under which a value is not in the range.

    Args:
        complete: every such value has to be told; otherwise those that cannot be are a note of the scope.
    """
    match range_:
        case Iri(text) if text in scope.vocabulary.datatypes:
            return outside(scope.vocabulary.datatypes[text], value, scope, on, complete=complete)
        case Iri(text):
            return _not_of_type(text, value, scope, complete)
        case Expression("DatatypeRestriction", (Iri() as base, *facets)):
            others = [(literal(_facet(facet, scope)[1], value, _limit(facet, scope)),) for facet in facets]
            return [*outside(base, value, scope, on, complete=complete), *others]
        case Expression("OneOf", values):
            return [tuple(literal("\\=", value, scope.vocabulary.constant(x)) for x in values)]
        case Expression("IntersectionOf", parts):
            return [body for part in parts for body in outside(part, value, scope, on, complete=complete)]
        case Expression("UnionOf", parts):
            found = (outside(part, value, scope, on, complete=complete) for part in parts)
            return [sum(choice, ()) for choice in product(*found)]
        case Expression("ComplementOf", (part,)):
            return within(part, value, scope, on)
    raise Beyond(f"{cited(range_)} is no data range that rules can test")


def _facet(facet: Part, scope: Scope) -> tuple[str, str]:
    """The comparison of a facet, and its opposite."""
    if isinstance(facet, Expression) and isinstance(facet.args[0], Iri):
        name = local_name(facet.args[0].text)
        if name in _FACETS and isinstance(_limit(facet, scope), (int, float)):
            return _FACETS[name]
        if name in _FACETS:
            raise Beyond(f"{cited(facet)} compares what is no number; the language compares numbers")
        raise Beyond(f"the facet {name} has no counterpart in the language")
    raise Beyond("a restriction of a datatype has no facet")


def _limit(facet: Part, scope: Scope) -> Term:
    assert isinstance(facet, Expression)
    return scope.vocabulary.constant(facet.args[1])


def _of_type(datatype: str, value: Term, scope: Scope, on: Part | None) -> Body:
    if datatype == f"{RDFS}Literal" or _is_assured(datatype, scope, on):
        return _bounds(datatype, value)
    if is_number(datatype):
        if datatype.removeprefix(XSD) not in INTEGERS:
            return (literal("number", value),)
        return (literal("integer", value), *_bounds(datatype, value))
    if is_string(datatype):
        return (literal("atom", value),)
    return (literal("=", value, Compound((_functor(datatype, scope), Variable("_#1")))),)


def _functor(datatype: str, scope: Scope) -> str:
    return scope.vocabulary.names.get(datatype, readable_name(datatype))


def _is_assured(datatype: str, scope: Scope, on: Part | None) -> bool:
    """Whether the stated range of the property says as much."""
    if not isinstance(on, Iri):
        return False
    for known in scope.vocabulary.ranges.get(on.text, ()):
        base = known.args[0] if isinstance(known, Expression) and known.name == "DatatypeRestriction" else known
        if base == Iri(datatype):
            return True
    return False


def _bounds(datatype: str, value: Term) -> Body:
    low, high = INTEGERS.get(datatype.removeprefix(XSD), (None, None)) if is_number(datatype) else (None, None)
    tests = [literal(">=", value, low)] if low is not None else []
    return (*tests, *([literal("=<", value, high)] if high is not None else []))


def _not_of_type(datatype: str, value: Term, scope: Scope, complete: bool) -> list[Body]:
    if datatype == f"{RDFS}Literal":
        return []
    if is_number(datatype):
        return _no_number(datatype, value)
    if is_string(datatype):
        return [(Literal(Compound(("atom", value)), negated=True),)]
    if complete:
        raise Beyond(f"the language cannot tell what is no {local_name(datatype)}")
    scope.notes.append(f"only numbers are noticed where {local_name(datatype)} is needed")
    return [(literal("=<", value, value),)]


def _no_number(datatype: str, value: Term) -> list[Body]:
    is_whole = datatype.removeprefix(XSD) in INTEGERS
    low, high = INTEGERS.get(datatype.removeprefix(XSD), (None, None))
    found: list[Body] = [(Literal(Compound(("integer" if is_whole else "number", value)), negated=True),)]
    found += [(literal("<", value, low),)] if low is not None else []
    return [*found, *([(literal(">", value, high),)] if high is not None else [])]


def is_out_of_range(value: Value, range_: Part) -> bool:
    """Whether a stated value is of another datatype than a named one that needs it: told while importing."""
    if not isinstance(range_, Iri) or range_.text == f"{RDFS}Literal":
        return False
    if is_number(range_.text):
        whole = range_.text.removeprefix(XSD) in INTEGERS and value.datatype.removeprefix(XSD) not in INTEGERS
        return not is_number(value.datatype) or whole
    return is_number(value.datatype) or (is_string(range_.text) != is_string(value.datatype))


def conjoined(*parts: Sequence[Body]) -> list[Body]:
    """Every way to choose one alternative of each."""
    return [sum(choice, ()) for choice in product(*parts)]
