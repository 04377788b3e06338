"""Ranges of values in rules: unions, named ones, and what rules cannot test."""

import pytest
from ontologies import imported, kb_of, reasons, rows

AGES = tuple(f'DataPropertyAssertion(:age :p{age} "{age}"^^xsd:integer)' for age in (3, 17, 70))
SMALL = 'DatatypeRestriction(xsd:integer xsd:maxExclusive "10"^^xsd:integer)'
GREAT = 'DatatypeRestriction(xsd:integer xsd:minInclusive "70"^^xsd:integer)'
NAMED = f"DatatypeDefinition(:Small {SMALL})"
FREE = "SubClassOf(DataSomeValuesFrom(:age {}) :Free)".format
ONLY = "DataPropertyRange(:age {})".format


@pytest.mark.parametrize(
    ("range_", "free"),
    [
        (SMALL, ["p3"]),
        (f"DataUnionOf({SMALL} {GREAT})", ["p3", "p70"]),
        (f"DataIntersectionOf({SMALL} {GREAT})", []),
        (f"DataComplementOf({SMALL})", ["p17", "p70"]),
        ('DataOneOf("17"^^xsd:integer "18"^^xsd:integer)', ["p17"]),
        (":Small", ["p3"]),
        ("DataComplementOf(:Small)", ["p17", "p70"]),
        (f"DataComplementOf(DataUnionOf({SMALL} {GREAT}))", ["p17"]),
    ],
)
def test_a_range_is_tested_in_a_condition(range_, free):
    assert rows(kb_of(*AGES, NAMED, FREE(range_)), "free(X)") == [(name,) for name in sorted(free)]


@pytest.mark.parametrize(
    ("range_", "inside"),
    [(SMALL, False), (":Small", False), (f"DataUnionOf({SMALL} {GREAT})", False), (f"DataComplementOf({GREAT})", True)],
)
def test_a_value_outside_its_range_contradicts(range_, inside):
    found = imported('DataPropertyAssertion(:age :p "30"^^xsd:integer)', NAMED, ONLY(range_))
    is_told = any("the ontology contradicts itself" in finding.message for finding in found.findings)
    assert (is_told or bool(found.knowledge_base().broken())) is not inside


@pytest.mark.parametrize(
    ("range_", "told"),
    [
        ('DatatypeRestriction(xsd:string xsd:minInclusive "b")', "compares what is no number; the language compares numbers"),
        ('DatatypeRestriction(xsd:string xsd:pattern "b*")', "the facet pattern has no counterpart in the language"),
        ("DatatypeRestriction(xsd:integer)", "has too few arguments; mend the axiom"),
    ],
)
def test_a_restriction_that_rules_cannot_test_is_told(range_, told):
    assert any(told in reason for reason in reasons(*AGES, FREE(range_)))


def test_a_key_without_properties_is_told():
    assert "HasKey has too few arguments; mend the axiom" in [f.message for f in imported("HasKey(:C () ())").findings]
