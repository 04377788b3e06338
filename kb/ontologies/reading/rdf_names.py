"""What a graph says besides axioms: its name, what each IRI is, labels, annotations, and the rules of SWRL."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from casper.kb.errors import Place
from casper.kb.ontologies.expressions import (
    OWL,
    RDF,
    RDFS,
    SWRL,
    Anonymous,
    Axiom,
    Expression,
    Iri,
    Kind,
    Ontology,
    Part,
    Value,
)
from casper.kb.ontologies.reading.rdf_expressions import ExpressionReader
from casper.kb.ontologies.reading.triples import Misread, Triples

_TYPE, _LABEL = f"{RDF}type", f"{RDFS}label"
_KINDS = {
    f"{OWL}Class": Kind.CLASS,
    f"{RDFS}Class": Kind.CLASS,
    f"{OWL}ObjectProperty": Kind.OBJECT,
    f"{OWL}DatatypeProperty": Kind.DATA,
    f"{OWL}AnnotationProperty": Kind.ANNOTATION,
    f"{OWL}NamedIndividual": Kind.INDIVIDUAL,
    f"{RDFS}Datatype": Kind.DATATYPE,
}
CHARACTERISTICS = (
    "FunctionalProperty",
    "InverseFunctionalProperty",
    "ReflexiveProperty",
    "IrreflexiveProperty",
    "SymmetricProperty",
    "AsymmetricProperty",
    "TransitiveProperty",
)
_OBJECTS_ONLY = CHARACTERISTICS[1:]
_SILENT = {  # annotations of OWL and RDFS themselves
    *(RDFS + name for name in ("comment", "seeAlso", "isDefinedBy")),
    *(OWL + name for name in ("versionInfo", "versionIRI", "deprecated", "priorVersion", "backwardCompatibleWith")),
    f"{OWL}incompatibleWith",
}
_ATTACHED = (f"{OWL}Axiom", f"{OWL}Annotation")


class GraphReader:
    """What the steps share: the triples, the axioms so far, and one way to note a mistake."""

    def __init__(self, triples: Triples, file: str) -> None:
        self.triples, self.place = triples, Place(file)
        self.expressions = ExpressionReader(triples)
        self.ontology = Ontology()
        self.headers: set[Any] = set()
        self.rule_labels: dict[Any, str] = {}  # of SWRL rules, where they are annotated as axioms are

    def add(self, name: str, parts: Callable[[], tuple[Part, ...]], label: str = "") -> None:
        """One axiom; where its triples make no sense, a puzzle instead."""
        try:
            self.ontology.axioms.append(Axiom(Expression(name, parts()), self.place, label))
        except Misread as mistake:
            self.ontology.puzzles.append((self.place, f"{name}: {mistake}; nothing was made of it"))

    def part(self, node: Any) -> Part:
        return self.expressions.part(node)

    def parts(self, *nodes: Any) -> Callable[[], tuple[Part, ...]]:
        """The expressions of nodes, read when they are asked for."""
        return lambda: tuple(map(self.part, nodes))

    def members(self, head: Any, *before: Any) -> Callable[[], tuple[Part, ...]]:
        """The expressions of nodes and of a list."""
        return lambda: tuple(map(self.part, (*before, *self.triples.items(head))))

    def subjects(self, kind: str) -> list[Any]:
        """What has this type; the triples count as used."""
        found = self.triples.of_type(Iri(kind))
        self.triples.used.update((s, _TYPE, Iri(kind)) for s in found)
        return found


def read_header(reader: GraphReader) -> None:
    """The ontology's own name, and what it needs."""
    for subject in reader.subjects(f"{OWL}Ontology"):
        reader.headers.add(subject)
        if isinstance(subject, Iri):
            reader.ontology.iris.append(subject.text)
        for value in reader.triples.values(subject, f"{OWL}imports"):
            reader.ontology.imports.append((value.text if isinstance(value, Iri) else str(value), reader.place))


def read_declarations(reader: GraphReader) -> None:
    """What each IRI is declared as."""
    for iri, kind in _KINDS.items():
        for subject in reader.subjects(iri):
            if isinstance(subject, Iri):
                reader.ontology.declare(subject.text, kind)
    for kind_ in (f"{RDF}Property", f"{RDF}List", f"{OWL}Restriction", f"{OWL}DataRange", f"{SWRL}AtomList"):
        reader.subjects(kind_)
    for kind_ in (f"{SWRL}Variable", f"{SWRL}Builtin", f"{OWL}DeprecatedClass", f"{OWL}DeprecatedProperty"):
        reader.subjects(kind_)
    for name in _OBJECTS_ONLY:
        for subject in (s for s in reader.triples.of_type(Iri(OWL + name)) if isinstance(s, Iri)):
            reader.ontology.declare(subject.text, Kind.OBJECT)


def read_attached(reader: GraphReader) -> None:
    """Annotations of axioms: the axioms themselves are there besides, but for a slip of whoever wrote the file."""
    for kind in _ATTACHED:
        for node in reader.subjects(kind):
            keys = (f"{OWL}annotatedSource", f"{OWL}annotatedProperty", f"{OWL}annotatedTarget")
            said = dict(reader.triples.about(node))
            source, predicate, target = (said.get(key) for key in keys)
            if target == Iri(f"{SWRL}Imp") and isinstance(said.get(_LABEL), Value):
                reader.rule_labels[source] = said[_LABEL].lexical
            stated = isinstance(predicate, Iri) and reader.triples.states(source, predicate.text, target)
            if kind == _ATTACHED[0] and not stated and not isinstance(source, Anonymous):
                reader.ontology.puzzles.append((reader.place, "an annotated axiom is not stated itself; state it"))


def read_rules(reader: GraphReader) -> None:
    """The rules of SWRL, each with its label."""
    for node in reader.subjects(f"{SWRL}Imp"):
        labels = [v.lexical for v in reader.triples.values(node, _LABEL) if isinstance(v, Value)]
        label = labels[0] if labels else reader.rule_labels.get(node, "")
        try:
            rule = reader.expressions.rule(node)
            reader.ontology.axioms.append(Axiom(rule, reader.place, label))
        except Misread as mistake:
            named = label or "a SWRL rule"
            reader.ontology.puzzles.append((reader.place, f"{named}: {mistake}; nothing was made of it"))


def read_labels(reader: GraphReader) -> None:
    """Labels; the other annotations of RDFS and OWL mean nothing."""
    for subject, value in reader.triples.take(_LABEL):
        if isinstance(subject, Iri) and isinstance(value, Value):
            reader.ontology.labels.setdefault(subject.text, []).append(value.lexical)
    for predicate in _SILENT:
        for _ in reader.triples.take(predicate):
            pass
