"""Each construct about properties, between individuals and with data values."""

import pytest
from ontologies import broken, imported, kb_of, reasons, rows

FACTS = (
    "ObjectPropertyAssertion(:knows :ann :bob)",
    "ObjectPropertyAssertion(:knows :bob :carl)",
    "ObjectPropertyAssertion(:likes :ann :ann)",
    'DataPropertyAssertion(:age :ann "19"^^xsd:integer)',
)


@pytest.mark.parametrize(
    ("axiom", "statement"),
    [
        ("SubObjectPropertyOf(:knows :meets)", "meets(ann, bob)"),
        ("SubObjectPropertyOf(ObjectInverseOf(:knows) :meets)", "meets(bob, ann)"),
        ("SubObjectPropertyOf(ObjectPropertyChain(:knows :knows) :hearsOf)", "hears_of(ann, carl)"),
        ("SubObjectPropertyOf(ObjectPropertyChain(:likes :knows :knows) :hearsOf)", "hears_of(ann, carl)"),
        ("SubObjectPropertyOf(ObjectPropertyChain(ObjectInverseOf(:knows) :likes) :hearsOf)", "hears_of(bob, ann)"),
        ("EquivalentObjectProperties(:knows :meets)", "meets(ann, bob)"),
        ("EquivalentObjectProperties(:meets :knows)", "meets(ann, bob)"),
        ("InverseObjectProperties(:knows :knownBy)", "known_by(bob, ann)"),
        ("InverseObjectProperties(:knownBy :knows)", "known_by(bob, ann)"),
        ("SymmetricObjectProperty(:knows)", "knows(bob, ann)"),
        ("TransitiveObjectProperty(:knows)", "knows(ann, carl)"),
        ("ReflexiveObjectProperty(:knows)", "knows(carl, carl)"),
        ("ObjectPropertyDomain(:knows :Person)", "person(ann)"),
        ("ObjectPropertyRange(:knows :Person)", "person(carl)"),
        ("ObjectPropertyRange(ObjectInverseOf(:knows) :Person)", "person(ann)"),
        ("ObjectPropertyDomain(:knows ObjectIntersectionOf(:Person :Social))", "social(ann)"),
        ("ObjectPropertyRange(:likes ObjectAllValuesFrom(:knows :Friend))", "friend(bob)"),
        ("SubDataPropertyOf(:age :number)", "number_2(ann, 19)"),
        ("EquivalentDataProperties(:age :years)", "years(ann, 19)"),
        ("DataPropertyDomain(:age :Person)", "person(ann)"),
        ('SubClassOf(DataHasValue(:age "19"^^xsd:integer) :Teen)', "teen(ann)"),
        ("SubClassOf(DataSomeValuesFrom(:age rdfs:Literal) :Dated)", "dated(ann)"),
        ("SubClassOf(DataMinCardinality(1 :age) :Dated)", "dated(ann)"),
        ('SubClassOf(DataSomeValuesFrom(:age DataOneOf("18"^^xsd:integer "19"^^xsd:integer)) :Teen)', "teen(ann)"),
        ('SubClassOf(:Person DataHasValue(:legs "2"^^xsd:integer))\nClassAssertion(:Person :ann)', "legs(ann, 2)"),
    ],
)
def test_what_follows_from_an_axiom_about_properties_is_known(axiom, statement):
    name, arity = statement.partition("(")[0], statement.count(",") + 1
    assert not kb_of(*FACTS).defines(name, arity) or not kb_of(*FACTS).ask(statement)
    kb = kb_of(*FACTS, axiom)
    assert kb.ask(statement)
    assert kb.why(statement).clause.place.citation


@pytest.mark.parametrize(
    ("axioms", "sentence"),
    [
        (("AsymmetricObjectProperty(:likes)",), "AsymmetricProperty(likes)"),
        (("IrreflexiveObjectProperty(:likes)",), "IrreflexiveProperty(likes)"),
        (("DisjointObjectProperties(:knows :likes)", "ObjectPropertyAssertion(:likes :ann :bob)"), "knows DisjointWith likes"),
        (("DisjointObjectProperties(:a :knows :likes)", "ObjectPropertyAssertion(:likes :ann :bob)"), "DisjointProperties(a, knows, likes)"),
        (("FunctionalDataProperty(:age)", 'DataPropertyAssertion(:age :ann "20"^^xsd:integer)'), "FunctionalProperty(age)"),
        (("SubClassOf(:P DataMaxCardinality(1 :age))", "ClassAssertion(:P :ann)", 'DataPropertyAssertion(:age :ann "1"^^xsd:integer)'), "P SubClassOf age max 1"),
        (("SubClassOf(:P DataMaxCardinality(0 :age))", "ClassAssertion(:P :ann)"), "P SubClassOf age max 0"),
        (("DisjointDataProperties(:age :size)", 'DataPropertyAssertion(:size :ann "19"^^xsd:integer)'), "age DisjointWith size"),
        (('NegativeDataPropertyAssertion(:age :ann "19"^^xsd:integer)',), "not age(ann, 19)"),
        (('DataPropertyRange(:age DatatypeRestriction(xsd:integer xsd:minInclusive "0"^^xsd:integer))', 'DataPropertyAssertion(:age :bob "-1"^^xsd:integer)'), "age Range integer[>= 0]"),
        (('DataPropertyRange(:age DataOneOf("19"^^xsd:integer "20"^^xsd:integer))', 'DataPropertyAssertion(:age :bob "21"^^xsd:integer)'), "age Range {19, 20}"),
        (("DataPropertyRange(:age DataUnionOf(DataOneOf(\"19\"^^xsd:integer) DatatypeRestriction(xsd:integer xsd:maxExclusive \"3\"^^xsd:integer)))", 'DataPropertyAssertion(:age :bob "4"^^xsd:integer)'), "age Range {19} or integer[< 3]"),
        (('SubClassOf(:P DataAllValuesFrom(:age DatatypeRestriction(xsd:integer xsd:maxInclusive "18"^^xsd:integer)))', "ClassAssertion(:P :ann)"), "P SubClassOf age only integer[<= 18]"),
    ],
)
def test_axioms_about_properties_that_clash_with_the_facts_are_named(axioms, sentence):
    assert broken(kb_of(*FACTS, *axioms[:-1])) == [] or len(axioms) == 1
    assert broken(kb_of(*FACTS, *axioms)) == [sentence]


def test_a_functional_property_makes_its_values_one():
    kb = kb_of("FunctionalObjectProperty(:mother)", *(f"ObjectPropertyAssertion(:mother :ann :{x})" for x in ("eve", "eva")))
    assert rows(kb, "same(X, Y)") == [("eva", "eve"), ("eve", "eva")]
    assert "FunctionalProperty(mother)" in str(kb.why("same(eva, eve)"))


def test_an_inverse_functional_property_makes_its_bearers_one():
    kb = kb_of("InverseFunctionalObjectProperty(:wears)", *(f"ObjectPropertyAssertion(:wears :{x} :ring)" for x in ("ann", "anna")))
    assert kb.ask("same(ann, anna)")


def test_equal_numbers_are_one_value_however_they_are_spelt():
    kb = kb_of("FunctionalDataProperty(:age)", 'DataPropertyAssertion(:age :ann "19"^^xsd:integer)', 'DataPropertyAssertion(:age :ann "19.0"^^xsd:decimal)')
    assert broken(kb) == []


def test_values_of_different_datatypes_are_never_one():
    kb = kb_of("FunctionalDataProperty(:p)", 'DataPropertyAssertion(:p :a "2026-01-01")', 'DataPropertyAssertion(:p :a "2026-01-01"^^xsd:date)')
    assert broken(kb) == ["FunctionalProperty(p)"]


def test_one_point_in_time_is_one_value_in_every_time_zone():
    kb = kb_of("FunctionalDataProperty(:p)", 'DataPropertyAssertion(:p :a "2026-01-01T12:00:00Z"^^xsd:dateTime)', 'DataPropertyAssertion(:p :a "2026-01-01T13:00:00+01:00"^^xsd:dateTime)')
    assert broken(kb) == []


def test_numbers_in_a_range_are_told_by_its_facets():
    kb = kb_of(
        'SubClassOf(DataSomeValuesFrom(:age DatatypeRestriction(xsd:integer xsd:minInclusive "18"^^xsd:integer xsd:maxExclusive "65"^^xsd:integer)) :Adult)',
        *(f'DataPropertyAssertion(:age :p{age} "{age}"^^xsd:integer)' for age in (17, 18, 64, 65)),
    )
    assert rows(kb, "adult(X)") == [("p18",), ("p64",)]


def test_a_named_range_is_what_it_is_defined_as():
    kb = kb_of(
        "Declaration(Datatype(:Grown))",
        'DatatypeDefinition(:Grown DatatypeRestriction(xsd:decimal xsd:minInclusive "18"^^xsd:integer))',
        "SubClassOf(DataSomeValuesFrom(:age :Grown) :Adult)",
        *FACTS,
    )
    assert rows(kb, "adult(X)") == [("ann",)]


def test_a_named_range_that_is_defined_by_itself_is_refused():
    (told,) = reasons("DatatypeDefinition(:G :G)", "Declaration(Datatype(:G))", "SubClassOf(DataSomeValuesFrom(:age :G) :Adult)")
    assert "defined by itself" in told


@pytest.mark.parametrize(
    ("value", "told"),
    [
        ('"abc"^^xsd:integer', "is no integer"),
        ('"1.5"^^xsd:integer', "is no integer"),
        ('"-1"^^xsd:nonNegativeInteger', "is no nonNegativeInteger"),
        ('"300"^^xsd:byte', "is no byte"),
        ('"maybe"^^xsd:boolean', "is no boolean"),
        ('"yesterday"^^xsd:dateTime', "is no dateTime"),
        ('"INF"^^xsd:double', "no numbers of the language"),
        ('"0.12345678901234567890123"^^xsd:decimal', "more digits than can be kept"),
    ],
)
def test_a_value_that_cannot_be_kept_is_told_and_left_out(value, told):
    found = imported(f"DataPropertyAssertion(:p :a {value})", 'DataPropertyAssertion(:p :b "1"^^xsd:integer)')
    (finding,) = found.findings
    assert told in finding.message and finding.place.line == 8
    assert rows(found.knowledge_base(), "p(X, V)") == [("b", 1)]


@pytest.mark.parametrize(
    ("axiom", "told"),
    [
        ("SymmetricObjectProperty(:age)", "has data values"),
        ("DataPropertyRange(:age xsd:string)", "the ontology contradicts itself; mend the value"),
        ('SubClassOf(DataSomeValuesFrom(:age DatatypeRestriction(xsd:string xsd:pattern "a*")) :A)', "no counterpart in the language"),
        ("SubClassOf(:A DataSomeValuesFrom(:age xsd:integer))", "no rule can name"),
    ],
)
def test_what_is_no_axiom_about_such_a_property_is_told(axiom, told):
    found = reasons("Declaration(DataProperty(:age))", 'DataPropertyAssertion(:age :ann "19"^^xsd:integer)', axiom)
    assert [sentence for sentence in found if told in sentence]


def test_in_triples_the_values_tell_which_property_has_data():
    from ontologies import imported_text

    text = "@prefix : <http://z.org/> . @prefix owl: <http://www.w3.org/2002/07/owl#> . :a :p 1, 2 ; :q :b, :c . :p a owl:FunctionalProperty . :q a owl:FunctionalProperty ."
    kb = imported_text(text, "ttl").knowledge_base()
    assert broken(kb) == ["FunctionalProperty(p)"]
    assert kb.ask("same(b, c)")
