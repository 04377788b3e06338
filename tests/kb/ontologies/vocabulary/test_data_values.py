"""Values of XML Schema's datatypes as terms, and the spellings that are none."""

import pytest
from ontologies import imported, imported_text, reasons, rows


def stated(value):
    return f"DataPropertyAssertion(:p :a {value})"


@pytest.mark.parametrize(
    ("value", "term"),
    [
        ('"1.5"^^xsd:decimal', "1.5"),
        ('" 1.5 "^^xsd:double', "1.5"),
        ('"-1E2"^^xsd:double', "-100.0"),
        ('"+.5"^^xsd:float', "0.5"),
        ('"Rex"', "'Rex'"),
        ('"Rex"^^xsd:token', "'Rex'"),
        ('"Rex"@EN', 'text("Rex", en)'),
        ('"1"^^xsd:boolean', 'boolean("true")'),
        ('"false"^^xsd:boolean', 'boolean("false")'),
        ('"2026-01-01T12:00:00"^^xsd:dateTime', 'dateTime("2026-01-01T12:00:00")'),
        ('"2026-01-01T12:00:00+02:00"^^xsd:dateTime', 'dateTime("2026-01-01T10:00:00+00:00")'),
        ('"2026-01-01"^^xsd:date', 'date("2026-01-01")'),
        ('"x17"^^:Chip', 'chip("x17")'),
    ],
)
def test_a_value_is_a_term(value, term):
    found = imported(stated(value))
    assert found.findings == []
    spelt = term.replace("dateTime", "date_time")
    assert found.knowledge_base().ask(f"p(a, {spelt})")


@pytest.mark.parametrize("spelt", ["", "1_0", "١", "1,5", "one", "1.5.1"])
@pytest.mark.parametrize("datatype", ["decimal", "double", "float"])
def test_what_is_spelt_otherwise_is_no_fraction(spelt, datatype):
    assert reasons(stated(f'"{spelt}"^^xsd:{datatype}'))[0].endswith(f"is no {datatype}; mend the value")


@pytest.mark.parametrize("spelt", ["INF", "-INF", "NaN"])
def test_infinities_are_refused(spelt):
    assert "INF and NaN are no numbers of the language" in reasons(stated(f'"{spelt}"^^xsd:double'))[0]


@pytest.mark.parametrize("spelt", ["1e999", "-1e999"])
def test_a_fraction_too_large_to_be_kept_is_refused(spelt):
    assert "the number is too large to be kept" in reasons(stated(f'"{spelt}"^^xsd:double'))[0]


def test_a_decimal_is_kept_exactly_or_refused_and_a_double_is_rounded():
    digits = "0.12345678901234567890123"
    assert "more digits than can be kept" in reasons(stated(f'"{digits}"^^xsd:decimal'))[0]
    kb = imported(stated(f'"{digits}"^^xsd:double')).knowledge_base()
    assert rows(kb, "p(a, X)") == [(float(digits),)]


@pytest.mark.parametrize(("datatype", "told"), [("double", True), ("byte", True), ("integer", False), ("decimal", False), ("string", False)])
def test_the_datatype_of_a_property_is_told_where_its_terms_do_not_show_it(datatype, told):
    names = imported(stated(f'"7"^^xsd:{datatype}')).files["names.pl"]
    assert (f"datatype(p, 'http://www.w3.org/2001/XMLSchema#{datatype}')." in names.splitlines()) is told
    assert ("datatype(" in names) is told


@pytest.mark.parametrize(
    ("suffix", "begin"),
    [
        ("ofn", ""), ("owl", ""), ("rdf", ""), ("owl", "\n  "), ("owl", "\ufeff"),
    ],
)  # fmt: skip
def test_functional_syntax_is_known_by_how_it_begins(suffix, begin):
    text = f"{begin}Prefix(:=<http://z.org/>) Ontology(ClassAssertion(:Dog :rex))"
    assert imported_text(text, suffix).knowledge_base().ask("dog(rex)")


@pytest.mark.parametrize(
    "text",
    [
        "<http://z.org/rex> a <http://z.org/Dog> .",
        "@prefix : <http://z.org/> . :rex a :Dog .",
        '<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#"><z:Dog xmlns:z="http://z.org/" rdf:about="http://z.org/rex"/></rdf:RDF>',
        '<z:Dog xmlns:z="http://z.org/" xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#" rdf:about="http://z.org/rex"/>',
        '<!-- dogs --><Ontology xmlns="http://www.w3.org/2002/07/owl#" ontologyIRI="http://z.org/"><ClassAssertion>'
        '<Class IRI="Dog"/><NamedIndividual IRI="rex"/></ClassAssertion></Ontology>',
    ],
)
def test_an_owl_file_is_known_by_how_it_begins(text):
    assert imported_text(text, "owl").knowledge_base().ask("dog(rex)")
