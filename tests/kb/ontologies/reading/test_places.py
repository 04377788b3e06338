"""Where a mistake stands: line and column in the syntaxes that have them."""

import pytest
from ontologies import imported, imported_text

from casper.kb.errors import ReadError


def place_of_mistake(text, suffix):
    with pytest.raises(ReadError) as told:
        imported_text(text, suffix)
    return told.value.place.line, told.value.place.column


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("Ontology(SubClassOf(z:Dog z:Animal))", (1, 21)),
        ("Ontology(\nSubClassOf(z:Dog z:Animal))", (2, 12)),
        ("Ontology(\n\n  SubClassOf(\n    z:Dog z:Animal))", (4, 5)),
        ("Ontology(<http://z.org> # z:Dog\n  Declaration(Class(z:Dog)))", (2, 21)),
    ],
)
def test_a_prefix_nobody_declares_is_told_with_its_line_and_column(text, place):
    assert place_of_mistake(text, "ofn") == place


def test_what_does_not_belong_into_functional_syntax_is_told_with_its_line_and_column():
    assert place_of_mistake("Ontology(\n  SubClassOf(owl:Thing = owl:Thing) !\n)\n", "ofn") == (2, 37)


@pytest.mark.parametrize(
    ("inside", "place"),
    [
        ('<ClassAssertion><Class abbreviatedIRI="z:Dog"/></ClassAssertion>', (2, 17)),
        ('<SubClassOf>\n <ObjectMinCardinality cardinality="-1"/></SubClassOf>', (3, 2)),
        ("<x:Dog xmlns:x='urn:x'/>", (2, 1)),
        ("<Class IRI='#Dog'/></Klass>\n<Class/>", (2, 22)),
    ],
)
def test_a_mistake_in_owl_xml_is_told_with_its_line_and_column(inside, place):
    text = f'<Ontology xmlns="http://www.w3.org/2002/07/owl#" ontologyIRI="http://z.org">\n{inside}\n</Ontology>\n'
    assert place_of_mistake(text, "owx") == place


def test_an_axiom_that_no_rule_can_say_is_told_with_its_line():
    axioms = ("SubClassOf(:Dog :Animal)", "SubClassOf(:Dog ObjectMinCardinality(2 :has))", "SubClassOf(:Cat :Animal)")
    assert [f.place.line for f in imported(*axioms).findings] == [9]
