"""Tables of interned constants, against plain sets of rows."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper.kb.relations.column_relation import ColumnRelation
from casper.kb.relations.columns import Interner, Table, code, decode

BASES = [6, 9_000]  # with a bitmap of all possible rows, and with too many for one
rows = st.lists(st.tuples(st.integers(0, 5), st.integers(0, 5)), max_size=12)
batches = st.lists(rows.filter(bool), max_size=5)


def columns_of(found):
    return [np.array(column, np.int64) for column in zip(*found)]


def rows_of(columns):
    return list(zip(*(column.tolist() for column in columns)))


def filled(found, base):
    table, known = Table(2, base), set()
    for round_, batch in enumerate(found):
        new = rows_of(table.add(columns_of(batch), round_))
        assert sorted(new) == sorted(set(batch) - known)
        known |= set(batch)
    return table, known


@pytest.mark.parametrize("base", BASES)
@given(batches)
def test_a_table_holds_each_row_once_and_tells_which_were_new(base, found):
    table, known = filled(found, base)
    assert len(table) == len(known)
    assert sorted(rows_of(table.all_rows())) == sorted(known)
    every = [(a, b) for a in range(6) for b in range(6)]
    assert table.has(code(columns_of(every), table.base, 36)).tolist() == [row in known for row in every]


@pytest.mark.parametrize("base", BASES)
@given(batches, st.lists(st.integers(0, 5), min_size=1, max_size=4), st.sampled_from([0, 1]))
def test_a_join_finds_every_row_of_each_key(base, found, keys, column):
    table, known = filled(found, base)
    expected = [(at, row) for at, key in enumerate(keys) for row in known if row[column] == key]
    for most in (1, 2, 10**6):
        blocks = list(table.join((column,), np.array(keys, np.int64), most))
        found = [pair for which, matches in blocks for pair in zip(which.tolist(), rows_of(matches))]
        assert sorted(found) == sorted(expected)
        assert all(len(which) <= most for which, _ in blocks) and len(blocks) <= max(1, len(expected))
    assert table.any_match((column,), np.array(keys, np.int64)).tolist() == [any(r[column] == k for r in known) for k in keys]


@pytest.mark.parametrize("base", BASES)
@given(batches)
def test_without_a_column_every_row_is_found(base, found):
    table, known = filled(found, base)
    blocks = list(table.join((), np.zeros(1, np.int64)))
    assert [at for which, _ in blocks for at in which.tolist()] == [0] * len(known)
    assert sorted(row for _, matches in blocks for row in rows_of(matches)) == sorted(known)


@given(batches)
def test_runs_are_few_and_shrink(found):
    table, _ = filled(found, 6)
    sizes = [run.size for run in table.runs]
    assert all(earlier > 2 * later for earlier, later in pairwise(sizes))


@given(st.integers(1, 9), st.lists(st.tuples(*[st.integers(0, 8)] * 3), min_size=1))
def test_codes_are_numbers_in_the_radix_of_the_constants(extra, found):
    base = 8 + extra
    codes = code(columns_of(found), base, len(found))
    assert codes.tolist() == [a * base * base + b * base + c for a, b, c in found]
    assert rows_of(decode(codes, base, 3)) == found


def test_constants_are_numbered_as_they_come_and_equal_ones_share_their_number():
    interner = Interner()
    assert [interner.intern(constant) for constant in ("a", "b", "a", 1, 1.0)] == [0, 1, 0, 2, 2]
    assert rows_of(interner.columns([("b", "c"), ("c", "d")], 2)) == [(1, 3), (3, 4)]
    assert interner.constants == ["a", "b", 1, "c", "d"]
    assert interner.number("d") == 4 and interner.number("e") is None
    assert len(interner) == 5


def test_a_relation_on_columns_answers_like_one_of_rows():
    interner, table = Interner(), Table(2, 3)
    for round_, found in enumerate([[("a", "b"), ("b", "c")], [("a", "c")]]):
        table.add(interner.columns(found, 2), round_)
    relation = ColumnRelation("r", 2, table, interner)
    assert len(relation) == 3
    assert ("a", "c") in relation and ("c", "a") not in relation and ("a", "z") not in relation
    assert sorted(relation.matching((0,), ("a",))) == [("a", "b"), ("a", "c")]
    assert relation.round_of(("a", "b")) == 0 and relation.round_of(("a", "c")) == 1
    assert relation.add(("c", "a"), 5) and not relation.add(("a", "b"), 5)
    assert len(relation) == 4 and ("c", "a") in relation
    assert list(relation)[:2] == [("a", "b"), ("b", "c")]


def test_a_bitmap_is_kept_only_where_there_are_not_too_many_possible_rows():
    assert [Table(2, base)._bitmap is not None for base in BASES] == [True, False]
    assert Table(2, 0).base == 1
