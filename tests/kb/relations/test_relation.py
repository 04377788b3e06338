"""Stored rows and their indexes."""

from hypothesis import given
from hypothesis import strategies as st

from casper.kb.relations.relation import Relation

rows = st.lists(st.tuples(*[st.integers(0, 4)] * 3), max_size=30)
patterns = st.lists(st.sampled_from([0, 1, 2]), unique=True).map(lambda c: tuple(sorted(c)))


@given(rows, patterns, st.tuples(*[st.integers(0, 4)] * 3))
def test_a_lookup_finds_exactly_the_matching_rows_and_touches_no_others(found, columns, row):
    relation, key = Relation("r", 3, found), tuple(row[c] for c in columns)
    expected = [r for r in dict.fromkeys(found) if tuple(r[c] for c in columns) == key]
    assert list(relation.matching(columns, key)) == expected
    assert relation.touched == len(expected)


@given(rows, rows, patterns, st.tuples(*[st.integers(0, 4)] * 3))
def test_an_index_built_early_answers_like_one_built_late(before, after, columns, row):
    early, key = Relation("r", 3, before), tuple(row[c] for c in columns)
    early.matching(columns, key)
    for new in after:
        early.add(new)
    assert list(early.matching(columns, key)) == list(Relation("r", 3, [*before, *after]).matching(columns, key))


def test_a_row_keeps_the_round_in_which_it_first_appeared():
    relation = Relation("r", 1)
    assert relation.add(("a",), 2)
    assert not relation.add(("a",), 5)
    assert relation.rows[("a",)] == 2


def test_a_ground_no_touches_nothing():
    relation = Relation("r", 2, [(n, n) for n in range(1000)])
    assert not relation.matching((0, 1), (3, 4))
    assert relation.touched == 0


def test_a_relation_without_columns_holds_or_does_not():
    assert list(Relation("rain", 0, [()]).matching((), ())) == [()]
    assert list(Relation("rain", 0).matching((), ())) == []


def test_a_row_that_comes_after_an_index_was_built_is_found_and_one_that_goes_is_not():
    relation = Relation("r", 2, [("a", 1)])
    assert list(relation.matching((0,), ("b",))) == []
    assert relation.add(("b", 2)) and relation.add(("b", 3))
    assert list(relation.matching((0,), ("b",))) == [("b", 2), ("b", 3)]
    assert relation.remove(("b", 2)) and not relation.remove(("b", 2))
    assert list(relation.matching((0,), ("b",))) == [("b", 3)]
    assert relation.remove(("b", 3))
    assert list(relation.matching((0,), ("b",))) == []
    assert relation.add(("b", 4)) and list(relation.matching((0,), ("b",))) == [("b", 4)]
