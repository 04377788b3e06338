"""Conditions on constants are decided while importing: what is no number is in no range of numbers."""

import pytest
from ontologies import broken, imported, kb_of, reasons, rows

TEEN = 'DatatypeRestriction(xsd:decimal xsd:minInclusive "13"^^xsd:decimal)'
MIXED = 'DataOneOf("old" "13"^^xsd:decimal "7"^^xsd:decimal)'
AGES = (
    'DataPropertyAssertion(:age :ann "13"^^xsd:decimal)',
    'DataPropertyAssertion(:age :bob "7"^^xsd:decimal)',
)
OLD = 'DataPropertyAssertion(:age :eve "old")'
PERSON = "ClassAtom(:Person Variable(v:x))"


def rule(atom, head="ClassAtom(:Found Variable(v:x))"):
    return f"DLSafeRule(Body({PERSON} {atom}) Head({head}))"


@pytest.mark.parametrize(
    ("range_", "found"),
    [
        (f"DataIntersectionOf({MIXED} xsd:decimal)", ["ann", "bob"]),
        (f"DataIntersectionOf(xsd:decimal {MIXED})", ["ann", "bob"]),
        (f"DataIntersectionOf({MIXED} {TEEN})", ["ann"]),
        (f"DataIntersectionOf({MIXED} DataComplementOf(xsd:decimal))", ["eve"]),
        (f"DataIntersectionOf({MIXED} DataComplementOf({TEEN}))", ["bob", "eve"]),
    ],
)
def test_of_some_values_those_that_are_in_a_range_of_numbers(range_, found):
    kb = kb_of(*AGES, OLD, f"SubClassOf(DataSomeValuesFrom(:age {range_}) :Found)")
    assert [x for (x,) in rows(kb, "found(X)")] == found


@pytest.mark.parametrize(
    ("atom", "found"),
    [
        ('DataRangeAtom(xsd:decimal "old")', []),
        ('DataRangeAtom(xsd:decimal "7"^^xsd:decimal)', [("ann",)]),
        ('DataRangeAtom(DataComplementOf(xsd:decimal) "old")', [("ann",)]),
        (f'DataRangeAtom({TEEN} "7"^^xsd:decimal)', []),
        ('BuiltInAtom(swrlb:add "3"^^xsd:integer "1"^^xsd:integer "2"^^xsd:integer)', [("ann",)]),
        ('BuiltInAtom(swrlb:add "4"^^xsd:integer "1"^^xsd:integer "2"^^xsd:integer)', []),
        ('BuiltInAtom(swrlb:lessThan "1"^^xsd:integer "3"^^xsd:integer)', [("ann",)]),
        ('BuiltInAtom(swrlb:lessThan "3"^^xsd:integer "1"^^xsd:integer)', []),
    ],
)
def test_a_condition_on_constants_holds_of_all_or_of_none(atom, found):
    kb = kb_of("ClassAssertion(:Person :ann)", "Declaration(Class(:Found))", rule(atom))
    assert rows(kb, "found(X)") == found


def test_a_constant_outside_of_the_range_in_a_conclusion_is_a_broken_constraint():
    told = broken(kb_of("ClassAssertion(:Person :ann)", rule("", 'DataRangeAtom(xsd:decimal "old")')))
    assert told == ['Person(?x) -> decimal("old")']
    assert broken(kb_of("ClassAssertion(:Person :ann)", rule("", 'DataRangeAtom(xsd:decimal "7"^^xsd:decimal)'))) == []


@pytest.mark.parametrize(
    ("atom", "told"),
    [
        ('BuiltInAtom(swrlb:divide "3"^^xsd:integer "1"^^xsd:integer "0"^^xsd:integer)', "1 / 0 has no value: division by zero"),
        ('BuiltInAtom(swrlb:add "3"^^xsd:integer "1"^^xsd:integer "old")', "old is not a number"),
    ],
)
def test_a_rule_that_computes_what_has_no_value_is_refused_and_the_rest_is_read(atom, told):
    axioms = ("ClassAssertion(:Person :ann)", rule(atom), "SubClassOf(:Person :Animal)")
    (sentence,) = reasons(*axioms)
    assert sentence.endswith(f"-> Found(?x): {told}; mend the rule")
    found = imported(*axioms)
    assert found.findings[0].place.line == 9 and found.knowledge_base().ask("animal(ann)")
