"""OWL/XML: which IRI a spelling stands for, and how much an entity may abbreviate."""

import pytest
from ontologies import imported_text, rows

from casper.kb.errors import ReadError

OWX = '<Ontology xmlns="http://www.w3.org/2002/07/owl#" {}>{}</Ontology>'
IS_DOG = '<ClassAssertion><Class IRI="urn:Dog"/><NamedIndividual IRI="{}"{}/></ClassAssertion>'


def the_dog(header, iri, attributes=""):
    """The IRI of the only dog."""
    kb = imported_text(OWX.format(header, IS_DOG.format(iri, attributes)), "owx").knowledge_base()
    ((found,),) = [row[1:] for row in rows(kb, "dog(X), iri(X, I)")]
    return found


@pytest.mark.parametrize(
    ("spelt", "full"),
    [
        ("#rex", "http://z.org/zoo#rex"),
        ("rex", "http://z.org/rex"),
        ("pets/a:rex", "http://z.org/pets/a:rex"),
        ("http://other.org/rex", "http://other.org/rex"),
        ("http://other.org/rex#", "http://other.org/rex#"),
        ("urn:zoo:rex", "urn:zoo:rex"),
    ],
)
def test_a_reference_is_relative_to_the_ontology_and_a_full_iri_stays_as_it_is(spelt, full):
    assert the_dog('ontologyIRI="http://z.org/zoo"', spelt) == full


def test_an_xml_base_counts_more_than_the_name_of_the_ontology():
    assert the_dog('ontologyIRI="http://z.org/zoo" xml:base="http://base.org/pets"', "#rex") == "http://base.org/pets#rex"


def test_an_inner_xml_base_counts_more_than_an_outer_one():
    inner = ' xml:base="http://inner.org/pets"'
    assert the_dog('ontologyIRI="http://z.org/zoo" xml:base="http://base.org/"', "#rex", inner) == "http://inner.org/pets#rex"


def test_the_fragment_of_a_base_is_none_of_its_references():
    assert the_dog('ontologyIRI="http://z.org/zoo#"', "#rex") == "http://z.org/zoo#rex"


def with_entity(value):
    """An ontology whose only individual is called by an entity that is declared in line 3."""
    declared = f'<?xml version="1.0"?>\n<!DOCTYPE Ontology [\n<!ENTITY z "{value}">\n]>\n'
    return declared + OWX.format('ontologyIRI="http://z.org"', IS_DOG.format("&z;rex", ""))


def long_name(length):
    return "urn:" + "x" * (length - 4)


def test_an_entity_of_4096_characters_is_understood():
    value = long_name(4096)
    kb = imported_text(with_entity(value), "owx").knowledge_base()
    assert [iri for _, iri in rows(kb, "dog(X), iri(X, I)")] == [f"{value}rex"]


@pytest.mark.parametrize("value", [long_name(4097), "&z;", "&later;", long_name(4091) + "&amp;"])
def test_an_entity_that_stands_for_more_is_refused_with_the_line_of_its_declaration(value):
    with pytest.raises(ReadError, match="the entity z stands for too much") as told:
        imported_text(with_entity(value), "owx")
    assert told.value.place.line == 3


def test_what_xml_itself_abbreviates_counts_as_one_character_more():
    imported_text(with_entity(long_name(4090) + "&amp;"), "owx")
