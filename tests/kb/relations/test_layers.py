"""Relations laid over others, against plain sets: what is below stays as it is."""

from hypothesis import given
from hypothesis import strategies as st

from casper.kb.relations.layered import LayeredRelation
from casper.kb.relations.relation import Relation

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
