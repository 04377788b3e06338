"""What the rules derive is what the W3C's rule tables derive (owlrl), and both syntaxes give the same text."""

import owlrl
from hypothesis import given, note
from ontologies import imported_text
from random_ontologies import CLASSES, PROPERTIES, functional_text, named, ontologies, rdf_graph
from rdflib import URIRef

ERROR = URIRef("http://www.daml.org/2002/03/agents/agent-ont#error")


def by_the_tables(axioms):
    graph = rdf_graph(axioms)
    for iri in CLASSES:  # owlrl loses rdf:type Class of nothing else, and every name is one of ours
        assert (URIRef(iri.text), None, None) in graph
    owlrl.DeductiveClosure(owlrl.OWLRL_Semantics, axiomatic_triples=False, datatype_axioms=False).expand(graph)
    return set(named(graph)), (None, ERROR, None) in graph


def by_our_rules(kb):
    found = set()
    for iri in CLASSES:
        name = iri.text[-1].lower()
        found |= {(x, "type", name) for (x,) in kb.rows(name, 1)}
    for iri in PROPERTIES:
        found |= {(x, iri.text[-1], y) for x, y in kb.rows(iri.text[-1], 2)}
    found |= {(x, "same", y) for x, y in kb.rows("same", 2)}
    return found, bool(kb.broken())


# owlrl takes two things that have no value of a key for one (its prp-key holds of nothing), so keys have their own test.
@given(ontologies.filter(lambda axioms: all(axiom.name != "HasKey" for axiom in axioms)))
def test_the_rules_derive_what_the_profile_s_rule_tables_derive(axioms):
    text = functional_text(axioms)
    note(text)
    imported = imported_text(text, "ofn")
    assert [f.message for f in imported.findings if "contradicts" not in f.message] == []
    note(imported.files["ontology.pl"])
    kb = imported.knowledge_base()
    stated, broken = by_our_rules(kb)
    derived, clash = by_the_tables(axioms)
    clash = clash or any("contradicts" in f.message for f in imported.findings)
    broken = broken or any("contradicts" in f.message for f in imported.findings)
    assert broken == clash
    if not clash:
        assert stated == derived


@given(ontologies)
def test_functional_syntax_and_triples_give_the_same_text(axioms):
    triples = imported_text(rdf_graph(axioms).serialize(format="nt"), "nt")
    assert triples.files == imported_text(functional_text(axioms), "ofn").files
