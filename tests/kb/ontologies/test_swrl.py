"""SWRL: every kind of atom, and the built-ins that the language has; the others are listed."""

import pytest
from ontologies import broken, imported, kb_of, reasons, rows

AGES = tuple(f'DataPropertyAssertion(:age :p{age} "{age}"^^xsd:integer)' for age in (3, 17, 18))
PEOPLE = tuple(f"ClassAssertion(:Person :p{age})" for age in (3, 17, 18))


def swrl(body, head):
    return f"DLSafeRule(Body({body}) Head({head}))"


def v(name):
    return f"Variable(v:{name})"


AGE = f"DataPropertyAtom(:age {v('x')} {v('n')})"
PERSON = f"ClassAtom(:Person {v('x')})"


def test_class_and_property_atoms():
    kb = kb_of("ObjectPropertyAssertion(:has :ann :rex)", "ClassAssertion(:Dog :rex)",
               swrl(f"ObjectPropertyAtom(:has {v('x')} {v('y')}) ClassAtom(:Dog {v('y')})", f"ClassAtom(:Owner {v('x')})"))  # fmt: skip
    assert rows(kb, "owner(X)") == [("ann",)]
    assert "has(?x, ?y), Dog(?y) -> Owner(?x)" in str(kb.why("owner(ann)"))


def test_class_expressions_in_a_body_and_a_head():
    body = f"ClassAtom(ObjectUnionOf(:Person ObjectHasValue(:has :rex)) {v('x')})"
    head = f"ClassAtom(ObjectIntersectionOf(:Kind :Known) {v('x')})"
    kb = kb_of(*PEOPLE, "ObjectPropertyAssertion(:has :ann :rex)", swrl(body, head))
    assert rows(kb, "known(X)") == [("ann",), ("p17",), ("p18",), ("p3",)]
    assert rows(kb, "kind(X)") == rows(kb, "known(X)")


def test_individuals_and_values_may_stand_for_variables():
    kb = kb_of(*AGES, swrl('DataPropertyAtom(:age Variable(v:x) "18"^^xsd:integer)', f"ObjectPropertyAtom(:knows {v('x')} :bob)"))
    assert rows(kb, "knows(X, Y)") == [("p18", "bob")]


def test_several_atoms_of_a_head_are_concluded_together():
    kb = kb_of(*PEOPLE, swrl(PERSON, f"ClassAtom(:A {v('x')}) ClassAtom(:B {v('x')})"))
    assert rows(kb, "a(X)") == rows(kb, "b(X)") != []


def test_an_empty_head_is_a_constraint_and_an_empty_body_a_fact():
    assert broken(kb_of(*PEOPLE, swrl(PERSON, ""))) == ["Person(?x) -> nothing"]
    assert kb_of(swrl("", "ClassAtom(:Person :ann)")).ask("person(ann)")


def test_a_variable_of_the_head_alone_ranges_over_the_named_things():
    kb = kb_of(*PEOPLE, swrl("ClassAtom(:Person :p3)", f"ClassAtom(:Safe {v('y')})"))
    assert rows(kb, "safe(X)") == [("p17",), ("p18",), ("p3",)]


def test_same_as_in_a_head_makes_one_of_two():
    kb = kb_of(*PEOPLE, *AGES, 'DataPropertyAssertion(:age :q "3"^^xsd:integer)',
               swrl(f"{AGE} DataPropertyAtom(:age {v('y')} {v('n')})", f"SameIndividualAtom({v('x')} {v('y')})"))  # fmt: skip
    assert kb.ask("person(q)")


def test_same_as_in_a_body_holds_of_a_thing_and_itself_and_of_equal_things():
    head = f"ObjectPropertyAtom(:is {v('x')} {v('y')})"
    rule = swrl(f"{PERSON} ClassAtom(:Person {v('y')}) SameIndividualAtom({v('x')} {v('y')})", head)
    assert rows(kb_of("ClassAssertion(:Person :a)", rule), "is_2(X, Y)") == [("a", "a")]
    equal = kb_of("ClassAssertion(:Person :a)", "SameIndividual(:a :b)", rule)
    assert len(rows(equal, "is_2(X, Y)")) == 4


def test_different_from_in_a_body_needs_a_difference_that_is_known():
    rule = swrl(f"{PERSON} ClassAtom(:Person {v('y')}) DifferentIndividualsAtom({v('x')} {v('y')})", f"ObjectPropertyAtom(:other {v('x')} {v('y')})")
    kb = kb_of(*PEOPLE, "DifferentIndividuals(:p3 :p17)", rule)
    assert rows(kb, "other(X, Y)") == [("p17", "p3"), ("p3", "p17")]
    assert rows(kb_of(*PEOPLE, rule), "other(X, Y)") == []


def test_a_difference_is_one_under_every_name():
    rule = swrl(f"DifferentIndividualsAtom({v('x')} {v('y')})", f"ObjectPropertyAtom(:other {v('x')} {v('y')})")
    kb = kb_of("DifferentIndividuals(:a :b)", "SameIndividual(:b :c)", rule)
    assert kb.ask("other(a, c)") and kb.ask("other(c, a)") and not kb.ask("other(b, c)")


def test_different_from_in_a_head_clashes_with_sameness():
    rule = swrl(f"ObjectPropertyAtom(:parent {v('x')} {v('y')})", f"DifferentIndividualsAtom({v('x')} {v('y')})")
    stated = "ObjectPropertyAssertion(:parent :ann :eve)"
    assert broken(kb_of(stated, rule)) == []
    assert broken(kb_of(stated, rule, "SameIndividual(:ann :eve)")) == ["parent(?x, ?y) -> differentFrom(?x, ?y)"]
    assert broken(kb_of("ObjectPropertyAssertion(:parent :ann :ann)", rule)) == ["parent(?x, ?y) -> differentFrom(?x, ?y)"]


def test_a_data_range_atom_tests_in_a_body_and_constrains_in_a_head():
    grown = 'DatatypeRestriction(xsd:decimal xsd:minInclusive "18"^^xsd:integer)'
    body = f"{AGE} DataRangeAtom({grown} {v('n')})"
    assert rows(kb_of(*AGES, swrl(body, f"ClassAtom(:Adult {v('x')})")), "adult(X)") == [("p18",)]
    assert len(broken(kb_of(*AGES, swrl(AGE, f"DataRangeAtom({grown} {v('n')})")))) == 1


@pytest.mark.parametrize(
    ("name", "limit", "found"),
    [
        ("equal", 17, ["p17"]), ("notEqual", 17, ["p18", "p3"]), ("lessThan", 17, ["p3"]),
        ("lessThanOrEqual", 17, ["p17", "p3"]), ("greaterThan", 17, ["p18"]), ("greaterThanOrEqual", 17, ["p17", "p18"]),
    ],
)  # fmt: skip
def test_comparisons(name, limit, found):
    body = f'{AGE} BuiltInAtom(swrlb:{name} {v("n")} "{limit}"^^xsd:integer)'
    assert [x for (x,) in rows(kb_of(*AGES, swrl(body, f"ClassAtom(:C {v('x')})")), "c(X)")] == found


ARITHMETIC = [
    ("add", '"1"^^xsd:integer "2"^^xsd:integer', 20),
    ("subtract", '"1"^^xsd:integer', 16),
    ("multiply", '"2"^^xsd:integer "3"^^xsd:integer', 102),
    ("divide", '"2"^^xsd:integer', 8.5),
    ("unaryMinus", "", -17),
    ("unaryPlus", "", 17),
    ("integerDivide", '"2"^^xsd:integer', 8),
    ("integerDivide", '"-2"^^xsd:integer', -8),  # towards zero
    ("mod", '"5"^^xsd:integer', 2),
    ("mod", '"-5"^^xsd:integer', 2),  # with the sign of what is divided
    ("pow", '"2"^^xsd:integer', 289),
    ("abs", "", 17),
    ("floor", "", 17),
    ("ceiling", "", 17),
    ("round", "", 17),
]


@pytest.mark.parametrize(("name", "more", "result"), ARITHMETIC)
def test_arithmetic_computes(name, more, result):
    body = f"{AGE} BuiltInAtom(swrlb:{name} {v('m')} {v('n')} {more})"
    axioms = (AGES[1], swrl(body, f"DataPropertyAtom(:made {v('x')} {v('m')})"))
    assert rows(kb_of(*axioms), "made(X, M)") == [("p17", result)]


@pytest.mark.parametrize(
    ("name", "condition"),
    [
        *[("sin", "sin(N)"), ("cos", "cos(N)"), ("tan", "tan(N)"), ("ceiling", "ceiling(N)"), ("round", "floor(N + 0.5)")],
        *[("unaryPlus", "N + 0"), ("unaryMinus", "0 - N"), ("mod", "N rem N"), ("integerDivide", "N // N")],
    ],
)
def test_arithmetic_is_spelt_as_in_prolog(name, condition):
    again = v("n") if name in ("mod", "integerDivide") else ""
    body = f"{AGE} BuiltInAtom(swrlb:{name} {v('m')} {v('n')} {again})"
    text = imported(swrl(body, f"DataPropertyAtom(:made {v('x')} {v('m')})")).files["ontology.pl"]
    assert f"M is {condition}" in text


STRINGS = [
    ("stringConcat", f'{v("m")} {v("n")} "!"', "Today!"),
    ("stringConcat", f'{v("m")} "<" {v("n")} ">" "."', "<Today>."),
    ("stringConcat", f"{v('m')} {v('n')}", "Today"),
    ("stringLength", f"{v('m')} {v('n')}", 5),
    ("upperCase", f"{v('m')} {v('n')}", "TODAY"),
    ("lowerCase", f"{v('m')} {v('n')}", "today"),
]
TESTS = [("stringConcat", "Today", "Other"), ("contains", "oda", "odd"), ("startsWith", "To", "to"), ("endsWith", "day", "Day"), ("stringEqualIgnoreCase", "TODAY", "day")]
NAMED = 'DataPropertyAssertion(:name :x "Today")'
NAME = f"DataPropertyAtom(:name {v('x')} {v('n')})"


@pytest.mark.parametrize(("name", "args", "result"), STRINGS)
def test_strings_are_made(name, args, result):
    axioms = (NAMED, swrl(f"{NAME} BuiltInAtom(swrlb:{name} {args})", f"DataPropertyAtom(:made {v('x')} {v('m')})"))
    assert rows(kb_of(*axioms), "made(X, M)") == [("x", result)]


@pytest.mark.parametrize(("name", "yes", "no"), TESTS)
def test_strings_are_tested(name, yes, no):
    for text, found in ((yes, [("x",)]), (no, [])):
        axioms = (NAMED, swrl(f'{NAME} BuiltInAtom(swrlb:{name} {v("n")} "{text}")', f"ClassAtom(:C {v('x')})"))
        assert rows(kb_of(*axioms), "c(X)") == found


@pytest.mark.parametrize(
    ("name", "args"),
    [
        *[("add", f"{v('m')} {v('n')}"), ("subtract", f"{v('m')} {v('n')}"), ("abs", f"{v('m')} {v('n')} {v('n')}")],
        *[("stringConcat", f"{v('m')}"), ("stringLength", f"{v('m')}"), ("contains", f"{v('n')} {v('n')} {v('n')}")],
    ],
)
def test_a_built_in_with_too_few_or_too_many_arguments_is_told(name, args):
    (told,) = reasons(swrl(f"{AGE} BuiltInAtom(swrlb:{name} {args})", f"ClassAtom(:C {v('x')})"))
    assert f"swrlb:{name} has the wrong number of arguments; mend the rule" in told


@pytest.mark.parametrize(
    ("body", "head", "told"),
    [
        (f"{PERSON} BuiltInAtom(swrlb:matches {v('x')} {v('x')})", f"ClassAtom(:C {v('x')})", "the language has nothing like it"),
        (f"{PERSON} BuiltInAtom(:mine {v('x')})", f"ClassAtom(:C {v('x')})", "no built-in of SWRL"),
        (f'{AGE} BuiltInAtom(swrlb:lessThan {v("n")} "b")', f"ClassAtom(:C {v('x')})", "compares what is no number"),
        (f"{AGE} BuiltInAtom(swrlb:lessThan {v('n')})", f"ClassAtom(:C {v('x')})", "wrong number of arguments"),
        (f"{AGE} BuiltInAtom(swrlb:add {v('k')} {v('n')} {v('free')})", f"ClassAtom(:C {v('x')})", "nothing in the conditions gives"),
        (PERSON, f"DataPropertyAtom(:age {v('x')} {v('free')})", "nothing in the conditions gives"),
        (PERSON, f"ClassAtom(ObjectSomeValuesFrom(:has :Dog) {v('x')})", "no rule can name"),
        (PERSON, f"BuiltInAtom(swrlb:equal {v('x')} {v('x')})", "can be no conclusion"),
        (f"ClassAtom(ObjectComplementOf(:Person) {v('x')})", f"ClassAtom(:C {v('x')})", "what is not stated may be so"),
    ],
)
def test_what_a_rule_cannot_say_is_listed(body, head, told):
    (sentence,) = reasons(*AGES, *PEOPLE, swrl(body, head))
    assert told in sentence


def test_what_compares_values_that_are_no_numbers_is_listed_instead_of_never_holding():
    body = f"DataPropertyAtom(:born {v('x')} {v('n')}) BuiltInAtom(swrlb:lessThan {v('n')} {v('n')})"
    (told,) = reasons('DataPropertyAssertion(:born :ann "2026-01-01"^^xsd:date)', swrl(body, f"ClassAtom(:C {v('x')})"))
    assert "born has values that are no numbers" in told


def test_a_computed_property_stays_finite_among_equal_things():
    rule = swrl(f"{AGE} BuiltInAtom(swrlb:add {v('m')} {v('n')} \"1\"^^xsd:integer)", f"DataPropertyAtom(:next {v('x')} {v('m')})")
    kb = kb_of(*AGES, rule, "SameIndividual(:p3 :q)", 'DataPropertyAssertion(:next :p18 "20"^^xsd:integer)', "SameIndividual(:p18 :r)")
    assert rows(kb, "next(q, N)") == [(4,)]
    assert rows(kb, "next(r, N)") == [(19,), (20,)]


def test_variables_keep_the_names_their_author_gave_them():
    text = imported(*AGES, swrl(f"DataPropertyAtom(:age {v('the-person')} {v('n')})", f"ClassAtom(:C {v('the-person')})")).files["ontology.pl"]
    assert "c(The_person) :- age(The_person, _)." in text


def test_a_property_that_is_computed_from_itself_is_told(tmp_path):
    rule = swrl(f'{AGE} BuiltInAtom(swrlb:add {v("m")} {v("n")} "1"^^xsd:integer)', f"DataPropertyAtom(:age {v('x')} {v('m')})")
    (told,) = imported(*AGES, rule).write(tmp_path)
    assert "age/2: a rule computes what it needs itself" in told.message


def test_computing_and_things_in_general_go_together():
    kb = kb_of(*AGES, "SubClassOf(owl:Thing :Any)", swrl(f'{AGE} BuiltInAtom(swrlb:add {v("m")} {v("n")} "1"^^xsd:integer)', f"DataPropertyAtom(:next {v('x')} {v('m')})"))
    assert rows(kb, "any(X)") == [("p17",), ("p18",), ("p3",)]
    assert rows(kb, "next(p3, N)") == [(4,)]


def test_a_rule_without_its_head_is_told():
    assert reasons(*PEOPLE, f"DLSafeRule(Body({PERSON}))") == ["a rule has a Body(…) and a Head(…); mend the rule"]


def test_a_rule_in_triples_without_its_body_is_told():
    from ontologies import imported_text

    text = """@prefix swrl: <http://www.w3.org/2003/11/swrl#> . @prefix : <http://z.org/> . :x a swrl:Variable .
    [] a swrl:Imp ; swrl:head ( [ a swrl:ClassAtom ; swrl:classPredicate :C ; swrl:argument1 :x ] ) ."""
    found = imported_text(text, "ttl")
    assert "its body is not there; mend the rule; nothing was made of it" in found.findings[0].message
    assert not found.knowledge_base().defines("c", 1)


def test_a_property_without_end_is_told_as_one_where_a_constraint_cannot_be_searched_through(tmp_path):
    rule = swrl(f'{AGE} BuiltInAtom(swrlb:add {v("m")} {v("n")} "1"^^xsd:integer)', f"DataPropertyAtom(:age {v('x')} {v('m')})")
    told = imported(*AGES, rule, "SubClassOf(:A DataMaxCardinality(1 :age))", "ClassAssertion(:A :ann)").write(tmp_path)
    assert sorted(f.message.partition(" ")[0] for f in told) == ["age/2:", "the"]
    assert any("the answer is unknown" in f.message for f in told)
