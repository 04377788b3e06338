"""Which properties have data values and which individuals, also where a file does not say so."""

from __future__ import annotations

from collections.abc import Iterator

from casper.kb.ontologies.expressions import RDF, RDFS, XSD, Expression, Iri, Kind, Ontology, Part, Value, parts_of

_COUNTED = ("MinCardinality", "MaxCardinality", "ExactCardinality")
_TRIPLES = ("PropertyAssertion", "NegativePropertyAssertion", "PropertyAtom")
_JOINED = ("IntersectionOf", "UnionOf", "ComplementOf")
_ALIKE = ("SubPropertyOf", "EquivalentProperties", "DisjointProperties")


def is_data_range(part: Part, ontology: Ontology) -> bool:
    """Whether an expression is about data values, not about individuals."""
    if isinstance(part, Iri):
        is_standard = part.text.startswith(XSD) or part.text in (f"{RDFS}Literal", f"{RDF}PlainLiteral")
        return is_standard or ontology.is_a(part.text, Kind.DATATYPE)
    if isinstance(part, Expression):
        if part.name == "DatatypeRestriction":
            return True
        if part.name in ("OneOf", "IntersectionOf", "UnionOf", "ComplementOf"):
            return any(is_data_range(x, ontology) for x in part.args)
    return isinstance(part, Value)


def settle_kinds(ontology: Ontology) -> list[str]:
    """Declare every property as what it is used as, where nothing is declared; those used as both are returned."""
    evidence = list(_evidence(ontology))
    for iri, kind in evidence:
        if kind is Kind.DATA and not _is_property(ontology, iri):
            ontology.declare(iri, kind)
    _spread(ontology)
    for iri, _ in evidence:
        if not _is_property(ontology, iri):
            ontology.declare(iri, Kind.OBJECT)
    both = {Kind.DATA, Kind.OBJECT}
    mixed = {iri for iri, kind in evidence if kind is Kind.DATA and not ontology.is_a(iri, Kind.DATA)}
    return sorted(mixed | {iri for iri, kinds in ontology.kinds.items() if both <= kinds})


def settle_names(ontology: Ontology) -> None:
    """Note every name that stands where only a class, an individual or a datatype can."""
    for axiom in ontology.axioms:
        for part in parts_of(axiom.expression):
            if isinstance(part, Value) and not part.datatype.startswith((XSD, RDF, RDFS)):
                ontology.declare(part.datatype, Kind.DATATYPE)
            if isinstance(part, Expression):
                for kind, names in ((Kind.CLASS, _classes(part)), (Kind.INDIVIDUAL, _individuals(part))):
                    for name in names:
                        if isinstance(name, Iri) and not is_data_range(name, ontology):
                            ontology.declare(name.text, kind)


def _classes(part: Expression) -> tuple[Part, ...]:
    name, args = part.name, part.args
    if name in ("SubClassOf", "EquivalentClasses", "DisjointClasses", "DisjointUnion", *_JOINED):
        return args
    if name in ("ClassAssertion", "ClassAtom", "HasKey"):
        return args[:1]
    if name in ("SomeValuesFrom", "AllValuesFrom", "PropertyDomain", "PropertyRange"):
        return args[1:]
    return args[2:] if name in _COUNTED else ()


def _individuals(part: Expression) -> tuple[Part, ...]:
    name, args = part.name, part.args
    if name in ("SameIndividual", "DifferentIndividuals", "OneOf", "SameIndividualAtom", "DifferentIndividualsAtom"):
        return args
    if name in ("ClassAssertion", "ClassAtom", "HasValue", *_TRIPLES):
        return args[1:]
    return ()


def _is_property(ontology: Ontology, iri: str) -> bool:
    return ontology.is_a(iri, Kind.DATA) or ontology.is_a(iri, Kind.OBJECT)


def _spread(ontology: Ontology) -> None:
    """What is below, equivalent to or disjoint from a data property is one, too."""
    groups = [x.expression.args for x in ontology.axioms if x.expression.name in _ALIKE]
    grown = True
    while grown:
        grown = False
        for group in groups:
            names = [x.text for x in group if isinstance(x, Iri)]
            if any(ontology.is_a(name, Kind.DATA) for name in names):
                for name in names:
                    if not _is_property(ontology, name):
                        ontology.declare(name, Kind.DATA)
                        grown = True


def _evidence(ontology: Ontology) -> Iterator[tuple[str, Kind]]:
    """How properties are used; a plain use that tells nothing counts for individuals."""
    for axiom in ontology.axioms:
        for part in parts_of(axiom.expression):
            if isinstance(part, Expression):
                for iri, value in _uses(part):
                    is_data = value is not None and is_data_range(value, ontology)
                    yield iri.text, Kind.DATA if is_data else Kind.OBJECT


def _uses(part: Expression) -> Iterator[tuple[Iri, Part | None]]:
    """The properties of a constructor, each with what tells its kind."""
    found: list[tuple[Part, Part | None]] = []
    match part:
        case Expression("SomeValuesFrom" | "AllValuesFrom" | "HasValue" | "PropertyRange", (on, value)):
            found = [(on, value)]
        case Expression("MinCardinality" | "MaxCardinality" | "ExactCardinality", (_, on, *qualified)):
            found = [(on, qualified[0] if qualified else None)]
        case Expression("PropertyAssertion" | "NegativePropertyAssertion" | "PropertyAtom", (on, _, value)):
            found = [(on, value)]
        case Expression("PropertyChain" | "InverseOf" | "InverseProperties", args):
            found = [(arg, None) for arg in args]
        case Expression("HasKey", (_, *args)):
            found = [(arg, None) for arg in args]
        case Expression("PropertyDomain" | "HasSelf", (on, *_)):
            found = [(on, None)]
        case Expression(name, args) if name in _ALIKE or name.endswith("Property"):
            found = [(arg, None) for arg in args]
    yield from ((on, value) for on, value in found if isinstance(on, Iri))
