"""Questions on stored rows alone are looked up as the machine would answer them, planned once for each shape."""

from hypothesis import given
from hypothesis import strategies as st

from casper.kb.base import KnowledgeBase
from casper.kb.relations.relation import Relation
from casper.kb.relations.undefined import UndefinedRows
from casper.kb.terms.clauses import Literal
from casper.kb.terms.terms import Compound, Variable
from casper.kb.terms.unification import substitute
from casper.kb.text.reader import read_query
from casper.kb.top_down.answering import Answering
from casper.kb.top_down.lookups import Lookups, shape_of
from casper.kb.top_down.search import Search
from casper.kb.top_down.solve import Solver

ROWS = st.lists(st.tuples(st.integers(0, 3), st.integers(0, 3)), max_size=8)
PARTS = st.sampled_from(["X", "Y", "Z", "_", "0", "1", "2", "f(1)"])
CONDITIONS = st.builds("{}({}, {})".format, st.sampled_from("rs"), PARTS, PARTS)
BODIES = st.lists(CONDITIONS, min_size=1, max_size=3).map(", ".join)
GIVEN = st.dictionaries(st.sampled_from("XYZ").map(Variable), st.sampled_from([0, 1, 2, Variable("Z"), Variable("W")]))


def stored(some, others):
    return {("r", 2): Relation("r", 2, some), ("s", 2): Relation("s", 2, others)}


def looking_up(relations, lookups=None):
    return Answering(relations, {}, lookups=lookups or Lookups(relations))


def values(solutions, body):
    names = [v for literal in body for v in literal.variables()]
    return [[substitute(name, solution) for name in names] for solution in solutions]


@given(ROWS, ROWS, BODIES)
def test_they_give_the_machines_answers_in_its_order(some, others, goal):
    relations = stored(some, others)
    (body,) = read_query(goal)
    expected = values(Solver(relations, {}).solve(body), body)
    assert shape_of(body, {}) is not None
    assert values(looking_up(relations).possible(body), body) == expected
    assert values(Search(relations, {}).solve(body), body) == expected
    names = list(dict.fromkeys(v for literal in body for v in literal.variables()))[::-1]
    rows = [[row[names.index(v)] for literal in body for v in literal.variables()] for row, _ in looking_up(relations).rows(body, names)]
    assert rows == expected


@given(ROWS, ROWS, BODIES, GIVEN)
def test_what_is_known_before_narrows_them(some, others, goal, known):
    known = {v: value for v, value in known.items() if v is not value and value != v}
    relations = stored(some, others)
    (body,) = read_query(goal)
    found, expected = list(looking_up(relations).possible(body, known)), list(Solver(relations, {}).possible(body, known))
    assert values(found, body) == values(expected, body)
    assert all(known.items() <= solution.items() for solution in found)


@given(ROWS, ROWS, st.lists(BODIES, min_size=2, max_size=5), st.tuples(st.integers(0, 3), st.integers(0, 3)))
def test_a_plan_serves_every_question_of_its_shape_while_rows_come_and_go(some, others, goals, row):
    relations = stored(some, others)
    lookups = Lookups(relations)
    for _ in range(2):
        for goal in goals:
            (body,) = read_query(goal)
            found = values(looking_up(relations, lookups).possible(body), body)
            assert found == values(Solver(relations, {}).solve(body), body)
        for relation in relations.values():
            relation.remove(row) or relation.add(row)
    shapes = {shape_of(read_query(goal)[0], {})[0] for goal in goals}
    assert set(lookups.plans) == shapes


def test_the_constants_of_a_question_are_no_part_of_its_shape():
    shapes = [shape_of(read_query(goal)[0], {})[0] for goal in ("r(a, X), s(X, Y)", "r(1, A), s(A, B)", "r(A, 1), s(A, B)")]
    assert shapes[0] == shapes[1] != shapes[2]


def test_what_is_no_look_up_is_left_to_the_machine():
    lookups = Lookups(stored([], []))
    for goal in ("r(X, Y), X = 1", "r(X, Y), t(Y)", "aggregate_all(count, r(1, 1), X)"):
        asked = shape_of(read_query(goal)[0], {})
        assert asked is None or lookups.of(asked[0]) is None
    assert shape_of(read_query("r(X, _), \\+ s(X, X)")[0], {}) is None
    assert shape_of([Literal(Compound(("r", 1, Compound(("f", Variable("X"))))))], {}) is None


def test_a_relation_that_gets_undefined_rows_is_no_longer_looked_up():
    relations = stored([(1, 2)], [])
    lookups = Lookups(relations)
    shape = shape_of(read_query("r(X, Y)")[0], {})[0]
    assert lookups.of(shape) is not None
    relations["r", 2].undefined = UndefinedRows("r", 2, [(3, 3)])
    assert lookups.of(shape) is None
    relations["r", 2].undefined = None
    assert lookups.of(shape) is not None


def test_questions_of_one_shape_are_planned_once_and_follow_the_changes():
    base = KnowledgeBase.from_text("p(X, Y) :- q(X, Y). q(a, b). q(c, d).")
    assert [list(base.query(f"p({x}, Y)")) for x in "ac"] == [[{"Y": "b"}], [{"Y": "d"}]]
    assert base.assert_("q(a, e)") and list(base.query("p(a, Y)")) == [{"Y": "b"}, {"Y": "e"}]
    assert base.retract("q(a, b)") and list(base.query("p(a, Y)")) == [{"Y": "e"}]
    assert len(base.solver().lookups.plans) == 1
