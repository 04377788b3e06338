"""Every name that an axiom speaks of has its IRI in the text, declared or not."""

import pytest
from ontologies import imported, rows

BODY = "DataPropertyAtom(:code Variable(v:x) Variable(v:n))"


@pytest.mark.parametrize(
    ("axiom", "names"),
    [
        (f"DLSafeRule(Body({BODY} DataRangeAtom(:Chip Variable(v:n))) Head(ClassAtom(:C Variable(v:x))))", {"code", "chip", "c"}),
        ('DatatypeDefinition(:Chip DataOneOf("x17"))', {"chip"}),
        ("SubClassOf(:A ObjectSomeValuesFrom(:has ObjectOneOf(:rex)))", {"a", "has", "rex"}),
        ("SubClassOf(:A ObjectAllValuesFrom(ObjectInverseOf(:has) :B))", {"a", "has", "b"}),
    ],
)
def test_what_an_axiom_speaks_of_has_a_name(axiom, names):
    text = imported(axiom).files["names.pl"]
    assert {line.partition("(")[2].partition(",")[0] for line in text.splitlines() if "z.org" in line} == names


def test_an_undeclared_datatype_shares_no_name_with_a_class():
    rule = f"DLSafeRule(Body({BODY} DataRangeAtom(<http://a.org/Chip> Variable(v:n))) Head(ClassAtom(:C Variable(v:x))))"
    kb = imported(rule, "ClassAssertion(<http://b.org/Chip> :rex)").knowledge_base()
    named = {iri: name for name, iri in rows(kb, "iri(N, I)")}
    assert (named["http://a.org/Chip"], named["http://b.org/Chip"]) == ("chip", "chip_2")
