"""An axiom that lacks arguments, anywhere inside, is told and never half understood."""

from pathlib import Path

import pytest
from ontologies import imported, reasons

from casper.kb.ontologies.expressions import Axiom, Expression, Kind, Ontology
from casper.kb.ontologies.meaning.translation import translate
from casper.kb.ontologies.reading.source import read_ontology

ZOO = Path(__file__).parents[1] / "zoo" / "zoo.ofn"
AXIOMS = sorted({axiom.expression for axiom in read_ontology(ZOO).axioms}, key=repr)


def without_one(expression):
    """The expression with one argument less, here or further inside, in every way."""
    for at, arg in enumerate(expression.args):
        before, after = expression.args[:at], expression.args[at + 1 :]
        yield Expression(expression.name, before + after)
        for less in without_one(arg) if isinstance(arg, Expression) else ():
            yield Expression(expression.name, (*before, less, *after))


def test_the_axioms_of_the_zoo_without_any_of_their_arguments_are_translated_or_told():
    for broken in (less for expression in AXIOMS for less in without_one(expression)):
        ontology = Ontology(axioms=[Axiom(broken)], kinds={"http://z.org/A": {Kind.CLASS}})
        found = translate(ontology)
        assert all(sentence for _, sentence in found.refusals)


@pytest.mark.parametrize(
    ("expression", "told"),
    [
        ("ObjectMinCardinality(1)", "MinCardinality(1)"),
        ("ObjectMaxCardinality(1)", "MaxCardinality(1)"),
        ("ObjectExactCardinality(1)", "ExactCardinality(1)"),
        ("ObjectMaxCardinality()", "MaxCardinality()"),
        ("ObjectSomeValuesFrom(:p)", "SomeValuesFrom(p)"),
        ("ObjectAllValuesFrom(:p)", "AllValuesFrom(p)"),
        ("ObjectHasValue(:p)", "HasValue(p)"),
        ("ObjectHasSelf()", "HasSelf()"),
        ("ObjectComplementOf()", "ComplementOf()"),
        ("ObjectSomeValuesFrom(ObjectInverseOf() :B)", "InverseOf()"),
        ("DataAllValuesFrom(:age DatatypeRestriction(xsd:integer))", "integer[]"),
        ("DataAllValuesFrom(:age DatatypeRestriction(xsd:integer xsd:minInclusive))", "FacetRestriction(minInclusive)"),
        ('DataAllValuesFrom(:age DatatypeRestriction(xsd:integer xsd:minInclusive "1"^^xsd:integer xsd:maxInclusive))',
         "FacetRestriction(maxInclusive)"),
    ],
)  # fmt: skip
@pytest.mark.parametrize("axiom", ["SubClassOf(:A {})", "SubClassOf({} :A)"])
def test_a_constructor_with_too_few_arguments_is_named(axiom, expression, told):
    assert [reason.partition(": ")[2] for reason in reasons(axiom.format(expression))] == [
        f"{told} has too few arguments; mend the axiom"
    ]


@pytest.mark.parametrize("name", ["ObjectPropertyChain", "ObjectInverseOf"])
def test_a_property_expression_with_too_few_arguments_is_named(name):
    assert reasons(f"SubObjectPropertyOf({name}() :q)")[0].endswith(f"{name.removeprefix('Object')}() has too few arguments; mend the axiom")


def test_a_chain_of_one_property_is_that_property():
    found = imported("SubObjectPropertyOf(ObjectPropertyChain(:p) :q)", "ObjectPropertyAssertion(:p :a :b)")
    assert found.findings == [] and found.knowledge_base().ask("q(a, b)")


def test_what_is_told_stays_told_beside_what_is_understood():
    found = imported("SubClassOf(:A ObjectMinCardinality(1))", "SubClassOf(:A :B)", "ClassAssertion(:A :rex)")
    assert len(found.findings) == 1 and found.knowledge_base().ask("b(rex)")


def test_the_place_of_the_axiom_is_told():
    assert imported("SubClassOf(:A :B)", "SubClassOf(:A ObjectHasSelf())").findings[0].place.line == 9


