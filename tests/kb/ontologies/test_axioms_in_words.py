"""How an axiom is cited: in words near to Manchester syntax."""

import pytest
from ontologies import functional, imported

from casper.kb.ontologies.citing import cited, local_name
from casper.kb.ontologies.reading.canonical import ontology_of
from casper.kb.ontologies.reading.functional import read_functional


def words(axiom):
    (found,) = ontology_of(read_functional(functional(axiom), "zoo.ofn")).axioms
    return cited(found.expression)


@pytest.mark.parametrize(
    ("axiom", "told"),
    [
        ("SubClassOf(:Dog :Animal)", "Dog SubClassOf Animal"),
        ("EquivalentClasses(:Dog :Hound)", "Dog EquivalentTo Hound"),
        ("DisjointClasses(:Dog :Cat)", "Dog DisjointWith Cat"),
        ("DisjointClasses(:Dog :Cat :Cow)", "DisjointClasses(Dog, Cat, Cow)"),
        ("DisjointUnion(:Pet :Dog :Cat)", "Pet DisjointUnionOf Dog, Cat"),
        ("HasKey(:Dog (:owner) (:chip))", "Dog HasKey owner, chip"),
        ("ClassAssertion(:Dog :rex)", "rex Type Dog"),
        ("ObjectPropertyAssertion(:has :ann :rex)", "has(ann, rex)"),
        ("NegativeObjectPropertyAssertion(:has :ann :rex)", "not has(ann, rex)"),
        ("ObjectPropertyAssertion(ObjectInverseOf(:has) :rex _:b)", "inverse(has)(rex, _:b)"),
        ("SameIndividual(:rex :fido)", "rex SameAs fido"),
        ("DifferentIndividuals(:rex :tom)", "rex DifferentFrom tom"),
        ("SubObjectPropertyOf(ObjectPropertyChain(:has :eats) :feeds)", "has o eats SubPropertyOf feeds"),
        ("InverseObjectProperties(:has :owner)", "has InverseOf owner"),
        ("ObjectPropertyDomain(:has :Person)", "has Domain Person"),
        ("SymmetricObjectProperty(:near)", "SymmetricProperty(near)"),
        ("SubClassOf(:A ObjectSomeValuesFrom(:has :Dog))", "A SubClassOf has some Dog"),
        ("SubClassOf(:A ObjectAllValuesFrom(:has ObjectUnionOf(:Dog :Cat)))", "A SubClassOf has only (Dog or Cat)"),
        ("SubClassOf(:A ObjectHasValue(:has :rex))", "A SubClassOf has value rex"),
        ("SubClassOf(:A ObjectHasSelf(:likes))", "A SubClassOf likes Self"),
        ("SubClassOf(:A ObjectMinCardinality(2 :has))", "A SubClassOf has min 2"),
        ("SubClassOf(:A ObjectMaxCardinality(2 :has :Dog))", "A SubClassOf has max 2 Dog"),
        ("SubClassOf(:A ObjectExactCardinality(2 :has ObjectComplementOf(:Dog)))", "A SubClassOf has exactly 2 (not Dog)"),
        ("SubClassOf(:A ObjectOneOf(:rex :tom))", "A SubClassOf {rex, tom}"),
        ('SubClassOf(:A DataHasValue(:age "3"^^xsd:integer))', "A SubClassOf age value 3"),
        ('SubClassOf(:A DataHasValue(:name "Rex"))', 'A SubClassOf name value "Rex"'),
        ('SubClassOf(:A DataHasValue(:name "Rex"@EN))', 'A SubClassOf name value "Rex"@en'),
        ('SubClassOf(:A DataHasValue(:born "2026"^^xsd:gYear))', 'A SubClassOf born value "2026"^^gYear'),
        (
            'DataPropertyRange(:age DatatypeRestriction(xsd:integer xsd:minInclusive "0"^^xsd:integer xsd:maxExclusive "9"^^xsd:integer))',
            "age Range integer[>= 0, < 9]",
        ),
        ("DLSafeRule(Body(ClassAtom(:Dog Variable(v:x))) Head())", "Dog(?x) -> nothing"),
    ],
)
def test_an_axiom_is_cited_in_words(axiom, told):
    assert words(axiom) == told


@pytest.mark.parametrize(
    ("iri", "name"),
    [("http://z.org/zoo#Dog", "Dog"), ("http://z.org/Dog/", "Dog"), ("urn:zoo:Dog", "Dog"), ("Dog", "Dog"), ("#/:", "#/:")],
)
def test_a_local_name_is_what_stands_last_in_an_iri(iri, name):
    assert local_name(iri) == name


@pytest.mark.parametrize(
    ("axiom", "told"),
    [
        ("SubClassOf(:Dog)", "SubClassOf has too few arguments; mend the axiom"),
        ("FunctionalObjectProperty()", "FunctionalObjectProperty has too few arguments; mend the axiom"),
        ("ObjectUnionOf(:Dog :Cat)", "ObjectUnionOf is no axiom of OWL 2; nothing was made of it"),
        ("Barks(:Dog)", "Barks is no axiom of OWL 2; nothing was made of it"),
    ],
)
def test_what_is_no_whole_axiom_is_told_with_its_line_and_the_rest_is_read(axiom, told):
    found = imported("ClassAssertion(:Dog :rex)", axiom, "ClassAssertion(:Dog :fido)")
    assert [(f.place.line, f.message) for f in found.findings] == [(9, told)]
    assert found.knowledge_base().ask("dog(fido)")


@pytest.mark.parametrize("count", [3, 4, 5])
def test_three_properties_without_end_are_named_and_the_others_counted(count, tmp_path):
    names = [f"p{number}" for number in range(count)]
    facts = [f'DataPropertyAssertion(:{name} :ann "1"^^xsd:integer)' for name in names]
    more = 'BuiltInAtom(swrlb:add Variable(v:m) Variable(v:n) "1"^^xsd:integer)'
    rules = [
        f"DLSafeRule(Body(DataPropertyAtom(:{name} Variable(v:x) Variable(v:n)) {more}) Head(DataPropertyAtom(:{name} Variable(v:x) Variable(v:m))))"
        for name in names
    ]
    (told,) = imported(*facts, *rules).write(tmp_path)
    others = f" and {count - 3} more" if count > 3 else ""
    assert told.message.startswith(f"p0/2, p1/2, p2/2{others}: a rule computes what it needs itself")


def test_a_range_in_which_a_condition_is_stated_already_needs_no_test():
    stated = 'DataPropertyRange(:age DatatypeRestriction(xsd:integer xsd:minInclusive "0"^^xsd:integer))'
    asked = "SubClassOf(DataSomeValuesFrom(:age xsd:integer) :Aged)"
    assert "aged(X) :- age(X, _)." in imported(stated, asked).files["ontology.pl"]
    assert "aged(X) :- age(X, Y), integer(Y)." in imported(asked).files["ontology.pl"]
