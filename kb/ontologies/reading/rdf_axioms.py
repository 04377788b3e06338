"""RDF triples to axioms, by the mapping of the OWL 2 recommendation; what is left over is told."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from casper.kb.ontologies.citing import local_name
from casper.kb.ontologies.expressions import (
    NOTHING,
    OWL,
    RDF,
    RDFS,
    SWRL,
    THING,
    Anonymous,
    Expression,
    Iri,
    Kind,
    Ontology,
)
from casper.kb.ontologies.reading.rdf_expressions import DEFINING
from casper.kb.ontologies.reading.rdf_names import (
    CHARACTERISTICS,
    GraphReader,
    read_attached,
    read_declarations,
    read_header,
    read_labels,
    read_rules,
)
from casper.kb.ontologies.reading.triples import Triples

_TYPE, _LABEL = f"{RDF}type", f"{RDFS}label"
_PAIRS = {
    f"{RDFS}subClassOf": "SubClassOf",
    f"{OWL}equivalentClass": "EquivalentClasses",
    f"{OWL}disjointWith": "DisjointClasses",
    f"{RDFS}subPropertyOf": "SubPropertyOf",
    f"{OWL}equivalentProperty": "EquivalentProperties",
    f"{OWL}propertyDisjointWith": "DisjointProperties",
    f"{OWL}inverseOf": "InverseProperties",
    f"{RDFS}domain": "PropertyDomain",
    f"{RDFS}range": "PropertyRange",
    f"{OWL}sameAs": "SameIndividual",
    f"{OWL}differentFrom": "DifferentIndividuals",
}
_OF_PROPERTIES = ("SubPropertyOf", "PropertyDomain", "PropertyRange", "EquivalentProperties")
_LISTS = {
    f"{OWL}disjointUnionOf": "DisjointUnion",
    f"{OWL}hasKey": "HasKey",
}
_GROUPS = {
    f"{OWL}AllDisjointClasses": "DisjointClasses",
    f"{OWL}AllDisjointProperties": "DisjointProperties",
    f"{OWL}AllDifferent": "DifferentIndividuals",
}
_OUR_WORDS = (OWL, RDF, RDFS, SWRL)


def ontology_of(triples: Triples, file: str) -> Ontology:
    """The axioms of a graph; puzzles are the triples that no axiom accounts for."""
    reader = GraphReader(triples, file)
    for step in _STEPS:
        step(reader)
    return reader.ontology


def _groups(reader: GraphReader) -> None:
    for kind, name in _GROUPS.items():
        for node in reader.subjects(kind):
            for key in (f"{OWL}members", f"{OWL}distinctMembers"):
                for head in reader.triples.values(node, key):
                    reader.add(name, reader.members(head))
    for node in reader.subjects(f"{OWL}NegativePropertyAssertion"):
        keys = ("sourceIndividual", "assertionProperty", "targetIndividual", "targetValue")
        source, on, target, value = ((reader.triples.values(node, OWL + key) or [None])[0] for key in keys)
        if value is not None and isinstance(on, Iri):
            reader.ontology.declare(on.text, Kind.DATA)
        if None in (source, on) or (target is None and value is None):
            reader.ontology.puzzles.append((reader.place, "a negative assertion lacks a part; nothing was made of it"))
        else:
            reader.add("NegativePropertyAssertion", reader.parts(on, source, target if value is None else value))


def _pairs(reader: GraphReader) -> None:
    for predicate, name in _PAIRS.items():
        for subject, value in reader.triples.pairs(predicate):
            if (subject, predicate, value) in reader.triples.used:
                continue
            if predicate == f"{OWL}inverseOf" and isinstance(subject, Anonymous):
                continue  # an expression
            reader.triples.used.add((subject, predicate, value))
            if name in _OF_PROPERTIES and isinstance(subject, Iri) and _only_annotates(reader, subject):
                continue
            kind = "DatatypeDefinition" if _defines_datatype(reader, name, subject) else name
            reader.add(kind, reader.parts(subject, value))
    for predicate, name in _LISTS.items():
        for subject, head in reader.triples.take(predicate):
            reader.add(name, reader.members(head, subject))
    for subject, head in reader.triples.take(f"{OWL}propertyChainAxiom"):
        chain = reader.members(head)
        reader.add("SubPropertyOf", lambda c=chain, s=subject: (Expression("PropertyChain", c()), reader.part(s)))  # type: ignore[misc]


def _only_annotates(reader: GraphReader, subject: Iri) -> bool:
    return reader.ontology.kinds.get(subject.text) == {Kind.ANNOTATION}


def _defines_datatype(reader: GraphReader, name: str, subject: Any) -> bool:
    is_type = isinstance(subject, Iri) and reader.ontology.is_a(subject.text, Kind.DATATYPE)
    return name == "EquivalentClasses" and is_type


def _definitions(reader: GraphReader) -> None:
    """``:Pet owl:unionOf (…)``: an IRI that is defined as if it were a blank node is equivalent to the expression."""
    for key in DEFINING:
        for subject, _ in list(reader.triples.pairs(OWL + key)):
            if isinstance(subject, Iri):
                defined = lambda s=subject, k=key: (s, reader.expressions.defined(s, k))  # noqa: E731
                reader.add("EquivalentClasses", defined)


def _types(reader: GraphReader) -> None:
    for name in CHARACTERISTICS:
        for subject in reader.subjects(OWL + name):
            reader.add(name, reader.parts(subject))
    for subject, value in list(reader.triples.take(_TYPE)):
        if isinstance(value, Iri) and value.text.startswith(_OUR_WORDS) and value not in (THING, NOTHING):
            reader.triples.used.discard((subject, _TYPE, value))
            continue  # told in the end
        reader.add("ClassAssertion", reader.parts(value, subject))


def _assertions(reader: GraphReader) -> None:
    """Every other triple is a property assertion, unless its predicate only annotates, or it is about no individual."""
    no_individuals = {Iri(iri) for iri, kinds in reader.ontology.kinds.items() if not _names_individual(kinds)}
    no_individuals |= reader.headers
    for subject, predicate, value in [t for t in reader.triples if t not in reader.triples.used]:
        kinds = reader.ontology.kinds.get(predicate, set())
        if predicate.startswith(_OUR_WORDS):
            continue
        reader.triples.used.add((subject, predicate, value))
        if kinds == {Kind.ANNOTATION} or (not kinds and subject in no_individuals):
            continue
        reader.add("PropertyAssertion", reader.parts(Iri(predicate), subject, value))


def _names_individual(kinds: set[Kind]) -> bool:
    return Kind.INDIVIDUAL in kinds


def _left_over(reader: GraphReader) -> None:
    """Triples in OWL's own words that nothing accounts for, once for each kind."""
    seen: set[str] = set()
    for triple in reader.triples:
        if triple in reader.triples.used:
            continue
        subject, predicate, value = triple
        about = local_name(subject.text) if isinstance(subject, Iri) else "a nameless node"
        what = f" {local_name(value.text)}" if predicate == _TYPE and isinstance(value, Iri) else ""
        sentence = f"{local_name(predicate)}{what} of {about} is part of no axiom that could be read, and was left out"
        if sentence not in seen:
            seen.add(sentence)
            reader.ontology.puzzles.append((reader.place, sentence))


_STEPS: tuple[Callable[[GraphReader], None], ...] = (  # annotations and axioms of several triples before single ones
    read_header,
    read_declarations,
    read_attached,
    read_rules,
    _groups,
    _pairs,
    _definitions,
    _types,
    read_labels,
    _assertions,
    _left_over,
)
