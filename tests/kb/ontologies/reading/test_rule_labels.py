"""A rule is called as its author labels it, and else by what it says."""

import pytest
from ontologies import imported, imported_text

PREFIXES = """@prefix : <http://z.org/> . @prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix swrl: <http://www.w3.org/2003/11/swrl#> . @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
:x a swrl:Variable . :rex a :Dog .
"""
ATOMS = """swrl:body ( [ a swrl:ClassAtom ; swrl:classPredicate :Dog ; swrl:argument1 :x ] ) ;
swrl:head ( [ a swrl:ClassAtom ; swrl:classPredicate :Pet ; swrl:argument1 :x ] ) ."""


def cites(found):
    return found.knowledge_base().why("pet(rex)").to_json()["cites"]


@pytest.mark.parametrize(
    ("rule", "label"),
    [
        ("[] a swrl:Imp ; ", ""),
        ('[] a swrl:Imp ; rdfs:label "dogs are pets" ; ', "dogs are pets: "),
        ('[] a swrl:Imp ; rdfs:label "one", "two" ; ', "one: "),
        ('[] a swrl:Imp ; rdfs:comment "a comment" ; ', ""),
        (':author a owl:AnnotationProperty . [] a swrl:Imp ; :author "eve" ; owl:versionInfo "2" ; ', ""),
        (
            '[] a owl:Axiom ; owl:annotatedSource :r ; owl:annotatedProperty <http://www.w3.org/1999/02/22-rdf-syntax-ns#type> ; '
            'owl:annotatedTarget swrl:Imp ; rdfs:label "annotated" . :r a swrl:Imp ; ',
            "annotated: ",
        ),
    ],
)
def test_a_rule_in_triples_is_called_by_its_first_label(rule, label):
    found = imported_text(PREFIXES + rule + ATOMS, "ttl")
    assert found.findings == [] and cites(found) == f"{label}Dog(?x) -> Pet(?x)"


@pytest.mark.parametrize(
    ("annotation", "label"),
    [
        ("", ""),
        ('Annotation(rdfs:label "dogs are pets")', "dogs are pets: "),
        ('Annotation(rdfs:label "one") Annotation(rdfs:label "two")', "one: "),
        ('Annotation(rdfs:comment "a comment") Annotation(AnnotationProperty(rdfs:label) "named")', "named: "),
        ("Annotation(rdfs:label :rex)", ""),
    ],
)
def test_a_rule_in_functional_syntax_is_called_by_its_first_label(annotation, label):
    rule = f"DLSafeRule({annotation} Body(ClassAtom(:Dog Variable(v:x))) Head(ClassAtom(:Pet Variable(v:x))))"
    assert cites(imported("ClassAssertion(:Dog :rex)", rule)) == f"{label}Dog(?x) -> Pet(?x)"


def test_a_rule_that_makes_no_sense_is_told_by_its_label():
    text = PREFIXES + '[] a swrl:Imp ; rdfs:label "odd" ; swrl:body () .'
    assert [f.message for f in imported_text(text, "ttl").findings if "odd" in f.message] == [
        "odd: its head is not there; mend the rule; nothing was made of it"
    ]
