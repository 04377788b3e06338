"""Nodes of functional syntax or OWL/XML to axioms: one name for Object and Data, kinds noted, annotations apart."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from casper.kb.ontologies.expressions import RDFS, Axiom, Expression, Iri, Kind, Ontology, Part, Unknown, Value
from casper.kb.ontologies.reading.nodes import Entity, Item, Node
from casper.kb.terms.clauses import NOWHERE

_FIRST, _EVERY = slice(1), slice(None)
_COUNTED = slice(2)  # behind a number
_PROPERTIES: dict[str, slice] = {  # where the properties of a constructor stand
    "SomeValuesFrom": _FIRST,
    "AllValuesFrom": _FIRST,
    "HasValue": _FIRST,
    "HasSelf": _FIRST,
    "MinCardinality": _COUNTED,
    "MaxCardinality": _COUNTED,
    "ExactCardinality": _COUNTED,
    "InverseOf": _EVERY,
    "PropertyChain": _EVERY,
    "SubPropertyOf": _EVERY,
    "EquivalentProperties": _EVERY,
    "DisjointProperties": _EVERY,
    "InverseProperties": _EVERY,
    "PropertyDomain": _FIRST,
    "PropertyRange": _FIRST,
    "FunctionalProperty": _EVERY,
    "InverseFunctionalProperty": _EVERY,
    "ReflexiveProperty": _EVERY,
    "IrreflexiveProperty": _EVERY,
    "SymmetricProperty": _EVERY,
    "AsymmetricProperty": _EVERY,
    "TransitiveProperty": _EVERY,
    "PropertyAssertion": _FIRST,
    "NegativePropertyAssertion": _FIRST,
    "PropertyAtom": _FIRST,
}
_ANNOTATING = ("AnnotationAssertion", "SubAnnotationPropertyOf", "AnnotationPropertyDomain", "AnnotationPropertyRange")
_AXIOMS = {
    *_PROPERTIES, "SubClassOf", "EquivalentClasses", "DisjointClasses", "DisjointUnion", "HasKey", "SameIndividual",
    "DifferentIndividuals", "ClassAssertion", "DatatypeDefinition",
} - {"SomeValuesFrom", "AllValuesFrom", "HasValue", "HasSelf", "MinCardinality", "MaxCardinality", "ExactCardinality",
     "InverseOf", "PropertyChain", "PropertyAtom"}
_LABEL = f"{RDFS}label"


def ontology_of(root: Node) -> Ontology:
    """The axioms of an ``Ontology`` node; what is none is a puzzle of the ontology."""
    ontology = Ontology()
    for item in root.items:
        if isinstance(item, Iri) and not ontology.iris:
            ontology.iris.append(item.text)
        elif isinstance(item, Node):
            _take(item, ontology)
    return ontology


def _take(node: Node, ontology: Ontology) -> None:
    if node.name == "Import":
        ontology.imports += [(item.text, node.place) for item in node.items if isinstance(item, Iri)]
    elif node.name == "Declaration":
        for item in node.items:
            if isinstance(item, Entity):
                ontology.declare(item.iri.text, Kind(item.kind))
    elif node.name == "AnnotationAssertion":
        _annotate([x for x in node.items if not _is_annotation(x)], ontology)
    elif node.name == "DLSafeRule":
        _take_rule(node, ontology)
    elif node.name not in ("Annotation", *_ANNOTATING):
        _take_axiom(node, ontology)


def _take_axiom(node: Node, ontology: Ontology) -> None:
    expression = _Reader(ontology).part(node)
    assert isinstance(expression, Expression)
    if expression.name not in _AXIOMS:
        ontology.puzzles.append((node.place, f"{node.name} is no axiom of OWL 2; nothing was made of it"))
        return
    if len(expression.args) < (1 if expression.name in _PROPERTIES else 2):
        ontology.puzzles.append((node.place, f"{node.name} has too few arguments; mend the axiom"))
        return
    ontology.axioms += [Axiom(x, node.place) for x in split(expression)]


def _take_rule(node: Node, ontology: Ontology) -> None:
    """``DLSafeRule(Body(…) Head(…))``."""
    halves = {item.name: item for item in node.items if isinstance(item, Node)}
    if "Body" not in halves or "Head" not in halves:
        ontology.puzzles.append((node.place, "a rule has a Body(…) and a Head(…); mend the rule"))
        return
    read = _Reader(ontology).part
    body, head = (Expression(name, tuple(map(read, halves[name].items))) for name in ("Body", "Head"))
    ontology.axioms.append(Axiom(Expression("Rule", (body, head)), node.place, _label(node)))


def _annotate(items: Sequence[Item], ontology: Ontology) -> None:
    match [x.iri if isinstance(x, Entity) else x for x in items]:
        case [Iri(text), Iri(subject), Value(lexical)] if text == _LABEL:
            ontology.labels.setdefault(subject, []).append(lexical)
        case [Iri(_), *_]:
            pass  # other annotations mean nothing
        case _:
            ontology.puzzles.append((NOWHERE, "an annotation without a property"))


def _is_annotation(item: Item) -> bool:
    return isinstance(item, Node) and item.name == "Annotation"


def _label(node: Node) -> str:
    """The axiom's own label, of its annotations."""
    for item in node.items:
        if isinstance(item, Node) and item.name == "Annotation":
            parts = [x.iri if isinstance(x, Entity) else x for x in item.items]
            if Iri(_LABEL) in parts and isinstance(parts[-1], Value):
                return parts[-1].lexical
    return ""


def split(expression: Expression) -> list[Expression]:
    """An axiom as RDF has it: equivalence and sameness of several things are pairs of neighbours."""
    if expression.name in ("EquivalentClasses", "EquivalentProperties", "SameIndividual"):
        pairs = zip(expression.args, expression.args[1:])
        return [Expression(expression.name, pair) for pair in pairs]
    return [expression]


def plain_name(name: str) -> str:
    """The name of a constructor without Object and Data: ``SubDataPropertyOf`` is ``SubPropertyOf``."""
    for kind in ("Object", "Data"):
        if name.startswith(kind) and not name.startswith("Datatype"):
            return name.removeprefix(kind)
        name = name.replace(f"{kind}Propert", "Propert")
    return name


class _Reader:
    """Makes expressions of nodes, and notes of what kind every property is."""

    def __init__(self, ontology: Ontology) -> None:
        self._ontology = ontology

    def part(self, item: Item) -> Part:
        if isinstance(item, Entity):
            self._ontology.declare(item.iri.text, Kind(item.kind))
            return item.iri
        return self._expression(item) if isinstance(item, Node) else item

    def _expression(self, node: Node) -> Part:
        match node:
            case Node("Variable", (Iri(iri),)):
                return Unknown(variable_name(iri))
        name = plain_name(node.name)
        if name == "HasKey":
            return self._key(node)
        args = tuple(self.part(item) for item in node.items if not _is_annotation(item))
        if name == "DatatypeRestriction":
            args = (*args[:1], *_facets(args[1:]))
        if name in _PROPERTIES:
            self._note(node.name, args[_PROPERTIES[name]])
        return Expression(name, args)

    def _note(self, name: str, properties: Sequence[Part]) -> None:
        """The kind of properties, told by the constructor's full name."""
        kind = Kind.DATA if "Data" in name else Kind.OBJECT
        for part in properties:
            if isinstance(part, Iri):
                self._ontology.declare(part.text, kind)

    def _key(self, node: Node) -> Expression:
        """``HasKey(C (object properties) (data properties))``; in XML the properties say themselves what they are."""
        args: list[Part] = []
        kind = "Object"
        for item in node.items:
            if isinstance(item, Node) and not item.name:
                members = [self.part(member) for member in item.items]
                self._note(kind, members)
                args += members
                kind = "Data"
            elif not _is_annotation(item):
                args.append(self.part(item))
        return Expression("HasKey", tuple(args))


def _facets(args: Sequence[Part]) -> Iterator[Expression]:
    """The facets of a restriction: pairs in functional syntax, elements in XML."""
    plain = [x for x in args if not isinstance(x, Expression)]
    yield from (x for x in args if isinstance(x, Expression))
    yield from (Expression("FacetRestriction", tuple(plain[at : at + 2])) for at in range(0, len(plain), 2))


def variable_name(iri: str) -> str:
    """The name of a SWRL variable, which files spell as an IRI."""
    return iri.rpartition("#")[2].rpartition("/")[2].rpartition(":")[2] or iri

