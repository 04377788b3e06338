"""Each construct about classes and individuals: what follows from it, and what breaks it."""

import pytest
from ontologies import broken, functional, imported, kb_of, reasons, rows

from casper.kb.ontologies.importing import import_ontologies

FACTS = ("ClassAssertion(:Dog :rex)", "ClassAssertion(:Cat :tom)", "ObjectPropertyAssertion(:has :ann :rex)")


@pytest.mark.parametrize(
    ("axiom", "statement"),
    [
        ("SubClassOf(:Dog :Animal)", "animal(rex)"),
        ("EquivalentClasses(:Dog :Hound)", "hound(rex)"),
        ("EquivalentClasses(:Hound :Dog)", "hound(rex)"),
        ("EquivalentClasses(:Chien :Dog :Hound)", "hound(rex)"),
        ("SubClassOf(:Dog ObjectIntersectionOf(:Animal :Pet))", "pet(rex)"),
        ("SubClassOf(ObjectUnionOf(:Cat :Dog) :Pet)", "pet(tom)"),
        ("SubClassOf(ObjectIntersectionOf(:Dog ObjectSomeValuesFrom(ObjectInverseOf(:has) owl:Thing)) :Pet)", "pet(rex)"),
        ("SubClassOf(ObjectSomeValuesFrom(:has :Dog) :Owner)", "owner(ann)"),
        ("SubClassOf(ObjectSomeValuesFrom(:has ObjectUnionOf(:Cat :Dog)) :Owner)", "owner(ann)"),
        ("SubClassOf(ObjectSomeValuesFrom(:has owl:Thing) :Owner)", "owner(ann)"),
        ("SubClassOf(ObjectMinCardinality(1 :has) :Owner)", "owner(ann)"),
        ("SubClassOf(ObjectHasValue(:has :rex) :Owner)", "owner(ann)"),
        ("SubClassOf(ObjectOneOf(:rex :tom) :Pet)", "pet(tom)"),
        ("SubClassOf(owl:Thing :Thing)", "thing_2(ann)"),
        ("SubClassOf(:Dog ObjectHasValue(:livesIn :earth))", "lives_in(rex, earth)"),
        ("SubClassOf(:Dog ObjectHasSelf(:likes))", "likes(rex, rex)"),
        ("SubClassOf(ObjectOneOf(:ann) ObjectAllValuesFrom(:has :Pet))", "pet(rex)"),
        ("ClassAssertion(ObjectAllValuesFrom(:has :Pet) :ann)", "pet(rex)"),
        ("ClassAssertion(ObjectIntersectionOf(:Person :Adult) :ann)", "adult(ann)"),
        ("SubClassOf(:Dog ObjectSomeValuesFrom(:livesIn ObjectOneOf(:earth)))", "lives_in(rex, earth)"),
        ("DisjointUnion(:Pet :Dog)", "pet(rex)"),
    ],
)
def test_what_follows_from_an_axiom_about_classes_is_known_and_cites_it(axiom, statement):
    name, arity = statement.partition("(")[0], statement.count(",") + 1
    assert not kb_of(*FACTS).defines(name, arity) or not kb_of(*FACTS).ask(statement)
    kb = kb_of(*FACTS, axiom)
    assert kb.ask(statement)
    proof = str(kb.why(statement))
    assert "ontology.pl:" in proof


@pytest.mark.parametrize(
    ("axioms", "sentence"),
    [
        (("DisjointClasses(:Cat :Dog)", "ClassAssertion(:Cat :rex)"), "Cat DisjointWith Dog"),
        (("DisjointClasses(:Cat :Dog :Bird)", "ClassAssertion(:Bird :rex)"), "DisjointClasses(Bird, Cat, Dog)"),
        (("SubClassOf(:Dog ObjectComplementOf(:Wild))", "ClassAssertion(:Wild :rex)"), "Dog SubClassOf not Wild"),
        (("SubClassOf(:Dog owl:Nothing)",), "Dog SubClassOf Nothing"),
        (("ClassAssertion(owl:Nothing :rex)",), "rex Type Nothing"),
        (("SubClassOf(ObjectOneOf(:ann) ObjectMaxCardinality(0 :has))",), "{ann} SubClassOf has max 0"),
        (("SubClassOf(ObjectOneOf(:ann) ObjectMaxCardinality(0 :has :Dog))",), "{ann} SubClassOf has max 0 Dog"),
        (("SubClassOf(ObjectOneOf(:ann) ObjectAllValuesFrom(:has owl:Nothing))",), "{ann} SubClassOf has only Nothing"),
        (("NegativeObjectPropertyAssertion(:has :ann :rex)",), "not has(ann, rex)"),
        (("SameIndividual(:rex :tom)", "DifferentIndividuals(:tom :rex)"), "rex DifferentFrom tom"),
        (("SameIndividual(:rex :tom)", "DifferentIndividuals(:tom :rex :ann)"), "DifferentIndividuals(ann, rex, tom)"),
        (("SameIndividual(:rex :tom)", "NegativeObjectPropertyAssertion(:has :ann :tom)"), "not has(ann, tom)"),
    ],
)
def test_axioms_that_clash_with_the_facts_are_named(axioms, sentence):
    assert broken(kb_of(*FACTS, *axioms[:-1], "ClassAssertion(:Cat :felix)")) == []
    assert broken(kb_of(*FACTS, *axioms)) == [sentence]


def test_disjoint_classes_that_nothing_is_both_of_break_nothing():
    assert broken(kb_of(*FACTS, "DisjointClasses(:Cat :Dog :Bird)")) == []


def test_many_disjoint_classes_share_one_constraint():
    many = " ".join(f":C{n}" for n in range(40))
    members = [f"ClassAssertion(:C{n} :x{n})" for n in range(40)]
    assert broken(kb_of(f"DisjointClasses({many})", *members)) == []
    text = imported(f"DisjointClasses({many})", *members).files["ontology.pl"]
    assert text.count("never(") == 1
    assert len(broken(kb_of(f"DisjointClasses({many})", *members, "ClassAssertion(:C7 :x3)"))) == 1


def test_equal_individuals_share_classes_and_properties_under_every_name():
    kb = kb_of(*FACTS, "SameIndividual(:rex :fido)", "SameIndividual(:fido :waldi)", 'DataPropertyAssertion(:age :rex "3"^^xsd:integer)')
    assert rows(kb, "dog(X)") == [("fido",), ("rex",), ("waldi",)]
    assert rows(kb, "has(ann, X)") == [("fido",), ("rex",), ("waldi",)]
    assert rows(kb, "age(X, A)") == [("fido", 3), ("rex", 3), ("waldi", 3)]


def test_sameness_that_is_stated_later_is_shared_too():
    kb = kb_of(*FACTS, "SameIndividual(:a :b)")
    kb.assert_("same(tom, felix)")
    assert kb.ask("cat(felix)")
    kb.retract("same(tom, felix)")
    assert not kb.ask("cat(felix)")


def test_without_an_axiom_that_can_make_things_equal_there_are_no_rules_for_it():
    text = imported(*FACTS, "DifferentIndividuals(:rex :ann)").files["ontology.pl"]
    assert "What holds of whatever there is" not in text
    assert "What holds of whatever there is" in imported(*FACTS, "SameIndividual(:rex :ann)").files["ontology.pl"]


@pytest.mark.parametrize("key", ["(:chip)", "(:chip :owner)"])
def test_two_that_agree_on_a_key_are_one(key):
    objects = "(:owner)" if "owner" in key else "()"
    kb = kb_of(
        f"HasKey(:Dog {objects} (:chip))",
        *(f"ClassAssertion(:Dog :{dog})" for dog in ("rex", "fido", "waldi")),
        *(f'DataPropertyAssertion(:chip :{dog} "17")' for dog in ("rex", "fido", "tom")),
        'DataPropertyAssertion(:chip :waldi "18")',
        *(f"ObjectPropertyAssertion(:owner :{dog} :ann)" for dog in ("rex", "fido", "waldi")),
    )
    assert rows(kb, "same(X, Y)") == [("fido", "rex"), ("rex", "fido")]


def test_at_most_one_makes_two_values_one():
    kb = kb_of(
        "SubClassOf(:Dog ObjectMaxCardinality(1 :owner :Person))",
        "ClassAssertion(:Dog :rex)",
        *(f"ClassAssertion(:Person :{x})" for x in ("ann", "anna")),
        *(f"ObjectPropertyAssertion(:owner :rex :{x})" for x in ("ann", "anna", "bank")),
    )
    assert rows(kb, "same(X, Y)") == [("ann", "anna"), ("anna", "ann")]


def test_one_of_a_single_individual_is_that_individual():
    kb = kb_of("SubClassOf(:Pope ObjectOneOf(:leo))", "ClassAssertion(:Pope :robert)")
    assert kb.ask("same(robert, leo)")


def test_an_individual_of_which_nothing_else_is_known_is_a_thing():
    assert rows(kb_of("Declaration(NamedIndividual(:ann))"), "thing(X)") == [("ann",)]


def test_classes_without_members_are_known_and_empty():
    kb = kb_of("Declaration(Class(:Unicorn))", "SubClassOf(:Unicorn :Animal)")
    assert rows(kb, "animal(X)") == []
    kb.assert_("unicorn(u)")
    assert kb.ask("animal(u)")


@pytest.mark.parametrize(
    ("axiom", "told"),
    [
        ("SubClassOf(:Dog ObjectSomeValuesFrom(:has :Bone))", "which no rule can name"),
        ("SubClassOf(:Dog ObjectMinCardinality(1 :has))", "which no rule can name"),
        ("SubClassOf(:Dog ObjectMinCardinality(2 :has))", "which no rule can name"),
        ("SubClassOf(:Dog ObjectExactCardinality(1 :has))", "only the most is used"),
        ("SubClassOf(:Dog ObjectMaxCardinality(2 :has))", "counts further than 1"),
        ("SubClassOf(:Pet ObjectUnionOf(:Cat :Dog))", "no conclusion with a choice"),
        ("SubClassOf(:Pet ObjectOneOf(:rex :tom))", "no conclusion with a choice"),
        ("DisjointUnion(:Pet :Cat :Dog)", "no conclusion with a choice"),
        ("SubClassOf(ObjectComplementOf(:Dog) :Cat)", "what is not stated may be so all the same"),
        ("SubClassOf(ObjectAllValuesFrom(:has :Dog) :DogOwner)", "what is not stated may be so all the same"),
        ("SubClassOf(ObjectMaxCardinality(1 :has) :Poor)", "there may be more than is stated"),
        ("SubClassOf(ObjectMinCardinality(2 :has) :Rich)", "at least 1 is what rules can tell"),
        ("ClassAssertion(ObjectUnionOf(:Cat :Dog) :rex)", "no conclusion with a choice"),
        ("SubObjectPropertyOf(owl:topObjectProperty :has)", "relates everything or nothing"),
        ("DifferentIndividuals(:rex :rex)", "contradicts itself"),
        ("SubClassOf(:Dog)", "has too few arguments"),
        ("EquivalentClasses(:Dog)", "has too few arguments"),
        ("HasKey(:Dog () ())", "has too few arguments"),
        ("SubClassOf(:Dog :Cat :Bird)", "wrong number of arguments"),
        ("Sub(:Dog :Cat)", "is no axiom of OWL 2"),
    ],
)
def test_what_is_beyond_rules_is_listed_with_its_line_and_the_rest_is_read(axiom, told, tmp_path):
    file = tmp_path / "zoo.ofn"
    file.write_text(functional("ClassAssertion(:Dog :rex)", "ClassAssertion(:Dog :tom)", axiom))
    findings = import_ontologies([file]).findings
    assert [(f.place.line, told in f.message) for f in findings if f.severity != "note"] == [(10, True)]
    assert import_ontologies([file]).knowledge_base().ask("dog(rex)")


def test_the_part_of_an_equivalence_that_rules_can_say_is_used():
    axioms = ("EquivalentClasses(:Owner ObjectIntersectionOf(:Person ObjectSomeValuesFrom(:has :Dog)))", *FACTS)
    found = imported(*axioms, "ClassAssertion(:Person :ann)", "ClassAssertion(:Owner :bob)")
    kb = found.knowledge_base()
    assert rows(kb, "owner(X)") == [("ann",), ("bob",)]
    assert kb.ask("person(bob)")
    assert len(found.findings) == 1


def test_too_many_alternatives_are_refused():
    unions = " ".join(f"ObjectUnionOf({' '.join(f':C{n}_{m}' for m in range(7))})" for n in range(3))
    (told,) = reasons(f"SubClassOf(ObjectIntersectionOf({unions}) :D)")
    assert "more than 256" in told


def test_what_is_stated_later_to_have_two_names_is_a_thing():
    kb = kb_of("ReflexiveObjectProperty(:knows)", "SameIndividual(:ann :anna)")
    assert not kb.ask("knows(rob, rob)")
    kb.assert_("same(rob, bob)")
    assert kb.ask("knows(rob, rob)") and kb.ask("knows(bob, bob)")
