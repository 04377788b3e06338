"""What an undeclared name is, told by its use: Turtle has one spelling for properties of things and of values."""

import pytest
from ontologies import imported_text

PREFIXES = """@prefix : <http://z.org/zoo#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix xsd: <http://www.w3.org/2001/XMLSchema#> .
"""


def turtle(text):
    return imported_text(PREFIXES + text, "ttl")


def has_values(text, name="age"):
    return f"data_property({name})." in turtle(text).files["names.pl"].splitlines()


def restriction(rest):
    return f":Adult rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :age ; {rest} ] ."


@pytest.mark.parametrize(
    "text",
    [
        ":age rdfs:range xsd:integer .",
        restriction("owl:allValuesFrom xsd:integer"),
        restriction("owl:someValuesFrom xsd:integer"),
        restriction("owl:hasValue 18"),
        restriction("owl:maxQualifiedCardinality 1 ; owl:onDataRange xsd:integer"),
        ":ann :age 18 .",
        ":years rdfs:range xsd:integer . :age rdfs:subPropertyOf :years .",
        ":years rdfs:range xsd:integer . :years owl:equivalentProperty :age .",
        ":age rdfs:subPropertyOf :b . :b rdfs:subPropertyOf :c . :c rdfs:range xsd:integer .",
    ],
)
def test_a_property_has_values_when_it_is_used_with_a_value_or_a_datatype(text):
    assert has_values(text)


@pytest.mark.parametrize(
    "text",
    [
        ":age rdfs:range :Number .",
        restriction("owl:allValuesFrom :Number"),
        restriction("owl:hasValue :eighteen"),
        restriction("owl:maxQualifiedCardinality 1 ; owl:onClass :Number"),
        restriction("owl:maxCardinality 1"),
        ":ann :age :eighteen .",
    ],
)
def test_any_other_property_relates_individuals(text):
    assert not has_values(text)


@pytest.mark.parametrize(
    "kind",
    ["InverseFunctional", "Reflexive", "Irreflexive", "Symmetric", "Asymmetric", "Transitive"],
)
def test_a_characteristic_of_properties_between_individuals_makes_a_value_of_it_doubtful(kind):
    told = turtle(f':code a owl:{kind}Property . :ann :code "x" .').findings
    assert [f.message for f in told] == ["code relates individuals and values; make two properties of it"]


def test_a_property_of_values_may_be_functional():
    text = ':code a owl:FunctionalProperty . :ann :code "x" .'
    assert turtle(text).findings == [] and has_values(text, "code")


@pytest.mark.parametrize(("text", "suffix"), [("", "ttl"), ("Ontology(<http://z.org>)", "ofn")])
def test_an_ontology_that_states_nothing_is_told(text, suffix):
    assert [f.message for f in imported_text(text, suffix).findings] == ["nothing is stated in it"]


@pytest.mark.parametrize("text", [":Dog a owl:Class .", ":rex a :Dog ."])
def test_a_declaration_or_a_fact_is_something(text):
    assert turtle(text).findings == []


@pytest.mark.parametrize("expression", ["owl:onProperty :has ; owl:allValuesFrom :Dog", "owl:unionOf ( :Dog )"])
def test_a_type_of_an_expression_that_owl_has_no_meaning_for_is_told(expression):
    told = turtle(f":Cat rdfs:subClassOf [ a :Odd ; {expression} ] .").findings
    assert [f.message.endswith("is no individual and no value") for f in told] == [True]
    assert "Type Odd" in told[0].message


@pytest.mark.parametrize(
    "expression",
    [
        "a owl:Restriction ; owl:onProperty :has ; owl:allValuesFrom :Dog",
        "a owl:Class ; owl:complementOf :Dog",
        "a owl:Class ; owl:intersectionOf ( :Dog :Pet )",
        "a owl:Restriction ; owl:onProperty [ a owl:ObjectProperty ; owl:inverseOf :has ] ; owl:allValuesFrom :Dog",
        "a owl:Restriction ; owl:onProperty :age ; owl:allValuesFrom [ a rdfs:Datatype ; owl:onDatatype xsd:decimal ; "
        "owl:withRestrictions ( [ xsd:maxInclusive 30 ] ) ]",
        "a owl:Restriction ; owl:onProperty :age ; owl:allValuesFrom [ a owl:DataRange ; owl:oneOf ( 1 2 ) ]",
    ],
)
def test_the_types_that_owl_gives_to_expressions_are_no_facts(expression):
    found = turtle(f":Cat rdfs:subClassOf [ {expression} ] .")
    assert found.findings == [] and "% Facts" not in found.files["ontology.pl"]


@pytest.mark.parametrize(
    "text",
    [
        ":A rdfs:subClassOf _:x . _:x owl:complementOf _:x .",
        ":A rdfs:subClassOf _:x . _:x owl:complementOf _:y . _:y owl:unionOf ( :B _:x ) .",
    ],
)
def test_an_expression_that_contains_itself_is_told_and_the_rest_is_read(text):
    found = turtle(f"{text} :rex a :Dog .")
    assert "SubClassOf: an expression contains itself; nothing was made of it" in [f.message for f in found.findings]
    assert found.knowledge_base().ask("dog(rex)")


def test_an_expression_may_stand_at_two_places():
    found = turtle(":A rdfs:subClassOf _:x . :B rdfs:subClassOf _:x . _:x owl:intersectionOf ( :Dog _:y _:y ) . _:y owl:complementOf :Cat .")
    assert found.findings == []
