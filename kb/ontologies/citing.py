"""Axioms in words near to Manchester syntax: what rules cite and broken constraints say."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import lru_cache

from casper.kb.ontologies.expressions import XSD, Anonymous, Expression, Iri, Part, Unknown, Value

_INFIX = {
    "SubClassOf": "SubClassOf",
    "EquivalentClasses": "EquivalentTo",
    "SubPropertyOf": "SubPropertyOf",
    "EquivalentProperties": "EquivalentTo",
    "InverseProperties": "InverseOf",
    "PropertyDomain": "Domain",
    "PropertyRange": "Range",
    "SameIndividual": "SameAs",
    "DatatypeDefinition": "EquivalentTo",
}
_PAIRED = {
    "DisjointClasses": "DisjointWith",
    "DisjointProperties": "DisjointWith",
    "DifferentIndividuals": "DifferentFrom",
}
_JOINED = {"IntersectionOf": " and ", "UnionOf": " or ", "PropertyChain": " o "}
_RESTRICTION = {"SomeValuesFrom": "some", "AllValuesFrom": "only", "HasValue": "value"}
_CARDINALITY = {"MinCardinality": "min", "MaxCardinality": "max", "ExactCardinality": "exactly"}
_FACETS = {"minInclusive": ">=", "maxInclusive": "<=", "minExclusive": ">", "maxExclusive": "<"}


@lru_cache(maxsize=65_536)
def local_name(iri: str) -> str:
    """What stands behind the last ``#``, ``/`` or ``:`` of an IRI."""
    return re.split(r"[#/:]", iri.rstrip("#/:"))[-1] or iri


def cited(part: Part) -> str:
    """An axiom or expression in words: ``Cat DisjointWith Dog``, ``hasPet some (Cat or Dog)``."""
    match part:
        case Iri(text):
            return local_name(text)
        case Anonymous(label):
            return f"_:{label}"
        case Unknown(name):
            return f"?{name}"
        case Value():
            return _value(part)
        case Expression():
            try:
                return _expression(part)
            except (IndexError, ValueError):  # too few parts for its words: shown as it is, so that it can be mended
                return f"{part.name}({', '.join(map(cited, part.args))})"
    return str(part)


def _value(value: Value) -> str:
    if value.language:
        return f'"{value.lexical}"@{value.language}'
    if value.datatype in (f"{XSD}integer", f"{XSD}decimal", f"{XSD}double", f"{XSD}boolean"):
        return value.lexical
    shown = f'"{value.lexical}"'
    return shown if value.datatype == f"{XSD}string" else f"{shown}^^{local_name(value.datatype)}"


def _expression(part: Expression) -> str:
    name, args = part.name, part.args
    if name in _INFIX and len(args) == 2:
        return f"{cited(args[0])} {_INFIX[name]} {cited(args[1])}"
    if name in _PAIRED:
        if len(args) == 2:
            return f"{_inner(args[0])} {_PAIRED[name]} {_inner(args[1])}"
        return f"{name}({', '.join(map(cited, args))})"
    if name in _JOINED:
        return _JOINED[name].join(map(_inner, args))
    if name in _RESTRICTION:
        return f"{_inner(args[0])} {_RESTRICTION[name]} {_inner(args[1])}"
    if name in _CARDINALITY:
        qualified = f" {_inner(args[2])}" if len(args) > 2 else ""
        return f"{_inner(args[1])} {_CARDINALITY[name]} {args[0]}{qualified}"
    return _OTHERS[name](args) if name in _OTHERS else f"{name}({', '.join(map(cited, args))})"


def _inner(part: Part) -> str:
    text = cited(part)
    is_plain = not isinstance(part, Expression) or part.name in ("OneOf", "InverseOf", "DatatypeRestriction")
    return text if is_plain else f"({text})"


def _rule(args: tuple[Part, ...]) -> str:
    body, head = (x.args if isinstance(x, Expression) else () for x in args)
    return f"{', '.join(map(cited, body))} -> {', '.join(map(cited, head)) or 'nothing'}"


def _applied(args: tuple[Part, ...]) -> str:
    return f"{_inner(args[0])}({', '.join(map(cited, args[1:]))})"


def _facet(args: tuple[Part, ...]) -> str:
    facet = cited(args[0])
    return f"{_FACETS.get(facet, facet)} {cited(args[1])}"


_OTHERS: dict[str, Callable[[tuple[Part, ...]], str]] = {
    "ComplementOf": lambda args: f"not {_inner(args[0])}",
    "OneOf": lambda args: f"{{{', '.join(map(cited, args))}}}",
    "HasSelf": lambda args: f"{_inner(args[0])} Self",
    "InverseOf": lambda args: f"inverse({cited(args[0])})",
    "ClassAssertion": lambda args: f"{cited(args[1])} Type {cited(args[0])}",
    "PropertyAssertion": lambda args: f"{_inner(args[0])}({cited(args[1])}, {cited(args[2])})",
    "NegativePropertyAssertion": lambda args: f"not {_inner(args[0])}({cited(args[1])}, {cited(args[2])})",
    "DisjointUnion": lambda args: f"{cited(args[0])} DisjointUnionOf {', '.join(map(cited, args[1:]))}",
    "HasKey": lambda args: f"{cited(args[0])} HasKey {', '.join(map(cited, args[1:]))}",
    "FacetRestriction": _facet,
    "DatatypeRestriction": lambda args: f"{cited(args[0])}[{', '.join(map(cited, args[1:]))}]",
    "Rule": _rule,
    "ClassAtom": _applied,
    "PropertyAtom": _applied,
    "RangeAtom": _applied,
    "BuiltInAtom": _applied,
    "SameIndividualAtom": lambda args: f"sameAs({', '.join(map(cited, args))})",
    "DifferentIndividualsAtom": lambda args: f"differentFrom({', '.join(map(cited, args))})",
}
