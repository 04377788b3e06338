"""Whatever a file holds: it becomes a text that can be read, with findings, or one sentence with a place."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from ontologies import functional, imported_text

from casper.kb.errors import CasperError, ReadError

ZOO = Path(__file__).parent / "zoo"
TEXTS = {file.suffix[1:]: file.read_text(encoding="utf-8") for file in ZOO.iterdir()}
PIECES = ["", " ", "x", '"', "(", ")", "<a>", "_:b", "&x;", ":Dog", "Object", "18", "@en", "^^", "\x00", "é"]


@st.composite
def damaged(draw):
    """A file of the zoo from which pieces are missing, and in which others stand."""
    suffix = draw(st.sampled_from(sorted(TEXTS)))
    text = TEXTS[suffix]
    for _ in range(draw(st.integers(1, 3))):
        at, length = draw(st.integers(0, len(text))), draw(st.sampled_from([0, 1, 5, 40, 400]))
        text = text[:at] + draw(st.sampled_from(PIECES)) + text[at + length :]
    return suffix, text


@st.composite
def with_lines_missing(draw):
    """A file of the zoo without some of its lines: often still of its syntax, but with axioms in pieces."""
    suffix = draw(st.sampled_from(sorted(TEXTS)))
    lines = TEXTS[suffix].splitlines(keepends=True)
    gone = draw(st.sets(st.integers(0, len(lines) - 1), min_size=1, max_size=6))
    return suffix, "".join(line for at, line in enumerate(lines) if at not in gone)


@given(st.one_of(damaged(), with_lines_missing()))
def test_a_damaged_file_is_told_or_imported(file):
    suffix, text = file
    try:
        imported = imported_text(text, suffix)
    except CasperError as mistake:
        assert mistake.sentence and "\n" not in str(mistake)
        return
    imported.knowledge_base()


def test_deep_nesting_is_refused():
    with pytest.raises(ReadError, match="nested too deeply"):
        imported_text(functional(f"SubClassOf(:A {'ObjectComplementOf(' * 20_000}:B{')' * 20_000})"), "ofn")


def test_a_file_that_ends_within_a_name_is_told_to_be_cut_short():
    with pytest.raises(ReadError, match=r":2: this cannot be read .*cut short"):
        imported_text('@prefix x: <http://z.org/> .\nx:a x:p "2"^^x:nonN', "ttl")


ENTITIES = '<!DOCTYPE x [<!ENTITY a "aaaaaaaaaa">' + "".join(
    f'<!ENTITY {chr(98 + n)} "{f"&{chr(97 + n)};" * 10}">' for n in range(9)
) + "]>"


@pytest.mark.parametrize(
    ("suffix", "text"),
    [
        ("owx", '<Ontology xmlns="http://www.w3.org/2002/07/owl#" ontologyIRI="http://z.org">&j;</Ontology>'),
        ("rdf", '<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#" xmlns:z="http://z.org/">'
                '<rdf:Description rdf:about="http://z.org/a"><z:p>&j;</z:p></rdf:Description></rdf:RDF>'),
    ],
)  # fmt: skip
@pytest.mark.parametrize("backwards", [False, True])
def test_entities_that_blow_up_are_refused(suffix, text, backwards):
    begin, *declared = ENTITIES.removesuffix("]>").split("<!ENTITY")
    inside = "<!ENTITY".join([begin, *(reversed(declared) if backwards else declared)])
    with pytest.raises(ReadError, match=r"the entity . stands for too much"):
        imported_text(f"{inside}]>{text}", suffix)


def test_entities_for_namespaces_are_understood():
    text = '''<?xml version="1.0"?><!DOCTYPE Ontology [<!ENTITY z "http://z.org/#">]>
    <Ontology xmlns="http://www.w3.org/2002/07/owl#" ontologyIRI="http://z.org">
    <SubClassOf><Class IRI="&z;Dog"/><Class IRI="&z;Animal"/></SubClassOf>
    <ClassAssertion><Class IRI="&z;Dog"/><NamedIndividual IRI="&z;rex"/></ClassAssertion></Ontology>'''
    assert imported_text(text, "owx").knowledge_base().ask("animal(rex)")
