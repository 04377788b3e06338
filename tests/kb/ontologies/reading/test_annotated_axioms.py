"""Annotations attached to axioms: the axiom itself has to be stated besides."""

import pytest
from ontologies import imported_text

PREFIXES = """@prefix : <http://z.org/> . @prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
"""


def findings(text):
    return [f.message for f in imported_text(PREFIXES + text, "ttl").findings]


def attached(kind, source, target):
    return (
        f"[] a owl:{kind} ; owl:annotatedSource {source} ; owl:annotatedProperty rdfs:subClassOf ; "
        f'owl:annotatedTarget {target} ; rdfs:comment "as everyone knows" .'
    )


@pytest.mark.parametrize("kind", ["Axiom", "Annotation"])
def test_an_annotation_of_an_axiom_that_is_stated_means_nothing_more(kind):
    assert findings(":Dog rdfs:subClassOf :Animal . " + attached(kind, ":Dog", ":Animal")) == []


@pytest.mark.parametrize("target", [":Pet", ":Animal"])
def test_an_annotated_axiom_that_is_not_stated_is_told(target):
    other = ":Cat rdfs:subClassOf :Animal . :Dog rdfs:subClassOf :Furry . "
    assert findings(other + attached("Axiom", ":Dog", target)) == ["an annotated axiom is not stated itself; state it"]


def test_an_annotation_of_an_annotation_needs_no_axiom():
    assert findings(":Cat rdfs:subClassOf :Animal . " + attached("Annotation", ":Dog", ":Animal")) == []


def test_an_annotation_of_what_has_no_name_needs_none_either():
    assert findings(":Cat rdfs:subClassOf :Animal . " + attached("Axiom", "[ ]", ":Animal")) == []
