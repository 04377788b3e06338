"""Class expressions, data ranges, property expressions and SWRL rules, out of the triples that spell them."""

from __future__ import annotations

from typing import Any

from casper.kb.ontologies.expressions import OWL, RDF, SWRL, Anonymous, Expression, Iri, Part, Unknown, Value
from casper.kb.ontologies.reading.canonical import variable_name
from casper.kb.ontologies.reading.triples import Misread, Triples

_TYPE = f"{RDF}type"
_LISTED = {
    "intersectionOf": "IntersectionOf",
    "unionOf": "UnionOf",
    "oneOf": "OneOf",
}
_NEGATED = ("complementOf", "datatypeComplementOf")
_RESTRICTED = {"someValuesFrom": "SomeValuesFrom", "allValuesFrom": "AllValuesFrom", "hasValue": "HasValue"}
_COUNTED = {
    "minCardinality": "MinCardinality",
    "maxCardinality": "MaxCardinality",
    "cardinality": "ExactCardinality",
    "minQualifiedCardinality": "MinCardinality",
    "maxQualifiedCardinality": "MaxCardinality",
    "qualifiedCardinality": "ExactCardinality",
}
_ATOMS = {
    "ClassAtom": ("classPredicate", "argument1"),
    "IndividualPropertyAtom": ("propertyPredicate", "argument1", "argument2"),
    "DatavaluedPropertyAtom": ("propertyPredicate", "argument1", "argument2"),
    "DataRangeAtom": ("dataRange", "argument1"),
    "SameIndividualAtom": ("argument1", "argument2"),
    "DifferentIndividualsAtom": ("argument1", "argument2"),
}
_ATOM_NAMES = {
    "IndividualPropertyAtom": "PropertyAtom",
    "DatavaluedPropertyAtom": "PropertyAtom",
    "DataRangeAtom": "RangeAtom",
}
DEFINING = (*_LISTED, *_NEGATED)  # what makes an expression of a blank node, and a definition of an IRI


class ExpressionReader:
    """Reads expressions; every triple it looks at counts as understood."""

    def __init__(self, triples: Triples) -> None:
        self._triples = triples
        self._under_way: set[Any] = set()

    def part(self, node: Any) -> Part:
        """An IRI, a value, an individual or, for a blank node that spells one, an expression.

        Raises:
            Misread: the triples of the node make no sense.
        """
        if not isinstance(node, Anonymous):
            return node  # type: ignore[no-any-return]
        if node in self._under_way:
            raise Misread("an expression contains itself")
        self._under_way.add(node)
        try:
            return self._expression(node) or node
        finally:
            self._under_way.discard(node)

    def _expression(self, node: Anonymous) -> Expression | None:
        has = self._triples.has
        if has(node, f"{OWL}onProperty"):
            return self._restriction(node)
        if has(node, f"{OWL}inverseOf"):
            return Expression("InverseOf", (self.part(self._triples.value(node, f"{OWL}inverseOf")),))
        if has(node, f"{OWL}onDatatype"):
            return self._datatype(node)
        for key in DEFINING:
            if has(node, OWL + key):
                return self.defined(node, key)
        return None

    def defined(self, node: Any, key: str) -> Expression:
        """What ``owl:unionOf`` and the like say of a node."""
        value = self._triples.value(node, OWL + key)
        if key in _NEGATED:
            return Expression("ComplementOf", (self.part(value),))
        return Expression(_LISTED[key], tuple(map(self.part, self._triples.items(value))))

    def _restriction(self, node: Anonymous) -> Expression:
        on = self.part(self._triples.value(node, f"{OWL}onProperty"))
        for key, name in _RESTRICTED.items():
            if self._triples.has(node, OWL + key):
                return Expression(name, (on, self.part(self._triples.value(node, OWL + key))))
        if self._triples.has(node, f"{OWL}hasSelf"):
            self._triples.values(node, f"{OWL}hasSelf")
            return Expression("HasSelf", (on,))
        for key, name in _COUNTED.items():
            if self._triples.has(node, OWL + key):
                return self._cardinality(node, on, key, name)
        raise Misread("a restriction says nothing of its property")

    def _cardinality(self, node: Anonymous, on: Part, key: str, name: str) -> Expression:
        spelt = self._triples.value(node, OWL + key)
        if not (isinstance(spelt, Value) and spelt.lexical.strip().isdigit() and len(spelt.lexical) < 10):
            raise Misread(f"{OWL}{key} needs a number")
        number: Part = int(spelt.lexical)
        for qualifier in ("onClass", "onDataRange"):
            if self._triples.has(node, OWL + qualifier):
                return Expression(name, (number, on, self.part(self._triples.value(node, OWL + qualifier))))
        return Expression(name, (number, on))

    def _datatype(self, node: Anonymous) -> Expression:
        base = self.part(self._triples.value(node, f"{OWL}onDatatype"))
        facets: list[Part] = []
        for item in self._triples.items(self._triples.value(node, f"{OWL}withRestrictions")):
            found = [(predicate, value) for predicate, value in self._triples.about(item) if predicate != _TYPE]
            facets += [Expression("FacetRestriction", (Iri(predicate), value)) for predicate, value in found]
        return Expression("DatatypeRestriction", (base, *facets))

    # --- SWRL ------------------------------------------------------------------------------------------------------

    def rule(self, node: Any) -> Expression:
        """What a ``swrl:Imp`` says.

        Raises:
            Misread: one of its atoms makes no sense.
        """
        body, head = (self._atoms(node, name) for name in ("Body", "Head"))
        return Expression("Rule", (body, head))

    def _atoms(self, node: Any, name: str) -> Expression:
        value = self._triples.value(node, SWRL + name.lower())
        if value is None:  # an empty half is the empty list
            raise Misread(f"its {name.lower()} is not there; mend the rule")
        items = self._triples.items(value)
        return Expression(name, tuple(self._atom(item) for item in items))

    def _atom(self, node: Any) -> Expression:
        kinds = [t.text.removeprefix(SWRL) for t in self._triples.values(node, _TYPE) if isinstance(t, Iri)]
        name = next((kind for kind in kinds if kind in (*_ATOMS, "BuiltinAtom")), None)
        if name is None:
            raise Misread("an atom of a rule is of no kind that SWRL has")
        if name == "BuiltinAtom":
            arguments = self._triples.items(self._triples.value(node, f"{SWRL}arguments"))
            args = (self._triples.value(node, f"{SWRL}builtin"), *arguments)
            return Expression("BuiltInAtom", tuple(map(self._argument, args)))
        args = tuple(self._triples.value(node, SWRL + key) for key in _ATOMS[name])
        if None in args:
            raise Misread(f"a swrl:{name} lacks an argument")
        return Expression(_ATOM_NAMES.get(name, name), tuple(map(self._argument, args)))

    def _argument(self, node: Any) -> Part:
        if isinstance(node, (Iri, Anonymous)) and Iri(f"{SWRL}Variable") in self._triples.values(node, _TYPE):
            return Unknown(variable_name(node.text if isinstance(node, Iri) else node.label))
        return self.part(node)

