"""RDF triples to axioms, by the mapping of the OWL 2 recommendation; what is left over is told."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from casper.kb.errors import Place
from casper.kb.ontologies.citing import local_name
from casper.kb.ontologies.expressions import (
    NOTHING,
    OWL,
    RDF,
    RDFS,
    SWRL,
    THING,
    Anonymous,
    Axiom,
    Expression,
    Iri,
    Kind,
    Ontology,
    Part,
    Value,
)
from casper.kb.ontologies.reading.rdf_expressions import DEFINING, ExpressionReader
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
_CHARACTERISTICS = (
    "FunctionalProperty",
    "InverseFunctionalProperty",
    "ReflexiveProperty",
    "IrreflexiveProperty",
    "SymmetricProperty",
    "AsymmetricProperty",
    "TransitiveProperty",
)
_OBJECTS_ONLY = _CHARACTERISTICS[1:]
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
_SILENT = {  # annotations of OWL and RDFS themselves
    *(RDFS + name for name in ("comment", "seeAlso", "isDefinedBy")),
    *(OWL + name for name in ("versionInfo", "versionIRI", "deprecated", "priorVersion", "backwardCompatibleWith")),
    f"{OWL}incompatibleWith",
}
_OUR_WORDS = (OWL, RDF, RDFS, SWRL)
_ATTACHED = (f"{OWL}Axiom", f"{OWL}Annotation")


def ontology_of(triples: Triples, file: str) -> Ontology:
    """The axioms of a graph; puzzles are the triples that no axiom accounts for."""
    reader = _Reader(triples, file)
    for step in _STEPS:
        step(reader)
    return reader.ontology


class _Reader:
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
        found = [s for s, o in self.triples.pairs(_TYPE) if o == Iri(kind)]
        self.triples.used.update((s, _TYPE, Iri(kind)) for s in found)
        return found


def _header(reader: _Reader) -> None:
    for subject in reader.subjects(f"{OWL}Ontology"):
        reader.headers.add(subject)
        if isinstance(subject, Iri):
            reader.ontology.iris.append(subject.text)
        for value in reader.triples.values(subject, f"{OWL}imports"):
            reader.ontology.imports.append((value.text if isinstance(value, Iri) else str(value), reader.place))


def _declarations(reader: _Reader) -> None:
    for iri, kind in _KINDS.items():
        for subject in reader.subjects(iri):
            if isinstance(subject, Iri):
                reader.ontology.declare(subject.text, kind)
    for kind_ in (f"{RDF}Property", f"{RDF}List", f"{OWL}Restriction", f"{OWL}DataRange", f"{SWRL}AtomList"):
        reader.subjects(kind_)
    for kind_ in (f"{SWRL}Variable", f"{SWRL}Builtin", f"{OWL}DeprecatedClass", f"{OWL}DeprecatedProperty"):
        reader.subjects(kind_)
    for name in _OBJECTS_ONLY:
        for subject in (s for s, o in reader.triples.pairs(_TYPE) if o == Iri(OWL + name) and isinstance(s, Iri)):
            reader.ontology.declare(subject.text, Kind.OBJECT)


def _attached(reader: _Reader) -> None:
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


def _rules(reader: _Reader) -> None:
    for node in reader.subjects(f"{SWRL}Imp"):
        labels = [v.lexical for v in reader.triples.values(node, _LABEL) if isinstance(v, Value)]
        label = labels[0] if labels else reader.rule_labels.get(node, "")
        try:
            rule = reader.expressions.rule(node)
            reader.ontology.axioms.append(Axiom(rule, reader.place, label))
        except Misread as mistake:
            named = label or "a SWRL rule"
            reader.ontology.puzzles.append((reader.place, f"{named}: {mistake}; nothing was made of it"))
        for predicate in (*_SILENT, *_annotations(reader)):
            reader.triples.values(node, predicate)


def _annotations(reader: _Reader) -> list[str]:
    return [iri for iri, kinds in reader.ontology.kinds.items() if kinds == {Kind.ANNOTATION}]


def _groups(reader: _Reader) -> None:
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


def _pairs(reader: _Reader) -> None:
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


def _only_annotates(reader: _Reader, subject: Iri) -> bool:
    return reader.ontology.kinds.get(subject.text) == {Kind.ANNOTATION}


def _defines_datatype(reader: _Reader, name: str, subject: Any) -> bool:
    is_type = isinstance(subject, Iri) and reader.ontology.is_a(subject.text, Kind.DATATYPE)
    return name == "EquivalentClasses" and is_type


def _definitions(reader: _Reader) -> None:
    """``:Pet owl:unionOf (…)``: an IRI that is defined as if it were a blank node is equivalent to the expression."""
    for key in DEFINING:
        for subject, _ in list(reader.triples.pairs(OWL + key)):
            if isinstance(subject, Iri):
                defined = lambda s=subject, k=key: (s, reader.expressions.defined(s, k))  # noqa: E731
                reader.add("EquivalentClasses", defined)


def _types(reader: _Reader) -> None:
    for name in _CHARACTERISTICS:
        for subject in reader.subjects(OWL + name):
            reader.add(name, reader.parts(subject))
    for subject, value in list(reader.triples.take(_TYPE)):
        if isinstance(value, Iri) and value.text.startswith(_OUR_WORDS) and value not in (THING, NOTHING):
            reader.triples.used.discard((subject, _TYPE, value))
            continue  # told in the end
        reader.add("ClassAssertion", reader.parts(value, subject))


def _labels(reader: _Reader) -> None:
    for subject, value in reader.triples.take(_LABEL):
        if isinstance(subject, Iri) and isinstance(value, Value):
            reader.ontology.labels.setdefault(subject.text, []).append(value.lexical)
    for predicate in _SILENT:
        for _ in reader.triples.take(predicate):
            pass


def _assertions(reader: _Reader) -> None:
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


def _left_over(reader: _Reader) -> None:
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


_STEPS: tuple[Callable[[_Reader], None], ...] = (
    _header, _declarations, _attached, _rules, _groups, _pairs, _definitions, _types, _labels, _assertions, _left_over,
)
