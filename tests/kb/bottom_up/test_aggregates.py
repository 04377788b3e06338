"""Aggregates and goals inside goals: what they mean, against SWI-Prolog on random programs, and their reasons."""

from __future__ import annotations

import networkx as nx
import pytest
from hypothesis import given
from hypothesis import strategies as st
from programs import match, put
from sums import DERIVED, GIVEN, base_of, random_program
from sums import compare as compare_with_swi
from swi import MANY, needs_swi

from casper.kb.base import KnowledgeBase
from casper.kb.bottom_up.materialise import materialise
from casper.kb.bottom_up.specification import naive_fixpoint
from casper.kb.errors import BudgetExceeded, ProgramError, Undefined
from casper.kb.terms.comparison import compare
from casper.kb.terms.terms import Compound, make_list
from casper.kb.terms.unknown import has_unknown
from casper.kb.terms.values.arithmetic import evaluate
from casper.kb.terms.values.ordering import standard_key
from casper.kb.text.reader import read_text


@needs_swi
def test_random_aggregates_lists_and_sums_mean_what_swi_prolog_says(tmp_path):
    tally = compare_with_swi(MANY // 2, 7, tmp_path)
    assert tally.disagreements == []
    assert tally.equal > tally.asked / 2


@given(st.randoms(use_true_random=False))
def test_counting_equals_the_naive_fixpoint_and_survives_changes(rng):
    base = base_of(random_program(rng))
    program = base._model.program
    for relations in (materialise(program), base._model.relations):
        naive = naive_fixpoint(program)
        for indicator, relation in naive.items():
            assert set(relation) == set(relations[indicator])
            assert set(relation.undefined or ()) == set(relations[indicator].undefined or ())
    for _ in range(4):
        change = rng.choice([base.assert_, base.retract])
        change(("b", rng.randrange(3)) if rng.random() < 0.3 else ("e", rng.randrange(3), rng.randrange(3)))
        again = KnowledgeBase(base.clauses, [*DERIVED.items(), *GIVEN.items()])
        for indicator in DERIVED.items():
            assert set(base.stored(indicator)) == set(again.stored(indicator))
            assert set(base.stored(indicator).undefined or ()) == set(again.stored(indicator).undefined or ())
            for row in base.stored(indicator):
                assert base.why((indicator[0], *row)).fact[1:] == row


@given(st.randoms(use_true_random=False))
def test_a_program_with_goals_inside_goals_prints_as_text_that_means_the_same(rng):
    base = base_of(random_program(rng))
    again = KnowledgeBase.from_text(base.to_text())
    assert again.to_text() == base.to_text()
    assert all(set(again.stored(i)) == set(base.stored(i)) for i in DERIVED.items())


@given(st.randoms(use_true_random=False))
def test_whatever_is_undefined_leads_to_a_circle_or_to_what_has_no_value(rng):
    program = random_program(rng)
    base = base_of([*program, rng.choice(["b(ann).", "e(1, ann).", "e(ann, 1).", "b(0)."])])
    rules = {rule for found in base._model.program.rules.values() for rule in found}
    for indicator in DERIVED.items():
        for row in base.stored(indicator).undefined or ():
            atom = Compound((indicator[0], *row))
            doubt = base.why(atom)
            if doubt is None or not doubt.steps:
                assert has_unknown(atom)  # asked for an unknown value, any will do
                continue
            last = doubt.steps[-1]
            assert doubt.steps[0].fact == doubt.fact and (doubt.back is None) == bool(last.failure)
            for step, other in zip(doubt.steps, doubt.steps[1:]):
                assert step.needs == other.fact
            for step in doubt.steps:
                assert step.clause in rules and step.literal in step.body
            assert base.truth(atom) == "undefined"
            assert base.verify(atom).reasons == (doubt.sentence,)


def test_what_rests_on_a_value_that_is_not_there_is_told_to_the_end():
    base = KnowledgeBase.from_text("n(0). half(X, Y) :- n(X), Y is 4 / X. ok(X) :- n(X), \\+ (half(X, Y), Y > 100).", "home.pl")
    assert base.why("ok(0)").sentence == (
        "ok(0) is undefined: it needs \\+ (half(0, Y), Y > 100), which needs half(0, ?), which needs ? is 4 / 0, "
        "and 4 / 0 has no value: division by zero (in half(0, ?) :- n(0), ? is 4 / 0 at home.pl:1)"
    )
    assert base.truth("half(0, 7)") == base.truth("half(0, X)") == "undefined"
    assert next(base.query("half(X, Y)", undefined=True))["X"] == 0


def worked_out(literal, base):
    """The value of an aggregate, from the rows of what it counts: independent of the knowledge base's own folding."""
    what, counted, _ = literal.atom[1:]
    found = [match(counted, Compound((counted[0], *row)), {}) for row in base.stored(counted.indicator)]
    found = [environment for environment in found if environment is not None]
    if what == "count":
        return len(found)
    values = [put(what[1], environment) for environment in found]
    if what[0] in ("bag", "set"):
        values = sorted(values if what[0] == "bag" else set(values), key=standard_key)
        return make_list(values)
    numbers = [evaluate(value) for value in values]
    if what[0] == "sum":
        return sum(numbers)
    best = (min if what[0] == "min" else max)(numbers)
    if len(what) == 2:
        return best
    witnesses = [put(what[2], environment) for environment, number in zip(found, numbers) if number == best]
    return Compound((what[0], best, min(witnesses, key=standard_key)))


def check(proof, base, rules):
    """Refuse anything that is not a proof: each node a fact, an instance of its rule, or true by itself."""
    literal = proof.literal
    if proof.clause is None:
        assert not proof.premises
        if literal.is_aggregate:
            assert worked_out(literal, base) == literal.atom[3]
        elif literal.negated and not literal.is_comparison:
            relation = base.stored(literal.atom.indicator)
            everything = [*relation, *(relation.undefined or ())]
            assert all(match(literal.atom, Compound((literal.atom[0], *row)), {}) is None for row in everything)
        else:
            assert compare(literal, {}) is not None
        return
    if not proof.clause.body:
        assert proof.fact.args in base._model.given[proof.fact.indicator]
        return
    assert proof.clause in rules and len(proof.premises) == len(proof.clause.body)
    environment = match(proof.clause.head, proof.fact, {})
    for condition, premise in zip(proof.clause.body, proof.premises):
        assert condition.negated == premise.literal.negated
        if not condition.is_strict and not condition.is_comparison:
            environment = match(condition.atom, premise.fact, environment)
            assert environment is not None
        check(premise, base, rules)


@given(st.randoms(use_true_random=False))
def test_every_proof_with_counts_and_sums_checks(rng):
    base = base_of(random_program(rng))
    rules = {rule for found in base._model.program.rules.values() for rule in found}
    for name, arity in DERIVED.items():
        for row in base.stored((name, arity)):
            check(base.why((name, *row)), base, rules)


@given(st.randoms(use_true_random=False))
def test_what_is_refused_is_refused_for_a_reason_that_holds(rng):
    base = base_of(random_program(rng))
    for name, arity in DERIVED.items():
        relation = base.stored((name, arity))
        for row in [(rng.choice([0, 1, 2]),) * arity for _ in range(3)]:
            refusal = base.why_not((name, *row))
            truth = base.truth((name, *row))
            assert (refusal is None) == (truth == "true") == (row in relation)
            assert refusal is None or bool(refusal.doubt) == (truth == "undefined")
            assert refusal is None or all(refusal.reasons)


HELPERS = """
helper(ann). helper(bob). helper(eve). room(kitchen). works(ann, kitchen). works(bob, kitchen).
crowded(R) :- room(R), aggregate_all(count, works(_, R), N), N > 1.
calm(R) :- room(R), aggregate_all(count, helper(X), N), N =< 2.
"""


def test_a_count_is_told_with_what_was_counted():
    base = KnowledgeBase.from_text(HELPERS)
    assert base.why_not("calm(kitchen)").reasons == ("3 of at most 2 helpers: ann, bob, eve",)
    assert "aggregate_all(count, works(_, kitchen), 2)   [of ann, bob]" in str(base.why("crowded(kitchen)"))


def test_a_count_can_be_mended_by_what_was_counted():
    repairs = [str(repair) for repair in KnowledgeBase.from_text(HELPERS).repair("calm(kitchen)")]
    assert repairs == ["remove helper(ann)", "remove helper(bob)", "remove helper(eve)"]


def test_another_result_is_told():
    base = KnowledgeBase.from_text("p(1). p(5). total(N) :- aggregate_all(sum(X), p(X), N).")
    assert base.why_not("total(7)").reasons == ("aggregate_all(sum(X), p(X), N) gives 6, not 7",)


def test_a_count_for_something_unknown_is_refused_never_wrong():
    base = KnowledgeBase.from_text("p(a, 1). p(b, 2). n(X, N) :- aggregate_all(count, p(X, _), N).")
    assert base.ask("n(a, 1)") and not base.ask("n(c, 1)") and base.ask("n(c, 0)")
    with pytest.raises(ProgramError, match=r"aggregate_all\(count, p\(X, _\), N\) cannot be decided: bind its variables"):
        list(base.query("n(X, N)"))


def test_a_constraint_can_count():
    base = KnowledgeBase.from_text('never("two is company") :- claim(join(_)), aggregate_all(count, in(_), N), N >= 2.'
        " in(ann). in(bob). join(X) :- who(X). who(eve).")
    assert base.verify("join(eve)").reasons == ("two is company",)
    assert sorted(map(str, base.repair("join(eve)"))) == ["remove in(ann)", "remove in(bob)"]
    base.retract("in(ann)")
    assert base.verify("join(eve)").valid


def test_conditions_with_parts_inside_are_used_under_a_prefix(tmp_path):
    from casper.kb.text.namespace import prefixed

    text = "p(1). p(2). q(1). n(N) :- aggregate_all(count, (p(X), \\+ q(X)), N). none :- \\+ (p(X), X > 5). :- table(least(min)). least(X) :- p(X)."
    base = KnowledgeBase()
    base.add(prefixed(read_text(text), "other"))
    assert base.ask("other:n(1)") and base.ask("other:none") and list(base.rows("other:least", 1)) == [(1,)]


def test_least_and_greatest_of_nothing_fail_and_counts_do_not():
    base = KnowledgeBase.from_text(":- dynamic(p/1).")
    asked = {way: list(base.query(f"aggregate_all({way}, p(X), R)")) for way in ("count", "sum(X)", "min(X)", "max(X, X)", "bag(X)")}
    assert [[answer["R"] for answer in found] for found in asked.values()] == [[0], [0], [], [], ["[]"]]


def test_what_is_bound_before_groups_and_what_comes_later_is_another_variable():
    base = KnowledgeBase.from_text("p(a, 1). p(a, 2). p(b, 3). q(a). before(X, N) :- q(X), aggregate_all(count, p(X, _), N)."
        " after(N) :- aggregate_all(count, p(X, _), N), q(X).")
    assert list(base.rows("before", 2)) == [("a", 2)]
    assert list(base.rows("after", 1)) == [(3,)]


def test_an_aggregate_of_what_is_undefined_is_undefined():
    base = KnowledgeBase.from_text("m(a, b). m(b, a). w(X) :- m(X, Y), \\+ w(Y). n(N) :- aggregate_all(count, w(_), N).")
    assert [base.truth(f"n({n})") for n in (0, 1, 2)] == ["undefined"] * 3
    assert base.why("n(1)").back is not None


def test_a_sum_with_what_is_no_number_is_undefined_with_its_reason():
    base = KnowledgeBase.from_text("p(1). p(zz). n(N) :- aggregate_all(sum(X), p(X), N). c(N) :- aggregate_all(count, p(_), N).")
    assert (base.truth("n(1)"), base.truth("c(2)")) == ("undefined", "true")
    assert "zz is not a number" in base.why("n(1)").sentence


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("p(N) :- aggregate_all(count, p(_), N).", "aggregate_all is part of what it is worked out of: p/1 needs p/1; break the circle"),
        ("q(1). p(X) :- q(X), aggregate_all(count, (r(Y), Y > X), _). r(X) :- p(X).", "p/1 needs r/1 needs p/1"),
        ("q(1). p(N) :- aggregate_all(average(X), q(X), N).", "aggregate_all cannot work out average(X); write count"),
        ("q(1). p(N) :- aggregate_all(count, 3, N).", "aggregate_all needs a goal, not 3"),
        ("q(1). p(N) :- aggregate_all(count, (q(X), \\+ q(Y)), N).", "Y stands only under a negation"),
        ("q(1). p(N) :- findall(X, nothing(X), N).", "nothing defines nothing/1"),
        ("forall(1, 2).", "forall/2 is defined by the system"),
    ],
)  # fmt: skip
def test_an_aggregate_without_meaning_is_refused(text, sentence):
    with pytest.raises(ProgramError) as caught:
        KnowledgeBase.from_text(text)
    assert sentence in str(caught.value)


PATHS = """
:- table(path(_, _, min)).
path(X, Y, C) :- edge(X, Y, C).
path(X, Y, C) :- path(X, Z, A), edge(Z, Y, B), C is A + B.
"""


def paths(edges) -> KnowledgeBase:
    base = KnowledgeBase()
    base.add(read_text(PATHS + ":- dynamic(edge/3). near(X) :- path(1, X, C), C < 4."))
    base.facts("edge", edges)
    return base


edges = st.lists(st.tuples(st.integers(0, 4), st.integers(0, 4), st.integers(1, 9)), max_size=12)


def shortest(edges) -> set:
    graph = nx.MultiDiGraph()
    for start, end, cost in edges:
        graph.add_edge(start, end, cost=cost)
    lengths = dict(nx.all_pairs_dijkstra_path_length(graph, weight="cost"))
    back = {n: min([c + lengths[m].get(n, 99) for a, m, c in edges if a == n], default=99) for n in graph}
    found = {(a, b, c) for a, ways in lengths.items() for b, c in ways.items() if a != b}
    return found | {(n, n, c) for n, c in back.items() if c < 99}


@given(edges, edges)
def test_a_recursive_minimum_is_the_shortest_path_also_after_changes(first, more):
    base = paths(first)
    assert set(base.rows("path", 3)) == shortest(first)
    for edge in more:
        base.assert_(("edge", *edge))
    assert set(base.rows("path", 3)) == shortest([*first, *more])
    for edge in set(first):
        base.retract(("edge", *edge))
    rest = [edge for edge in set(more) if edge not in set(first)]
    assert set(base.rows("path", 3)) == shortest(rest)
    assert set(base.rows("near", 1)) == {(b,) for a, b, c in shortest(rest) if a == 1 and c < 4}
    for row in shortest(rest):
        assert base.why(("path", *row)).height >= 1


def test_a_minimum_that_improves_without_end_is_unknown():
    base = paths([(1, 2, 1), (2, 1, -3)])
    with pytest.raises(BudgetExceeded, match="the rows of path/3 improve without end"):
        base.compile()


def test_a_recursive_minimum_that_cannot_be_evaluated_is_undefined():
    base = paths([(1, 2, 1), (2, 3, "far")])
    with pytest.raises(Undefined):
        base.ask("path(1, 3, 4)")
    assert base.truth("near(3)") == "undefined"
    assert base.truth("near(2)") == "true"  # nothing that failed leads there


def test_a_recursive_minimum_goes_through_nothing_else():
    with pytest.raises(ProgramError, match=r"path/2 keeps one row for each key, so its circle may hold nothing else: path/2 and q/2"):
        KnowledgeBase.from_text(":- table(path(_, min)). e(1, 2). path(X, Y) :- e(X, Y). path(X, Y) :- q(X, Y). q(X, Y) :- path(X, Y).")


def test_tables_and_the_like_say_nothing_new():
    base = KnowledgeBase.from_text(":- table(p/1). :- discontiguous(p/1). :- dynamic((q/1, r/1)). p(1).")
    assert base.ask("p(1)") and base.defines("r", 1)
