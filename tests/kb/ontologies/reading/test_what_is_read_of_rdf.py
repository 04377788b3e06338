"""Every triple of an RDF file is read, or told; and rdflib's own log stays silent."""

import logging

import pytest
from ontologies import imported_text

HEAD = """@prefix : <http://z.org/zoo#> . @prefix owl: <http://www.w3.org/2002/07/owl#> . @prefix swrl: <http://www.w3.org/2003/11/swrl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> . @prefix xsd: <http://www.w3.org/2001/XMLSchema#> .
:Dog a owl:Class . :Cat a owl:Class . :likes a owl:ObjectProperty . :age a owl:DatatypeProperty . :rex a owl:NamedIndividual .
"""


def read(text):
    found = imported_text(HEAD + text, "ttl")
    return found, [f.message for f in found.findings if f.severity != "note"]


@pytest.mark.parametrize(
    ("text", "fact", "holds"),
    [
        (
            ":Dog rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :likes ; owl:hasSelf true ] . :rex a :Dog .",
            "likes(rex, rex)",
            True,
        ),
        (
            "[] a owl:NegativePropertyAssertion ; owl:sourceIndividual :rex ; owl:assertionProperty :weight ; owl:targetValue 3 .",
            "weight(rex, 3)",
            False,
        ),
    ],
)
def test_what_is_said_is_read_to_its_last_triple(text, fact, holds):
    found, findings = read(text)
    assert findings == []
    assert found.knowledge_base().ask(fact) is holds


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (
            "[] a owl:NegativePropertyAssertion ; owl:sourceIndividual :rex ; owl:targetIndividual :rex .",
            "a negative assertion lacks a part",
        ),
        (
            "[] a owl:NegativePropertyAssertion ; owl:assertionProperty :likes ; owl:targetIndividual :rex .",
            "a negative assertion lacks a part",
        ),
        (
            "[] a owl:NegativePropertyAssertion ; owl:sourceIndividual :rex ; owl:assertionProperty :likes .",
            "a negative assertion lacks a part",
        ),
        (
            ":Dog rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :likes ] .",
            "a restriction says nothing of its property",
        ),
        (
            ':Dog rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :likes ; owl:maxCardinality "few" ] .',
            "maxCardinality needs a number",
        ),
        (
            "[] a swrl:Imp ; swrl:body ( [ a swrl:ClassAtom ; swrl:classPredicate :Dog ] ) ; swrl:head () .",
            "a swrl:ClassAtom lacks an argument",
        ),
    ],
)
def test_what_is_not_whole_is_told(text, told):
    _, findings = read(text)
    assert any(told in finding for finding in findings), findings


def test_a_name_may_be_defined_as_a_union_without_more_words():
    found, findings = read(":Pet owl:unionOf ( :Dog :Cat ) . :Pet a owl:Class . :rex a :Cat .")
    assert found.knowledge_base().ask("pet(rex)")
    assert [finding.split(":")[0] for finding in findings] == [
        "Pet EquivalentTo Dog or Cat"
    ]  # the other way is a choice


def test_values_that_are_misspelt_are_told_by_us_alone(caplog):
    with caplog.at_level(logging.WARNING):
        _, findings = read(':rex :age "old"^^xsd:integer .')
    assert caplog.records == [] and any("old" in finding for finding in findings)
    assert logging.getLogger("rdflib").level == logging.NOTSET  # and it may speak again
