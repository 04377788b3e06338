"""Readable names for IRIs, each its own, and the way back to RDF."""

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from ontologies import imported, imported_text, kb_of, rows
from rdflib import Graph, Literal
from rdflib.compare import isomorphic

from casper import KnowledgeBase
from casper.kb.ontologies.expressions import Kind, Ontology
from casper.kb.ontologies.vocabulary.names import names_of, readable_name


@pytest.mark.parametrize(
    ("iri", "labels", "name"),
    [
        ("http://z.org/zoo#PetOwner", [], "pet_owner"),
        ("http://z.org/zoo/hasPet", [], "has_pet"),
        ("urn:zoo:DNASample", [], "dna_sample"),
        ("http://z.org/zoo#rex-the-2nd", [], "rex_the_2nd"),
        ("http://z.org/zoo#42", [], "n42"),
        ("http://z.org/zoo#Caf%C3%A9", [], "cafe"),
        ("http://purl.org/obo/GO_0008150", ["biological process"], "biological_process"),
        ("http://purl.org/obo/GO_0008150", [], "go_0008150"),
        ("http://z.org/zoo#猫", [], "猫"),
    ],
)
def test_a_name_is_the_local_name_in_words(iri, labels, name):
    assert readable_name(iri, labels) == name


LOCAL = st.text(st.characters(codec="utf-8", exclude_characters="\x00", exclude_categories=("Cs",)), max_size=6)


@example({"http://a.org/#[]", "http://a.org/#!", "urn:c:"})
@given(st.sets(st.tuples(st.sampled_from(["http://a.org/#", "http://b.org/x/", "urn:c:"]), LOCAL).map("".join), max_size=12))
def test_no_two_iris_share_a_name_and_every_name_can_be_written(iris):
    ontology = Ontology()
    for iri in iris:
        ontology.declare(iri, Kind.CLASS)
    names = names_of(ontology)
    assert set(names) == iris and len(set(names.values())) == len(iris)
    for name in names.values():
        kb = KnowledgeBase()
        kb.fact((name, "x"))
        assert KnowledgeBase.from_text(kb.to_text()).ask((name, "x"))


def test_the_same_local_name_in_two_namespaces_is_told_apart_and_told():
    found = imported("SubClassOf(:Dog <http://other.org/Dog>)", "ClassAssertion(:Dog :rex)")
    kb = found.knowledge_base()
    assert rows(kb, "iri(N, 'http://z.org/zoo#Dog')") == [("dog_2",)]
    assert kb.ask("dog(rex)") and kb.ask("dog_2(rex)")
    assert ["is called dog_2 here" in f.message for f in found.findings] == [True]


@pytest.mark.parametrize("word", ["claim", "did", "never", "valid", "uses", "goal", "same", "thing", "is"])
def test_words_with_a_meaning_to_the_system_are_no_names(word):
    found = imported(f"ClassAssertion(:{word} :rex)", f"ObjectPropertyAssertion(:{word} :rex :rex)")
    assert rows(found.knowledge_base(), f"{word}_2(rex)") == [()]
    assert rows(found.knowledge_base(), f"{word}_2(rex, rex)") == [()]


def test_labels_are_comments():
    text = imported('AnnotationAssertion(rdfs:label :Dog "a\ndog")', "Declaration(Class(:Dog))").files["ontology.pl"]
    assert '% dog(X): Dog, "a dog"\n:- dynamic(dog/1).' in text


def test_labels_of_individuals_are_comments():
    text = imported('AnnotationAssertion(rdfs:label :rex "Rex the dog")', "ClassAssertion(:Dog :rex)").files["ontology.pl"]
    assert "% rex: Rex the dog" in text


@pytest.mark.parametrize("header", ["<http://z.org/zoo>", "[]"])
def test_what_is_said_of_the_ontology_itself_is_no_fact(header):
    text = f'@prefix owl: <http://www.w3.org/2002/07/owl#> . {header} a owl:Ontology ; <http://purl.org/dc/terms/title> "x" .'
    assert imported_text(text, "ttl").knowledge_base().to_rdf() == ""


def test_triples_in_the_words_of_rdf_that_mean_no_axiom_are_told():
    text = "<http://z.org/a> <http://www.w3.org/2000/01/rdf-schema#member> <http://z.org/b> ."
    (told, *_) = imported_text(text, "ttl").findings
    assert told.message == "member of a is part of no axiom that could be read, and was left out"


FACTS = """@prefix : <http://z.org/zoo#> . @prefix xsd: <http://www.w3.org/2001/XMLSchema#> .
:rex a :Dog ; :owner :ann, [ a :Person ] ; :name "Rex", "Réx \\"the\\n\\\\dog"@fr ; :age 3 ; :weight 7.25 ; :dog "rex" ;
  :born "2026-01-01"^^xsd:date ; :wet true ; :size "1.5E1"^^xsd:double ; :seen "2026-01-01T12:00:00+00:00"^^xsd:dateTime ;
  :code "x17"^^:Chip, "today"^^:date .
"""


def same_graph(one, other):
    return isomorphic(normal(one), normal(other))


def normal(graph):
    """With every literal in its canonical spelling."""
    plain = Graph()
    for s, p, o in graph:
        plain.add((s, p, o.normalize() if isinstance(o, Literal) else o))
    return plain


def test_the_facts_come_back_as_they_were():
    kb = imported_text(FACTS, "ttl").knowledge_base()
    assert same_graph(Graph().parse(data=kb.to_rdf(), format="nt"), Graph().parse(data=FACTS, format="turtle"))


def test_what_is_added_and_what_follows_comes_back_when_asked_for():
    kb = kb_of("SubClassOf(:Dog :Animal)", "ClassAssertion(:Dog :rex)", "SameIndividual(:rex :fido)")
    kb.assert_("dog(waldi)")
    stated, all_ = (Graph().parse(data=kb.to_rdf(derived=d), format="nt") for d in (False, True))
    ask = "ASK {{ <{0}> a <http://z.org/zoo#{1}> }}".format
    assert stated.query(ask("urn:casper:waldi", "Dog")).askAnswer
    assert not stated.query(ask("http://z.org/zoo#rex", "Animal")).askAnswer
    assert all_.query(ask("http://z.org/zoo#fido", "Animal")).askAnswer
    assert all_.query("ASK { ?x <http://www.w3.org/2002/07/owl#sameAs> <http://z.org/zoo#rex> }").askAnswer


def test_facts_without_iris_are_ours_and_those_with_three_parts_are_nodes():
    kb = KnowledgeBase.from_text('human(ann). at(ann, "the sink", 3). holds(ann, f(x, 2)). speed(3, 0.5).')
    graph = Graph().parse(data=kb.to_rdf(), format="nt")
    assert graph.query("ASK { <urn:casper:ann> a <urn:casper:human> }").askAnswer
    assert graph.query("ASK { ?x a <urn:casper:at/3> ; rdf:_2 <urn:casper:the%20sink> ; rdf:_3 3 }").askAnswer
    assert graph.query('ASK { ?x <urn:casper:holds> "f(x, 2)"^^<urn:casper:term> }').askAnswer
    assert graph.query("ASK { ?x a <urn:casper:speed/2> ; rdf:_1 3 ; rdf:_2 0.5 }").askAnswer


def test_the_kitchen_comes_out_as_triples():
    from casper import Domain

    kb = Domain.load("kitchen").kb
    graph = Graph().parse(data=kb.to_rdf(), format="nt")
    assert len(graph) > len([c for c in kb.clauses if not c.body]) * 0.9
    assert graph.query("ASK { ?x a <urn:casper:biscuits> }").askAnswer


CONSTANTS = st.one_of(st.integers(-(10**9), 10**9), st.floats(-1e6, 1e6), st.text(max_size=5))


@example([("p", "_:", 0.5), ("p", "_:a b", "_:"), ("q", "a>b", "\x00\ud7ff")])
@given(st.lists(st.tuples(st.sampled_from(["p", "q"]), st.text(min_size=1, max_size=4), CONSTANTS), max_size=6))
def test_triples_of_any_facts_can_be_read(facts):
    kb = KnowledgeBase()
    for fact in facts:
        kb.fact(fact)
    assert len(Graph().parse(data=kb.to_rdf(), format="nt")) <= 3 * len(set(facts))

