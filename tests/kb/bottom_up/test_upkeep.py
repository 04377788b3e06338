"""Facts that come and go: the rows in step with a fresh start, overlays that leave the base alone, columns like rows."""

from __future__ import annotations

from contextlib import nullcontext, suppress
from itertools import islice

import pytest
from hypothesis import given
from hypothesis import strategies as st
from programs import BASE, DERIVED, atoms_of, programs, undefined_of

from casper.kb.base import KnowledgeBase
from casper.kb.bottom_up import materialise as fixpoints
from casper.kb.bottom_up.columnar_fixpoint import columnar_fixpoint
from casper.kb.bottom_up.row_fixpoint import row_fixpoint
from casper.kb.bottom_up.specification import naive_fixpoint
from casper.kb.errors import BudgetExceeded, ProgramError, Undefined
from casper.kb.program.program import analyse
from casper.kb.store import model
from casper.kb.terms.terms import Compound
from casper.kb.text.reader import read_text

raises = pytest.raises
VALUES = ("a", "b", 1, 2)


@st.composite
def plain_programs(draw, circles: bool = False) -> str:
    """Rules of variables and constants only: recursion, strata (or circles) of negation, (dis)equality."""
    lines = [f":- dynamic({name}/{arity})." for name, arity in {**BASE, **DERIVED}.items()]
    for name, arity in BASE.items():
        rows = draw(st.lists(st.tuples(*[st.sampled_from(VALUES)] * arity), max_size=6))
        lines += [f"{name}({', '.join(map(str, row))})." for row in rows]
    order = [*BASE, *DERIVED]
    for name in DERIVED:
        for _ in range(draw(st.integers(0, 2))):
            usable = order[: order.index(name) + 1]
            below = list(DERIVED) if circles else order[: order.index(name)]
            terms = st.sampled_from(["X", "Y", "Z", "X", "Y", "a", "1"])
            body = [atom(draw, draw(st.sampled_from(usable)), terms) for _ in range(draw(st.integers(1, 3)))]
            known = [v for v in "XYZ" if any(v in part for part in body)] or ["a"]
            values = st.sampled_from([*known, "b"])
            if draw(st.booleans()):
                operator = draw(st.sampled_from(["=", "\\="]))
                body.append(f"{draw(values)} {operator} {draw(values)}")
            if draw(st.booleans()):
                tested = st.sampled_from([*known, "a", "_"])
                body.append("\\+ " + atom(draw, draw(st.sampled_from(below)), tested))
            lines.append(f"{atom(draw, name, st.sampled_from([*known, 'b']))} :- {', '.join(draw(st.permutations(body)))}.")
    return "\n".join(lines)


def atom(draw, name, terms) -> str:
    arity = {**BASE, **DERIVED}[name]
    return f"{name}({', '.join(draw(terms) for _ in range(arity))})"


@st.composite
def changes(draw) -> list[tuple[str, tuple]]:
    """Base facts that come and go, of stated and of derived predicates."""
    found = []
    for _ in range(draw(st.integers(1, 8))):
        name = draw(st.sampled_from([*BASE, *BASE, *DERIVED]))
        row = draw(st.tuples(*[st.sampled_from(VALUES)] * {**BASE, **DERIVED}[name]))
        found.append((draw(st.sampled_from(["assert", "retract"])), (name, *row)))
    return found


def apply(base: KnowledgeBase, change) -> None:
    verb, fact = change
    (base.assert_ if verb == "assert" else base.retract)(fact)


def atoms(base: KnowledgeBase) -> set:
    """The atoms that hold."""
    return atoms_of({i: base.stored(i) for i in {**BASE, **DERIVED}.items()})


def meaning(base: KnowledgeBase) -> tuple[set, set]:
    """The atoms that hold, and those that are undefined."""
    return atoms(base), undefined_of({i: base.stored(i) for i in {**BASE, **DERIVED}.items()})


def fresh(base: KnowledgeBase) -> tuple[set, set]:
    return meaning(KnowledgeBase(base.clauses, [*BASE.items(), *DERIVED.items()]))


def ruled(*rules: str) -> KnowledgeBase:
    base = KnowledgeBase()
    for rule in rules:
        base.rule(rule)
    return base


def program_of(text):
    base = KnowledgeBase()
    base.add(read_text(text))
    return analyse(base.clauses, base._stated.dynamic)


@given(plain_programs(circles=True))
def test_the_fixpoint_on_columns_is_that_on_rows(text):
    program = program_of(text)
    found = columnar_fixpoint(program, 10**6)
    if found is None:  # a wildcard within a circle of negation
        assert program.circular
        return
    naive = naive_fixpoint(program)
    assert (atoms_of(found), undefined_of(found)) == (atoms_of(naive), undefined_of(naive))
    rows = row_fixpoint(program)
    for indicator, relation in found.items():
        assert len(relation) == len(rows[indicator])
        assert all(row in relation for row in rows[indicator])


@given(plain_programs())
def test_rows_appear_in_the_same_round_on_columns_where_there_is_one_stratum(text):
    program = program_of(text)
    if len(program.strata) == 1:
        found, rows = columnar_fixpoint(program, 10**6), row_fixpoint(program)
        for indicator, relation in found.items():
            assert relation.rows == rows[indicator].rows


@given(programs(circles=True), changes())
def test_after_every_change_the_rows_are_those_of_a_fresh_start(text, sequence):
    base = KnowledgeBase.from_text(text)
    for change in sequence:
        apply(base, change)
        assert meaning(base) == fresh(base)


@given(plain_programs(circles=True), changes())
def test_changes_on_columns_end_in_a_fresh_start_too(text, sequence):
    before, fixpoints.COLUMNS_FROM = fixpoints.COLUMNS_FROM, 0
    try:
        base = KnowledgeBase.from_text(text)
        for change in sequence:
            apply(base, change)
        assert meaning(base) == fresh(base)
    finally:
        fixpoints.COLUMNS_FROM = before


@given(programs(circles=True), changes(), changes())
def test_an_assumption_is_a_fresh_start_with_the_changes_and_leaves_the_base_alone(text, first, then):
    base = KnowledgeBase.from_text(text)
    for change in first:
        apply(base, change)
    before, clauses = meaning(base), base.clauses
    supposed = base.assume()
    for change in then:
        apply(supposed, change)
    assert meaning(supposed) == fresh(supposed)
    assert (meaning(base), base.clauses) == (before, clauses)
    assert meaning(base) == fresh(base)


@given(programs(circles=True), changes())
def test_ask_the_goal_and_the_rows_agree_after_changes(text, sequence):
    from kanren import run, var

    base = KnowledgeBase.from_text(text)
    for change in sequence:
        with suppress(Undefined):
            base.ask(change[1])  # an answer remembered from before must not survive the change
        apply(base, change)
    for name, arity in {**BASE, **DERIVED}.items():
        relation = base.stored((name, arity))
        rows, undefined = set(relation), set(relation.undefined or ())
        free = tuple(var() for _ in range(arity))
        with raises(Undefined) if undefined else nullcontext():
            assert set(run(0, free, base.predicate(name)(*free))) == rows
        assert set(islice(base.rows(name, arity), len(rows))) == rows
        assert set(run(len(rows), free, base.predicate(name)(*free)) if rows else ()) == rows
        for row in [*rows, *undefined, ("a",) * arity]:
            expected = "true" if row in rows else "undefined" if row in undefined else "false"
            assert base.truth((name, *row)) == expected
            with raises(Undefined) if expected == "undefined" else nullcontext():
                assert base.ask((name, *row)) == (row in rows)


@given(programs(circles=True), changes())
def test_every_row_has_a_proof_after_changes(text, sequence):
    base = KnowledgeBase.from_text(text)
    for change in sequence:
        apply(base, change)
    for fact in atoms(base):
        assert base.why(fact) is not None


@given(programs(circles=True), changes())
def test_every_row_of_a_large_base_has_a_proof_after_changes(text, sequence):
    before, model.MOST_EXACT = model.MOST_EXACT, 0  # rounds are then what the changes left
    try:
        base = KnowledgeBase.from_text(text)
        for change in sequence:
            apply(base, change)
        for fact in atoms(base):
            assert base.why(fact).height >= 0
    finally:
        model.MOST_EXACT = before


def least_heights(base: KnowledgeBase) -> dict:
    """By brute force: every instance of every clause, again and again."""
    from casper.kb.terms.unification import substitute
    from casper.kb.top_down.solve import Solver

    relations = base._model.relations
    steps = []
    for clause in base.clauses:
        for solution in Solver(relations, {}).solve(clause.body):
            premises = [substitute(x.atom, solution) for x in clause.body if not (x.negated or x.is_comparison)]
            steps.append((substitute(clause.head, solution), premises, 1 if clause.body else 0))
    heights: dict = {}
    while True:
        before = dict(heights)
        for head, premises, cost in steps:
            if all(p in heights for p in premises):
                height = cost + max((heights[p] for p in premises), default=0)
                heights[head] = min(height, heights.get(head, height))
        if heights == before:
            return heights


@given(programs(circles=True), changes())
def test_a_proof_has_the_least_height_there_is_also_after_changes(text, sequence):
    base = KnowledgeBase.from_text(text)
    for change in sequence:
        apply(base, change)
    heights = least_heights(base)
    for fact in atoms(base):
        assert base.why(fact).height == heights[fact]


def test_a_proof_is_a_graph_and_json_however_deep_it_is():
    rules = " ".join(f"p{i} :- p{i - 1}, p{i - 1}." for i in range(1, 1500))
    proof = KnowledgeBase.from_text(f"p0. {rules}").why("p1499")
    graph = proof.to_networkx()
    assert (len(graph), graph.nodes[0]["text"], graph.nodes[0]["by"]) == (1500, "p1499", "rule")
    assert proof.to_json()["because"][1]["fact"] == "p1498"


def test_a_fact_given_twice_is_given_once():
    base = KnowledgeBase.from_text("food(tea).")
    assert not base.assert_("food(tea)")
    assert base.retract("food(tea)")
    assert not base.ask("food(tea)")


def test_what_still_follows_from_something_else_stays():
    base = KnowledgeBase.from_text("hot(X) :- boiled(X). hot(X) :- baked(X). boiled(pie). baked(pie).")
    base.retract("boiled(pie)")
    assert base.ask("hot(pie)")
    assert "baked(pie)" in str(base.why("hot(pie)"))


def test_a_loop_does_not_keep_itself_alive():
    base = KnowledgeBase.from_text("on(X) :- wired(Y, X), on(Y). on(X) :- plug(X). plug(a). wired(a, b). wired(b, a).")
    base.retract("plug(a)")
    assert list(base.query("on(X)")) == []


def test_a_derived_fact_is_not_a_given_one_and_cannot_be_retracted():
    base = KnowledgeBase.from_text("agent(X) :- human(X). human(ann).")
    assert not base.retract("agent(ann)")
    assert base.ask("agent(ann)")


def test_a_new_predicate_can_be_asserted():
    base = KnowledgeBase.from_text("human(ann).")
    assert base.assert_("tired(ann)")
    assert base.ask("tired(ann)")


def test_only_ground_facts_can_be_changed():
    with pytest.raises(ProgramError, match="has a variable"):
        KnowledgeBase.from_text("human(ann).").assert_("human(X)")


def test_a_constraint_is_judged_anew_after_a_change():
    base = KnowledgeBase.from_text('never("both") :- food(X), vessel(X). food(a). vessel(b). eat(X) :- food(X).')
    assert base.verify("eat(a)").valid
    base.assert_("vessel(a)")
    assert base.verify("eat(a)").reasons == ("both",)
    base.retract("vessel(a)")
    assert base.verify("eat(a)").valid


def test_a_large_removal_is_recomputed_and_right(monkeypatch):
    from casper.kb.bottom_up import incremental

    monkeypatch.setattr(incremental, "LEAST_TO_RECOMPUTE", 10)
    base = ruled("path(X, Y) :- edge(X, Y).", "path(X, Y) :- path(X, Z), edge(Z, Y).")
    base.facts("edge", [(i, (i + 1) % 20) for i in range(20)])
    assert len(list(base.rows("path", 2))) == 400
    assert not base.depends_on_history  # worked out before, and not in the way of working out anew
    base.retract(("edge", 19, 0))
    assert len(list(base.rows("path", 2))) == 190


def test_bulk_facts_are_facts_like_others():
    base = ruled("path(X, Y) :- edge(X, Y)", "path(X, Y) :- path(X, Z), edge(Z, Y)")
    base.facts("edge", [("a", "b"), ("b", "c")])
    assert base.ask("path(a, c)")
    assert "edge(b, c)" in str(base.why("path(a, c)"))
    assert KnowledgeBase.from_text(base.to_text()).ask("path(a, c)")
    assert base.retract(("edge", "b", "c"))
    assert not base.ask("path(a, c)")


@pytest.mark.parametrize("rows", [[("a",), ("b", "c")], [(Compound(("f", "a")),), ()]])
def test_bulk_rows_of_different_lengths_are_refused(rows):
    with pytest.raises(ProgramError, match="columns"):
        KnowledgeBase().facts("p", rows)


def test_a_large_base_goes_to_columns_and_answers_without_decoding():
    base = ruled("path(X, Y) :- edge(X, Y).", "path(X, Y) :- path(X, Z), edge(Z, Y).")
    base.facts("edge", [(i, i + 1) for i in range(fixpoints.COLUMNS_FROM)])
    relation = base.stored(("path", 2))
    count = fixpoints.COLUMNS_FROM
    assert len(relation) == count * (count + 1) // 2
    assert base.ask(("path", 0, count)) and not base.ask(("path", count, 0)) and not base.ask(("path", 0, "nowhere"))
    assert relation._table is not None


def test_a_program_that_derives_too_much_is_stopped(monkeypatch):
    base = ruled("pair(X, Y) :- n(X), n(Y).")
    base.facts("n", [(i,) for i in range(3000)])
    monkeypatch.setattr(fixpoints.materialise, "__defaults__", (10_000,))
    with pytest.raises(BudgetExceeded, match="pair/2 has most of them"):
        base.compile()


def test_a_query_can_be_bounded_in_time_and_cancelled():
    base = KnowledgeBase.from_text("n(z). n(s(X)) :- n(X). loop(X) :- loop(X).")
    with pytest.raises(BudgetExceeded, match="steps"):
        list(base.query("n(X), X = never", budget=100))
    with pytest.raises(BudgetExceeded, match="cancelled"):
        list(base.query("n(X), n(Y), X = Y, X = never", cancelled=lambda: True))
    with pytest.raises(BudgetExceeded, match="time was up"):
        list(base.query("n(X), n(Y), X = Y, X = never", timeout=0.0))


@given(programs(negation=False), st.sampled_from([("d0", "a"), ("d1", "a", 1), ("d2", "b"), ("d4", 1)]))
def test_a_repair_really_repairs_and_no_smaller_one_is_known(text, statement):
    base = KnowledgeBase.from_text(text)
    found = base.repair(statement)
    for repair in found:
        assert base.changed(repair).ask(statement)
        assert repair.size == found[0].size
        for fact in repair.add:
            assert not base.changed(type(repair)(repair.add - {fact}, repair.remove)).ask(statement)


def test_a_repair_respects_the_constraints():
    text = 'human(ann). robot(tia). eat(X) :- human(X). never("one or the other") :- human(X), robot(X).'
    (repair,) = KnowledgeBase.from_text(text).repair("eat(tia)")
    assert repair.to_json() == {"add": ["human(tia)"], "remove": ["robot(tia)"]}


COUNTS = """
:- dynamic([works/2, room/1, pay/2, boss/2]).
n(R, N) :- room(R), aggregate_all(count, works(_, R), N).
paid(R, S) :- room(R), aggregate_all(sum(P), (works(X, R), pay(X, P)), S).
most(M) :- aggregate_all(max(N, R), n(R, N), M).
crowded(R) :- n(R, N), N > 1, \\+ boss(_, R).
above(X, Y) :- boss(X, Y).
above(X, Z) :- above(X, Y), boss(Y, Z), \\+ crowded(Z).
reach(X, C) :- boss(X, _), aggregate_all(count, above(X, _), C), \\+ room(X).
"""
names = st.sampled_from("abc")
counted = st.one_of(
    st.tuples(st.just("works"), names, names),
    st.tuples(st.just("room"), names),
    st.tuples(st.just("pay"), names, st.sampled_from([1, 2, "much"])),
    st.tuples(st.just("boss"), names, names),
)


@given(st.lists(counted, max_size=8), st.lists(st.tuples(st.booleans(), counted), max_size=8))
def test_counts_and_sums_in_step_with_changes_are_those_of_a_fresh_start(first, later):
    base = KnowledgeBase.from_text(COUNTS)
    for fact in first:
        base.assert_(fact)
    for comes, fact in later:
        base.assert_(fact) if comes else base.retract(fact)
        fresh = KnowledgeBase.from_text(base.to_text())
        assert atoms_of(base._model.relations) == atoms_of(fresh._model.relations)
        assert undefined_of(base._model.relations) == undefined_of(fresh._model.relations)


def test_a_change_of_one_group_looks_at_that_group_alone():
    base = KnowledgeBase.from_text(":- dynamic([works/2, room/1]). n(R, N) :- room(R), aggregate_all(count, works(_, R), N).")
    base.facts("room", [(at,) for at in range(1_000)])
    base.facts("works", [(who, at) for at in range(1_000) for who in "xyz"])
    assert base.assert_(("works", "w", 7)) and base.retract(("works", "x", 8))
    relations = base._model.relations
    before = sum(relation.touched for relation in relations.values())
    assert base.assert_(("works", "w", 17)) and base.retract(("works", "x", 18))
    assert sum(relation.touched for relation in relations.values()) - before < 50
    assert base.ask("n(17, 4)") and base.ask("n(18, 2)") and not base.ask("n(18, 3)")
