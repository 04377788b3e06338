"""Data ranges by what is outside of them, and at-least-one as a condition."""

import pytest
from ontologies import imported, kb_of, reasons, rows

AGES = tuple(f'DataPropertyAssertion(:age :p{age} "{age}"^^xsd:decimal)' for age in (3, 17, 18))
SEVENTEEN = 'DataOneOf("17"^^xsd:decimal)'
GROWN = 'DatatypeRestriction(xsd:decimal xsd:minInclusive "18"^^xsd:decimal)'


def who(range_):
    """Those with an age in the range."""
    return [x for (x,) in rows(kb_of(*AGES, f"SubClassOf(DataSomeValuesFrom(:age {range_}) :Found)"), "found(X)")]


@pytest.mark.parametrize(
    ("range_", "found"),
    [
        (f"DataComplementOf({SEVENTEEN})", ["p18", "p3"]),
        (f"DataComplementOf({GROWN})", ["p17", "p3"]),
        (f"DataComplementOf(DataComplementOf({GROWN}))", ["p18"]),
        (f"DataComplementOf(DataUnionOf({SEVENTEEN} {GROWN}))", ["p3"]),
        (f"DataComplementOf(DataIntersectionOf(xsd:decimal {GROWN}))", ["p17", "p3"]),
        (f"DataIntersectionOf(xsd:decimal DataComplementOf({SEVENTEEN}))", ["p18", "p3"]),
        ("DataComplementOf(xsd:decimal)", []),
        ("DataComplementOf(rdfs:Literal)", []),
    ],
)
def test_a_value_is_in_a_complement_when_it_is_outside_of_the_range(range_, found):
    assert who(range_) == found


MIXED = tuple(f'DataPropertyAssertion(:note :{x} "{value}"{kind})' for x, value, kind in (
    ("a", "dog", ""), ("b", "7", "^^xsd:integer"), ("c", "7.5", "^^xsd:decimal"), ("d", "-1", "^^xsd:integer")
))  # fmt: skip


@pytest.mark.parametrize(
    ("range_", "found"),
    [
        ("xsd:string", ["a"]),
        ("xsd:integer", ["b", "d"]),
        ("xsd:decimal", ["b", "c", "d"]),
        ("xsd:nonNegativeInteger", ["b"]),
        ("DataComplementOf(xsd:string)", ["b", "c", "d"]),
        ("DataComplementOf(xsd:integer)", ["a", "c"]),
        ("DataComplementOf(xsd:decimal)", ["a"]),
        ('DatatypeRestriction(xsd:integer xsd:minInclusive "0"^^xsd:integer)', ["b"]),
    ],
)
def test_values_of_every_kind_are_told_apart_without_a_doubt(range_, found):
    base = kb_of(*MIXED, f"SubClassOf(DataSomeValuesFrom(:note {range_}) :Found)")
    assert [x for (x,) in rows(base, "found(X)")] == found
    assert [base.truth(f"found({x})") for x in "abcd"] == ["true" if x in found else "false" for x in "abcd"]


@pytest.mark.parametrize("datatype", ["date"])
def test_a_complement_that_the_language_has_no_test_for_is_refused(datatype):
    axiom = f"SubClassOf(DataSomeValuesFrom(:age DataComplementOf(xsd:{datatype})) :Found)"
    assert reasons(axiom) == [f"age some (not {datatype}) SubClassOf Found: the language cannot tell what is no {datatype}"]


PETS = ("ObjectPropertyAssertion(:has :ann :rex)", "ClassAssertion(:Dog :rex)", "ObjectPropertyAssertion(:has :bob :tom)")


def owners(concept):
    return [x for (x,) in rows(kb_of(*PETS, f"SubClassOf({concept} :Owner)"), "owner(X)")]


def test_at_least_one_of_a_class_needs_one_that_is_known_to_be_of_it():
    assert owners("ObjectMinCardinality(1 :has :Dog)") == ["ann"]


def test_at_least_one_without_a_class_is_anything():
    assert owners("ObjectMinCardinality(1 :has)") == ["ann", "bob"]


@pytest.mark.parametrize("concept", ["ObjectMinCardinality(0 :has :Dog)", "ObjectMinCardinality(0 :has)"])
def test_at_least_none_holds_of_everything(concept):
    assert owners(concept) == ["ann", "bob", "rex", "tom"]


@pytest.mark.parametrize(
    ("name", "condition"),
    [
        ("contains", "sub_atom(N, _, _, _, day)"),
        ("startsWith", "sub_atom(N, 0, _, _, day)"),
        ("endsWith", "sub_atom(N, _, _, 0, day)"),
        ("upperCase", "upcase_atom(day, N)"),
        ("lowerCase", "downcase_atom(day, N)"),
        ("stringLength", "atom_length(day, N)"),
        ("stringEqualIgnoreCase", "downcase_atom(N, Z), downcase_atom(day, Z)"),
    ],
)
def test_a_built_in_of_strings_is_spelt_as_in_prolog(name, condition):
    atom = f'BuiltInAtom(swrlb:{name} Variable(v:n) "day")'
    found = imported(f"DLSafeRule(Body(DataPropertyAtom(:name Variable(v:x) Variable(v:n)) {atom}) Head(ClassAtom(:C Variable(v:x))))")
    (rule,) = [line for line in found.files["ontology.pl"].splitlines() if line.startswith("c(")]
    assert rule.partition("  %:")[0] == f"c(X) :- name(X, N), {condition}."
