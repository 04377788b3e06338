"""Random small ontologies of the OWL 2 RL profile, as expressions, as functional syntax and as RDF triples."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count

from hypothesis import strategies as st
from rdflib import OWL, RDF, RDFS, XSD, BNode, Graph, Literal, URIRef

from casper.kb.ontologies.expressions import THING, Expression, Iri, Part

BASE = "http://z.org/zoo#"
CLASSES, PROPERTIES, INDIVIDUALS = ([Iri(BASE + x) for x in names] for names in ("ABC", "pqr", "uvwx"))

classes, properties, individuals = map(st.sampled_from, (CLASSES, PROPERTIES, INDIVIDUALS))
roles = st.one_of(properties, properties, st.builds(lambda p: Expression("InverseOf", (p,)), properties))


def made(name: str, *parts: st.SearchStrategy[Part] | int) -> st.SearchStrategy[Expression]:
    """Expressions of a constructor."""
    drawn = [st.just(part) if isinstance(part, int) else part for part in parts]
    return st.tuples(*drawn).map(lambda args: Expression(name, args))


def _lower(inner: st.SearchStrategy[Part]) -> st.SearchStrategy[Part]:
    return st.one_of(
        made("IntersectionOf", inner, inner),
        made("UnionOf", inner, inner),
        made("SomeValuesFrom", roles, inner),
    )


def _upper(inner: st.SearchStrategy[Part]) -> st.SearchStrategy[Part]:
    return st.one_of(made("IntersectionOf", inner, inner), made("AllValuesFrom", roles, inner))


lower = st.recursive(
    st.one_of(
        classes,
        classes,
        made("HasValue", roles, individuals),
        made("OneOf", individuals, individuals),
        made("SomeValuesFrom", roles, st.just(THING)),
    ),
    _lower,
    max_leaves=3,
)
upper = st.recursive(
    st.one_of(
        classes,
        classes,
        made("HasValue", roles, individuals),
        made("ComplementOf", classes),
        made("MaxCardinality", 0, roles),
        made("MaxCardinality", 1, roles),
        made("MaxCardinality", 1, roles, classes),
        made("MaxCardinality", 0, roles, classes),
    ),
    _upper,
    max_leaves=3,
)
facts = st.one_of(
    made("ClassAssertion", classes, individuals),
    made("PropertyAssertion", properties, individuals, individuals),
    made("PropertyAssertion", properties, individuals, individuals),
)
chains = made("PropertyChain", roles, roles)
axioms = st.one_of(
    made("SubClassOf", lower, upper),
    made("SubClassOf", lower, upper),
    made("EquivalentClasses", classes, classes),
    made("DisjointClasses", classes, classes),
    made("PropertyDomain", properties, upper),
    made("PropertyRange", properties, upper),
    made("SubPropertyOf", roles, properties),
    made("SubPropertyOf", chains, properties),
    made("InverseProperties", properties, properties),
    made("EquivalentProperties", properties, properties),
    made("DisjointProperties", properties, properties),
    *(
        made(f"{kind}Property", properties)
        for kind in ("Functional", "InverseFunctional", "Symmetric", "Asymmetric", "Irreflexive", "Transitive")
    ),
    made("HasKey", classes, properties),
    made("SameIndividual", individuals, individuals),
    made("DifferentIndividuals", individuals, individuals),
    made("NegativePropertyAssertion", properties, individuals, individuals),
)
ontologies = st.tuples(st.lists(facts, min_size=3, max_size=9), st.lists(axioms, min_size=1, max_size=6)).map(
    lambda pair: [*pair[0], *pair[1]]
)

_FULL = {  # what functional syntax calls them, where it is not Object and the name
    "SubClassOf", "EquivalentClasses", "DisjointClasses", "HasKey", "SameIndividual", "DifferentIndividuals",
    "ClassAssertion",
}  # fmt: skip


def functional_text(axioms: list[Expression]) -> str:
    """The axioms as a document of functional syntax."""
    declared = [f"Declaration(Class(<{x.text}>))" for x in CLASSES]
    declared += [f"Declaration(ObjectProperty(<{x.text}>))" for x in PROPERTIES]
    declared += [f"Declaration(NamedIndividual(<{x.text}>))" for x in INDIVIDUALS]
    return f"Ontology(<{BASE[:-1]}>\n" + "\n".join([*declared, *map(_functional, axioms)]) + "\n)\n"


def _functional(part: Part) -> str:
    if isinstance(part, Iri):
        return f"<{part.text}>"
    if not isinstance(part, Expression):
        return str(part)
    name, args = part.name, [_functional(arg) for arg in part.args]
    if name == "HasKey":
        return f"HasKey({args[0]} ({' '.join(args[1:])}) ())"
    if "Propert" in name and name != "PropertyChain":
        full = name.replace("Propert", "ObjectPropert")
    else:
        full = name if name in _FULL else f"Object{name}"
    return f"{full}({' '.join(args)})"


def rdf_graph(axioms: list[Expression]) -> Graph:
    """The axioms as triples, by the mapping of the recommendation."""
    graph = Graph()
    graph.add((URIRef(BASE[:-1]), RDF.type, OWL.Ontology))
    for group, kind in ((CLASSES, OWL.Class), (PROPERTIES, OWL.ObjectProperty), (INDIVIDUALS, OWL.NamedIndividual)):
        for iri in group:
            graph.add((URIRef(iri.text), RDF.type, kind))
    writer = _Triples(graph)
    for axiom in axioms:
        writer.axiom(axiom)
    return graph


_ONE_TRIPLE = {
    "SubClassOf": RDFS.subClassOf,
    "EquivalentClasses": OWL.equivalentClass,
    "DisjointClasses": OWL.disjointWith,
    "PropertyDomain": RDFS.domain,
    "PropertyRange": RDFS.range,
    "EquivalentProperties": OWL.equivalentProperty,
    "InverseProperties": OWL.inverseOf,
    "DisjointProperties": OWL.propertyDisjointWith,
    "SameIndividual": OWL.sameAs,
    "DifferentIndividuals": OWL.differentFrom,
}
_LISTED = {"IntersectionOf": OWL.intersectionOf, "UnionOf": OWL.unionOf, "OneOf": OWL.oneOf}
_RESTRICTED = {"SomeValuesFrom": OWL.someValuesFrom, "AllValuesFrom": OWL.allValuesFrom, "HasValue": OWL.hasValue}


class _Triples:
    def __init__(self, graph: Graph) -> None:
        self.graph = graph
        self._nodes = (BNode(f"n{number}") for number in count(1))

    def axiom(self, axiom: Expression) -> None:
        add, name, args = self.graph.add, axiom.name, axiom.args
        if name in _ONE_TRIPLE:
            add((self.node(args[0]), _ONE_TRIPLE[name], self.node(args[1])))
        elif name == "ClassAssertion":
            add((self.node(args[1]), RDF.type, self.node(args[0])))
        elif name == "PropertyAssertion":
            add((self.node(args[1]), self.node(args[0]), self.node(args[2])))
        elif name == "NegativePropertyAssertion":
            node = next(self._nodes)
            add((node, RDF.type, OWL.NegativePropertyAssertion))
            for key, part in zip((OWL.assertionProperty, OWL.sourceIndividual, OWL.targetIndividual), args):
                add((node, key, self.node(part)))
        elif name == "HasKey":
            add((self.node(args[0]), OWL.hasKey, self.listed(args[1:])))
        elif name == "SubPropertyOf" and isinstance(args[0], Expression) and args[0].name == "PropertyChain":
            add((self.node(args[1]), OWL.propertyChainAxiom, self.listed(args[0].args)))
        elif name == "SubPropertyOf":
            add((self.node(args[0]), RDFS.subPropertyOf, self.node(args[1])))
        else:
            add((self.node(args[0]), RDF.type, OWL[name]))

    def listed(self, parts: tuple[Part, ...]) -> BNode | URIRef:
        head: BNode | URIRef = RDF.nil
        for part in reversed(parts):
            node = next(self._nodes)
            self.graph.add((node, RDF.first, self.node(part)))
            self.graph.add((node, RDF.rest, head))
            head = node
        return head

    def node(self, part: Part) -> BNode | URIRef:
        if isinstance(part, Iri):
            return URIRef(part.text)
        assert isinstance(part, Expression)
        node = next(self._nodes)
        self._describe(node, part.name, part.args)
        return node

    def _describe(self, node: BNode, name: str, args: tuple[Part, ...]) -> None:
        add = self.graph.add
        if name == "InverseOf":
            add((node, OWL.inverseOf, self.node(args[0])))
            return
        if name in _LISTED or name == "ComplementOf":
            add((node, RDF.type, OWL.Class))
            value = self.node(args[0]) if name == "ComplementOf" else self.listed(args)
            add((node, _LISTED.get(name, OWL.complementOf), value))
            return
        add((node, RDF.type, OWL.Restriction))
        if name in _RESTRICTED:
            add((node, OWL.onProperty, self.node(args[0])))
            add((node, _RESTRICTED[name], self.node(args[1])))
            return
        number = Literal(str(args[0]), datatype=XSD.nonNegativeInteger)
        add((node, OWL.onProperty, self.node(args[1])))
        add((node, OWL.maxQualifiedCardinality if len(args) > 2 else OWL.maxCardinality, number))
        if len(args) > 2:
            add((node, OWL.onClass, self.node(args[2])))


def named(graph: Graph) -> Iterator[tuple[str, str, str]]:
    """What a graph says of the named individuals: types, properties, sameness; local names."""
    mine = {URIRef(iri.text) for group in (CLASSES, PROPERTIES, INDIVIDUALS) for iri in group}
    things = {URIRef(iri.text) for iri in INDIVIDUALS}
    for s, p, o in graph:
        if s in things and o in mine and (p == RDF.type or p in mine):
            yield str(s)[-1], "type" if p == RDF.type else str(p)[-1], str(o)[-1].lower()
        elif s in things and o in things and p == OWL.sameAs and s != o:
            yield str(s)[-1], "same", str(o)[-1]
