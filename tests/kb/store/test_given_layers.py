"""Base facts laid over others, against plain dicts: what is below stays as it is."""

from hypothesis import given
from hypothesis import strategies as st

from casper.kb.base import KnowledgeBase
from casper.kb.relations.layered import LayeredRelation
from casper.kb.relations.relation import Relation
from casper.kb.store.layers import GivenLayer, Layers

row = st.tuples(st.integers(0, 2), st.integers(0, 2))
changes = st.lists(st.tuples(st.booleans(), row), max_size=12)


@given(st.dictionaries(row, st.none()), changes)
def test_given_facts_in_a_layer_are_those_of_a_dict_with_the_same_changes(below, made):
    before = dict(below)
    layer, expected = GivenLayer(below), dict(below)
    for adds, changed in made:
        if adds:
            layer[changed] = expected[changed] = "clause"
        elif changed in expected:
            del layer[changed], expected[changed]
    assert dict(layer.items()) == expected
    assert len(layer) == len(expected)
    assert all((r in layer) == (r in expected) for r in [(a, b) for a in range(3) for b in range(3)])
    assert below == before


def test_what_was_taken_away_in_a_layer_is_not_there():
    layer = GivenLayer({("a",): None, ("b",): None})
    del layer[("a",)]
    assert list(layer) == [("b",)] and len(layer) == 1
    assert layer.get(("a",), "gone") == "gone"
    layer[("a",)] = "back"
    assert layer[("a",)] == "back" and list(layer) == [("b",), ("a",)]


def test_each_predicate_has_a_layer_of_its_own_as_soon_as_it_is_looked_at():
    below = {("p", 1): Relation("p", 1, [("a",)]), ("q", 1): Relation("q", 1)}
    layers = Layers(below, LayeredRelation)
    assert ("p", 1) in layers and ("r", 1) not in layers
    assert list(layers) == [("p", 1), ("q", 1)] and len(layers) == 2
    layers["p", 1].add(("b",))
    assert list(layers["p", 1]) == [("a",), ("b",)] and list(below["p", 1]) == [("a",)]
    assert layers.get(("q", 1)) is layers["q", 1] and layers.get(("r", 1), "none") == "none"
    assert [len(relation) for relation in layers.values()] == [2, 0]


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


def test_facts_come_and_go_in_an_assumption_without_touching_the_base():
    kb = KnowledgeBase.from_text("human(ann). agent(X) :- human(X). lonely :- \\+ human(bob).")
    other = kb.assume("human(bob)")
    assert other.assert_("human(eve)") and not other.assert_("human(ann)")
    assert other.retract("human(ann)") and not other.retract("human(ann)")
    assert {answer["X"] for answer in other.query("agent(X)")} == {"bob", "eve"}
    assert not other.ask("lonely") and kb.ask("lonely")
    assert [answer["X"] for answer in kb.query("agent(X)")] == ["ann"]
