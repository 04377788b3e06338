"""Disjoint classes told apart: a few pair by pair, many by one constraint, with the same meaning."""

import pytest
from ontologies import broken, imported, kb_of

PAIRWISE = 12  # as many are told apart pair by pair


def disjoint(classes):
    return f"DisjointClasses({' '.join(classes)})"


def kinds(number):
    return [f":K{at}" for at in range(number)]


def is_of(*classes):
    return [f"ClassAssertion({one} :rex)" for one in classes]


@pytest.mark.parametrize("number", [2, PAIRWISE, PAIRWISE + 1, 30])
def test_what_is_of_two_of_them_is_a_clash_and_what_is_of_one_is_none(number):
    classes = kinds(number)
    assert broken(kb_of(disjoint(classes), *is_of(classes[0]))) == []
    assert len(broken(kb_of(disjoint(classes), *is_of(classes[0], classes[-1])))) == 1


@pytest.mark.parametrize(("number", "constraints"), [(PAIRWISE, PAIRWISE * (PAIRWISE - 1) // 2), (PAIRWISE + 1, 1)])
def test_more_than_twelve_share_one_constraint(number, constraints):
    text = imported(disjoint(kinds(number))).files["ontology.pl"]
    assert text.count("never(") == constraints


@pytest.mark.parametrize("number", [0, PAIRWISE])
def test_classes_of_one_local_name_in_two_namespaces_are_two(number):
    dogs = ("<http://a.org/Dog>", "<http://b.org/Dog>")
    found = imported(disjoint([*dogs, *kinds(number)]), *is_of(*dogs))
    assert len(broken(found.knowledge_base())) == 1


@pytest.mark.parametrize("number", [0, PAIRWISE])
def test_a_class_that_is_disjoint_from_itself_has_nothing(number):
    axiom = disjoint([":Dog", ":Dog", *kinds(number)])
    assert broken(kb_of(axiom, "ClassAssertion(:Cat :rex)", "Declaration(Class(:Dog))")) == []
    assert len(broken(kb_of(axiom, *is_of(":Dog")))) == 1


@pytest.mark.parametrize("number", [0, PAIRWISE])
def test_class_expressions_may_be_disjoint_too(number):
    axiom = disjoint(["ObjectSomeValuesFrom(:has :Tail)", ":Human", *kinds(number)])
    facts = ("ObjectPropertyAssertion(:has :rex :t)", "ClassAssertion(:Tail :t)")
    assert broken(kb_of(axiom, *facts, "Declaration(Class(:Human))")) == []
    assert len(broken(kb_of(axiom, *facts, *is_of(":Human")))) == 1


@pytest.mark.parametrize("number", [1, PAIRWISE])
def test_nothing_is_disjoint_from_everything(number):
    assert broken(kb_of(disjoint(["owl:Nothing", *kinds(number)]), *is_of(":K0"))) == []
