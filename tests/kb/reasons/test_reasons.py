"""Why and why not: every proof checks without the knowledge base, every named condition really fails."""

import pytest
from hypothesis import given
from programs import BASE, DERIVED, atoms_of, ground_terms, holds, match, programs, put, statements_over, undefined_of

from casper.kb.base import KnowledgeBase
from casper.kb.reasons.doubt import Doubt
from casper.kb.reasons.proof import Proof
from casper.kb.reasons.wording import failure_sentence, noun_phrase
from casper.kb.terms.clauses import Literal
from casper.kb.terms.terms import Compound
from casper.kb.terms.unification import is_ground
from casper.kb.text.reader import read_query


def rows_of(base):
    indicators = {**BASE, **DERIVED}.items()
    return atoms_of({i: base.stored(i) for i in indicators})


def undefined_rows_of(base):
    return undefined_of({i: base.stored(i) for i in {**BASE, **DERIVED}.items()})


def check(proof, base, rows, above=(), possible=None):
    """Refuse anything that is not a proof: each node a fact, a true test, or an instance of its clause."""
    assert proof.literal.atom not in above, "a proof must not lean on what it proves"
    if proof.clause is None:
        assert proof.literal.negated or proof.literal.is_comparison
        assert holds(proof.literal, rows, possible) and not proof.premises
        return
    assert proof.clause in base.clauses
    environment = match(proof.clause.head, proof.fact, {})
    assert len(proof.premises) == len(proof.clause.body)
    for literal, premise in zip(proof.clause.body, proof.premises):
        assert premise.literal.negated == literal.negated
        if not literal.negated:
            environment = match(literal.atom, premise.fact, environment)
            assert environment is not None
        check(premise, base, rows, (*above, proof.fact), possible)
    for literal, premise in zip(proof.clause.body, proof.premises):
        if literal.negated:  # what an anonymous part stands for is left open
            assert str(put(literal.atom, environment)) == str(premise.fact)


@given(programs(circles=True))
def test_every_proof_of_a_row_checks(text):
    base = KnowledgeBase.from_text(text)
    rows = rows_of(base)
    possible = rows | undefined_rows_of(base)
    for atom in rows:
        check(base.why(atom), base, rows, possible=possible)


def check_doubt(doubt, base, rows, possible):
    """Refuse anything that is no reason for being undefined: steps through rules that end nowhere, or prove nothing."""
    assert doubt.steps
    following = [*doubt.steps[1:], *([doubt.steps[doubt.back]] if doubt.back is not None else [])]
    assert doubt.steps[0].fact == doubt.fact
    for step, other in zip(doubt.steps, following):
        assert not step.failure and step.needs == other.fact
        assert match(step.literal.atom, other.fact, {}) is not None
    if doubt.back is None:
        assert holds(doubt.steps[-1].literal, rows, possible) is None and doubt.steps[-1].literal.is_comparison
        assert doubt.steps[-1].failure
    else:
        assert any(step.literal.negated for step in doubt.steps[doubt.back :])
    for step in doubt.steps:
        assert step.clause in base.clauses and step.literal in step.body
        environment = match(step.clause.head, step.fact, {})
        for literal, instance in zip(step.clause.body, step.body, strict=True):
            assert literal.negated == instance.negated
            if not literal.negated and is_ground(instance.atom):
                environment = match(literal.atom, instance.atom, environment)
                assert environment is not None
            assert holds(instance, rows, possible) is not False
        assert holds(step.literal, rows, possible) is None


@given(programs(circles=True))
def test_every_undefined_row_has_its_circle_or_its_failed_evaluation(text):
    base = KnowledgeBase.from_text(text)
    rows = rows_of(base)
    undefined = undefined_rows_of(base)
    for atom in undefined:
        doubt = base.why(atom)
        check_doubt(doubt, base, rows, rows | undefined)
        assert base.why_not(atom).reasons[0] == doubt.sentence == base.verify(atom).reasons[0]
        assert base.verify(atom).valid is None


@given(programs(circles=True))
def test_what_does_not_hold_has_no_proof(text):
    base = KnowledgeBase.from_text(text)
    rows, undefined = rows_of(base), undefined_rows_of(base)
    for statement in statements_over(ground_terms(base.clauses)[:4]):
        assert isinstance(base.why(statement), Proof) == (statement in rows)
        assert isinstance(base.why(statement), Doubt) == (statement in undefined)


@given(programs(circles=True))
def test_every_condition_that_a_refusal_names_really_fails(text):
    base = KnowledgeBase.from_text(text)
    rows, undefined = rows_of(base), undefined_rows_of(base)
    for statement in statements_over(ground_terms(base.clauses)[:4]):
        refusal = base.why_not(statement)
        assert (refusal is None) == (statement in rows)
        for attempt in refusal.attempts if refusal and not refusal.doubt else ():
            assert attempt.failed
            for literal in attempt.failed:
                if is_ground(literal.atom) or not literal.negated:
                    assert holds(literal, rows, rows | undefined) is False


@given(programs(negation=False))
def test_adding_the_base_facts_that_a_refusal_names_makes_the_statement_hold_unless_a_comparison_has_no_value(text):
    base = KnowledgeBase.from_text(text)
    for statement in list(statements_over(ground_terms(base.clauses)[:3]))[:12]:
        for attempt in (base.why_not(statement) or base.why_not("nothing")).attempts:
            if all(x.atom.indicator in BASE.items() and is_ground(x.atom) for x in attempt.failed):
                richer = KnowledgeBase.from_text(text)
                for literal in attempt.failed:
                    richer.fact(literal.atom)
                if richer.truth(statement) != "true":
                    doubt, rows = richer.why(statement), rows_of(richer)
                    check_doubt(doubt, richer, rows, rows | undefined_rows_of(richer))
                    assert doubt.back is None


@given(programs(circles=True))
def test_every_repair_makes_the_statement_valid(text):
    base = KnowledgeBase.from_text(text)
    for statement in list(statements_over(ground_terms(base.clauses)[:2]))[:6]:
        for repair in base.repair(statement):
            assert base.changed(repair).verify(statement).valid is True
            assert repair.size


HOME = """
human(ann). robot(tia). vessel(plate). plate(plate). vessel(mug). food(egg). broken(mug).
agent(X) :- human(X).
agent(X) :- robot(X).
eat(A, F, D) :- human(A), food(F), plate(D).
wash(A, V) :- agent(A), vessel(V), \\+ broken(V), V \\= cup.
"""


def home():
    return KnowledgeBase.from_text(HOME, "home.pl")


def test_a_proof_prints_as_a_tree_with_places():
    assert str(home().why("wash(tia, plate)")).split("\n") == [
        "wash(tia, plate)   [home.pl:6]",
        "├─ agent(tia)   [home.pl:4]",
        "│  └─ robot(tia)   [given]   [home.pl:2]",
        "├─ vessel(plate)   [given]   [home.pl:2]",
        "├─ \\+ broken(plate)   [not known]",
        "└─ plate \\= cup   [compared]",
    ]


def test_a_proof_is_json():
    data = home().why("agent(ann)").to_json()
    assert data == {
        "fact": "agent(ann)",
        "by": "rule",
        "place": "home.pl:3",
        "because": [{"fact": "human(ann)", "by": "fact", "place": "home.pl:2", "because": []}],
    }


def test_the_proof_of_something_unknown_is_that_of_its_first_instance():
    assert home().why("eat(X, Y, Z)").fact == Compound(("eat", "ann", "egg", "plate"))


def test_a_proof_may_be_longer_than_pythons_stack():
    edges = "".join(f"e({n},{n + 1}). " for n in range(400))
    base = KnowledgeBase.from_text(edges + "r(X,Y) :- e(X,Y). r(X,Y) :- e(X,Z), r(Z,Y).")
    proof = base.why("r(0, 400)")
    assert proof.height == 400
    assert str(proof).count("\n") == 2 * 400 - 1


def test_a_row_that_is_used_often_is_proved_once():
    rules = "".join(f"p{n + 1} :- p{n}, p{n}. " for n in range(60))
    assert KnowledgeBase.from_text(f"p0. {rules}").why("p60").height == 60


def test_a_circle_is_proved_from_outside():
    base = KnowledgeBase.from_text("e(1,2). e(2,1). r(X,Y) :- r(X,Z), r(Z,Y). r(X,Y) :- e(X,Y).")
    proof = base.why("r(1,1)")
    assert [premise.fact for premise in proof.premises] == [Compound(("r", 1, 2)), Compound(("r", 2, 1))]


def test_a_recursive_functor_has_a_proof():
    assert KnowledgeBase.from_text("nat(z). nat(s(X)) :- nat(X).").why("nat(s(s(z)))").height == 2


def test_validity_is_proved_by_the_statement_and_no_broken_constraint():
    base = KnowledgeBase.from_text('p(a). never("no b") :- claim(p(b)).')
    assert "no constraint is broken" in str(base.why("valid(p(a))"))


def test_a_broken_constraint_has_a_reason_too():
    assert "the facts break this constraint" in str(KnowledgeBase.from_text('p(a). never("no a") :- p(a).').why("never(S)"))


@pytest.mark.parametrize(
    ("statement", "reasons"),
    [
        ("eat(tia, egg, plate)", ["tia is not a human"]),
        ("eat(ann, mug, plate)", ["mug is not food"]),
        ("wash(ann, mug)", ["mug is broken"]),
        ("wash(ann, egg)", ["egg is not a vessel"]),
        ("agent(egg)", ["egg is not a human", "egg is not a robot"]),
        ("human(egg)", ["no fact or rule gives human(egg)"]),
        ("eat(A, mug, plate)", ["mug is not food"]),
        ("jump(ann)", ["there is no action jump/1 here"]),
        ("wahs(ann, mug)", ["there is no action wahs/2 here; did you mean wash?"]),
        ("eat(ann)", ["eat takes 3 arguments, not 1"]),
    ],
)
def test_a_refusal_says_in_words_what_is_missing(statement, reasons):
    assert list(home().why_not(statement).reasons) == reasons


def test_what_holds_is_not_refused():
    assert home().why_not("wash(tia, plate)") is None


def test_a_test_is_not_blamed_for_the_condition_that_should_have_bound_it():
    base = KnowledgeBase.from_text(":- dynamic(good/1). p :- good(X), X > 3.")
    assert base.why_not("p").reasons == ("nothing is good",)


def test_a_negation_is_not_blamed_before_its_part_is_known():
    base = KnowledgeBase.from_text(":- dynamic(good/1). bad(b). p :- \\+ bad(X), good(X).")
    assert base.why_not("p").reasons == ("nothing is good",)


def test_a_search_that_cannot_be_decided_is_not_blamed():
    base = KnowledgeBase.from_text("old(Y) :- Y > 3. age(bob, 5). p(X) :- age(X, Y), old(Y).")
    assert base.why_not("p(ann)").reasons == ("age(ann, Y) does not hold",)


def test_a_condition_is_blamed_under_the_bindings_that_come_nearest():
    base = KnowledgeBase.from_text("near(mug). near(jar). full(jar). hot(mug). ok :- near(X), full(X), hot(X), clean(X). clean(jar).")
    assert base.why_not("ok").reasons == ("jar is not hot",)


def test_where_the_nearest_is_too_far_the_first_failing_condition_is_named():
    pairs = "".join(f"e({n},{n + 1}). " for n in range(400))
    base = KnowledgeBase.from_text(f"{pairs} :- dynamic(z/1). p(W) :- e(_, _), e(_, _), z(W), e(_, _).")
    assert base.why_not("p(b)").reasons == ("b is not a z",)


def test_a_reason_that_is_not_found_within_the_budget_is_unknown_never_made_up():
    pairs = "".join(f"e({n},{n + 1}). " for n in range(600))
    base = KnowledgeBase.from_text(f"{pairs} :- dynamic(z/1). p(W) :- e(_, _), e(_, _), z(W).")
    assert base.why_not("p(b)", ()).reasons == (
        "the search for a reason stopped at its budget: which condition fails is unknown",
    )


@pytest.mark.parametrize(
    ("condition", "sentence"),
    [
        ("human(ann)", "ann is not a human"),
        ("\\+ broken(mug)", "mug is broken"),
        ("agent(egg)", "egg is not an agent"),
        ("washable(egg)", "egg is not washable"),
        ("table(egg)", "egg is not a table"),
        ("open(egg)", "egg is not open"),
        ("biscuits(egg)", "egg is not biscuits"),
        ("glass(egg)", "egg is not a glass"),
        ("vessel(_)", "nothing is a vessel"),
        ("near(a, b)", "near(a, b) does not hold"),
        ("\\+ near(a, b)", "near(a, b) holds"),
        ("a = b", "a is not b"),
        ("a \\= a", "both are a"),
        ("\\+ a = a", "both are a"),
        ("2 > 3", "2 > 3 does not hold"),
        ("\\+ 4 > 3", "4 > 3 holds"),
        ("rain", "rain does not hold"),
    ],
)
def test_a_failing_condition_is_worded(condition, sentence):
    ((literal,),) = read_query(condition)
    assert failure_sentence(literal) == sentence


def test_a_name_of_several_words_is_read_as_words():
    assert noun_phrase("water_bottle") == "a water bottle"


def test_a_shown_variable_has_the_authors_name():
    ((literal,),) = read_query("near(Who, b)")
    assert isinstance(literal, Literal)
    assert failure_sentence(literal) == "near(Who, b) does not hold"
