"""Individuals without a name are numbered by what is said of them, whatever a file calls them."""

import pytest
from ontologies import imported, rows


def numbered(axioms, *labels):
    """What the text says of nameless individuals."""
    text = imported(*(axiom.format(*labels) for axiom in axioms)).files["ontology.pl"]
    return {line for line in text.splitlines() if "_:" in line}


@pytest.mark.parametrize(
    "axioms",
    [
        ("ClassAssertion(:Dog {0})", "ClassAssertion(:Cat {1})"),
        ("ClassAssertion(<http://a.org/Dog> {0})", "ClassAssertion(<http://b.org/Dog> {1})"),
        ('DataPropertyAssertion(:name {0} "Rex")', 'DataPropertyAssertion(:name {1} "Tom")'),
        ("ObjectPropertyAssertion(:chases {0} {1})", "ClassAssertion(:Dog {0})", "ClassAssertion(:Dog {1})"),
        ("ObjectPropertyAssertion(:chases {0} {0})", "ObjectPropertyAssertion(:chases {0} {1})"),
    ],
)
def test_the_numbers_do_not_depend_on_the_labels(axioms):
    assert numbered(axioms, "_:p", "_:q") == numbered(axioms, "_:q", "_:p") != set()


def test_those_of_whom_the_same_is_said_are_two():
    kb = imported("ClassAssertion(:Dog _:p)", "ClassAssertion(:Dog _:q)").knowledge_base()
    assert rows(kb, "dog(X)") == [("_:1",), ("_:2",)]


def test_a_chain_of_eight_is_numbered_from_its_ends():
    chain = [f"ObjectPropertyAssertion(:next {{{at}}} {{{at + 1}}})" for at in range(7)]
    labels = [f"_:n{at}" for at in range(8)]
    assert numbered(chain, *labels) == numbered(chain, *reversed(labels))
