"""Relations and base facts laid over others, against plain sets and dicts: what is below stays as it is."""

from hypothesis import given
from hypothesis import strategies as st

from casper.kb.base import KnowledgeBase
from casper.kb.relations.layered import LayeredRelation
from casper.kb.relations.relation import Relation
from casper.kb.store.model import _GivenLayer

row = st.tuples(st.integers(0, 2), st.integers(0, 2))
changes = st.lists(st.tuples(st.booleans(), row), max_size=12)


@given(st.lists(row, unique=True), changes, st.sampled_from([(), (0,), (1,), (0, 1)]), row)
def test_a_layer_holds_what_a_set_with_the_same_changes_holds(below, made, columns, pattern):
    base = Relation("r", 2, below)
    layer, expected = LayeredRelation(base), set(below)
    for adds, changed in made:
        assert (layer.add(changed, 7) if adds else layer.remove(changed)) is ((changed in expected) != adds)
        (expected.add if adds else expected.discard)(changed)
    assert list(base) == below
    assert set(layer) == expected and len(list(layer)) == len(layer) == len(expected)
    assert all((r in layer) == (r in expected) for r in [(a, b) for a in range(3) for b in range(3)])
    key = tuple(pattern[c] for c in columns)
    assert sorted(layer.matching(columns, key)) == sorted(r for r in expected if tuple(r[c] for c in columns) == key)


@given(st.dictionaries(row, st.none()), changes)
def test_given_facts_in_a_layer_are_those_of_a_dict_with_the_same_changes(below, made):
    before = dict(below)
    layer, expected = _GivenLayer(below), dict(below)
    for adds, changed in made:
        if adds:
            layer[changed] = expected[changed] = "clause"
        elif changed in expected:
            del layer[changed], expected[changed]
    assert dict(layer.items()) == expected
    assert len(layer) == len(expected)
    assert all((r in layer) == (r in expected) for r in [(a, b) for a in range(3) for b in range(3)])
    assert below == before


def test_a_row_that_comes_back_belongs_to_the_layer_with_its_new_round():
    base = Relation("r", 1)
    base.add(("a",), 2)
    layer = LayeredRelation(base)
    assert layer.round_of(("a",)) == 2
    layer.remove(("a",))
    layer.add(("a",), 9)
    assert layer.round_of(("a",)) == 9
    assert base.round_of(("a",)) == 2
    assert list(layer) == [("a",)]


def test_what_is_assumed_is_seen_by_who_assumes_it_only():
    kb = KnowledgeBase.from_text("human(ann). human(bob). agent(X) :- human(X). quiet :- \\+ agent(eve).")
    other = kb.assume("human(eve)", without=["human(ann)"])
    assert [answer["X"] for answer in other.query("agent(X)")] == ["bob", "eve"]
    assert [answer["X"] for answer in kb.query("agent(X)")] == ["ann", "bob"]
    assert not other.ask("quiet") and kb.ask("quiet")
    assert [str(c.head) for c in other.clauses_of(("human", 1))] == ["human(bob)", "human(eve)"]


def test_an_assumption_upon_an_assumption_sees_both():
    kb = KnowledgeBase.from_text("human(ann). agent(X) :- human(X).")
    upper = kb.assume("human(bob)").assume("human(eve)", without=["human(ann)"])
    assert {answer["X"] for answer in upper.query("agent(X)")} == {"bob", "eve"}
    assert upper.why("agent(bob)") is not None
    assert upper.why("agent(ann)") is None
