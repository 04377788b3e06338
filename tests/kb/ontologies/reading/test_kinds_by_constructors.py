"""In functional syntax the name of a constructor tells whether its property has values, with no declaration at all."""

import pytest
from ontologies import imported

V = "Variable(v:{})".format
DOUBTFUL = "{} relates individuals and values; make two properties of it".format


def of_class(concept):
    return f"SubClassOf({concept} :C)"


def in_rule(atom):
    return f"DLSafeRule(Body({atom}) Head(ClassAtom(:C {V('x')})))"


OF_VALUES = [
    of_class("DataSomeValuesFrom(:p :T)"),
    "SubClassOf(:C DataAllValuesFrom(:p :T))",
    of_class('DataHasValue(:p "x")'),
    of_class("DataMinCardinality(1 :p)"),
    "SubClassOf(:C DataMaxCardinality(1 :p))",
    "SubClassOf(:C DataExactCardinality(1 :p))",
    "SubDataPropertyOf(:p :q)",
    "SubDataPropertyOf(:q :p)",
    "EquivalentDataProperties(:q :p)",
    "DisjointDataProperties(:q :r :p)",
    "DataPropertyDomain(:p :C)",
    "DataPropertyRange(:p :T)",
    "FunctionalDataProperty(:p)",
    'DataPropertyAssertion(:p :a "x")',
    'NegativeDataPropertyAssertion(:p :a "x")',
    in_rule(f"DataPropertyAtom(:p {V('x')} {V('n')})"),
    "HasKey(:C () (:p))",
]
OF_INDIVIDUALS = [
    of_class("ObjectSomeValuesFrom(:p :D)"),
    "SubClassOf(:C ObjectAllValuesFrom(:p :D))",
    of_class("ObjectHasValue(:p :a)"),
    of_class("ObjectHasSelf(:p)"),
    of_class("ObjectMinCardinality(1 :p)"),
    "SubClassOf(:C ObjectMaxCardinality(1 :p))",
    "SubClassOf(:C ObjectExactCardinality(1 :p))",
    of_class("ObjectSomeValuesFrom(ObjectInverseOf(:p) :D)"),
    "SubObjectPropertyOf(ObjectPropertyChain(:q :p) :r)",
    "SubObjectPropertyOf(:q :p)",
    "EquivalentObjectProperties(:q :p)",
    "DisjointObjectProperties(:q :r :p)",
    "InverseObjectProperties(:q :p)",
    "ObjectPropertyDomain(:p :C)",
    "ObjectPropertyRange(:p :C)",
    *(
        f"{kind}ObjectProperty(:p)"
        for kind in ("Functional", "InverseFunctional", "Reflexive", "Irreflexive", "Symmetric", "Asymmetric", "Transitive")
    ),
    "ObjectPropertyAssertion(:p :a :b)",
    "NegativeObjectPropertyAssertion(:p :a :b)",
    in_rule(f"ObjectPropertyAtom(:p {V('x')} {V('y')})"),
    "HasKey(:C (:q :p) (:r))",
]


@pytest.mark.parametrize("axiom", OF_VALUES)
def test_a_property_of_a_data_constructor_has_values(axiom):
    found = imported(axiom)
    assert "data_property(p)." in found.files["names.pl"].splitlines()
    assert DOUBTFUL("p") not in [f.message for f in found.findings]


@pytest.mark.parametrize("axiom", OF_INDIVIDUALS)
def test_a_property_of_an_object_constructor_has_none(axiom):
    found = imported(axiom)
    assert "data_property(p)." not in found.files["names.pl"].splitlines()
    assert DOUBTFUL("p") not in [f.message for f in found.findings]


@pytest.mark.parametrize("axiom", OF_INDIVIDUALS)
def test_a_property_of_an_object_constructor_that_is_declared_to_have_values_is_doubtful(axiom):
    told = imported("Declaration(DataProperty(:p))", axiom).findings
    assert DOUBTFUL("p") in [f.message for f in told]


@pytest.mark.parametrize("axiom", OF_VALUES)
def test_a_property_of_a_data_constructor_that_is_declared_to_relate_individuals_is_doubtful(axiom):
    told = imported("Declaration(ObjectProperty(:p))", axiom).findings
    assert DOUBTFUL("p") in [f.message for f in told]


@pytest.mark.parametrize(
    "axiom",
    [
        "ObjectPropertyAssertion(:q :p :b)",
        "ObjectPropertyAssertion(:q :a :p)",
        "SubClassOf(:C ObjectAllValuesFrom(:q :p))",
        of_class("ObjectHasValue(:q :p)"),
        "ObjectPropertyDomain(:q :p)",
        "ObjectPropertyRange(:q :p)",
        "HasKey(:p (:q) ())",
    ],
)
def test_what_stands_beside_the_property_is_none(axiom):
    told = imported("Declaration(DataProperty(:p))", axiom).findings
    assert DOUBTFUL("p") not in [f.message for f in told]
