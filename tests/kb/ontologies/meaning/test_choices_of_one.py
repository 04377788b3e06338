"""A conclusion with a choice is refused; with one thing to choose there is no choice."""

import pytest
from ontologies import kb_of, reasons

ANN = "ClassAssertion(:A :ann)"


def test_a_union_of_one_class_is_that_class():
    assert kb_of(ANN, "SubClassOf(:A ObjectUnionOf(:B))").ask("b(ann)")


def test_what_is_one_of_one_individual_is_that_individual():
    assert kb_of(ANN, "SubClassOf(:A ObjectOneOf(:eve))", "ClassAssertion(:B :eve)").ask("b(ann)")


def test_some_value_of_one_individual_is_that_individual():
    assert kb_of(ANN, "SubClassOf(:A ObjectSomeValuesFrom(:knows ObjectOneOf(:eve)))").ask("knows(ann, eve)")


@pytest.mark.parametrize("concept", ["ObjectUnionOf(:B :C)", "ObjectOneOf(:eve :bob)"])
def test_a_conclusion_with_a_choice_is_refused(concept):
    (told,) = reasons(ANN, f"SubClassOf(:A {concept})")
    assert told.endswith("nothing follows for certain: rules have no conclusion with a choice")
