"""Facts from whatever holds a table; what cannot be a fact is told with its place, and nothing is dropped."""

from __future__ import annotations

import csv
import datetime
import io
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper.kb.base import KnowledgeBase
from casper.kb.errors import CasperError, ProgramError, ReadError
from casper.kb.terms.terms import Compound, Variable

ROWS = [("ann", 3, 20.5), ("bob", 4, 30.0)]


def loaded(source, arity=3, **options):
    base = KnowledgeBase()
    base.facts("p", source, **options)
    return list(base.rows("p", arity))


@pytest.fixture
def file(tmp_path):
    """Writes a file and says where it is."""

    def write(text, name="people.csv", encoding="utf-8"):
        path = tmp_path / name
        path.write_bytes(text.encode(encoding))
        return path

    return write


def refused(source, **options):
    with pytest.raises(CasperError) as mistake:
        loaded(source, **options)
    return mistake.value


# --- numpy, pandas, Arrow, Parquet -----------------------------------------------------------------------------------


def test_rows_are_rows():
    assert loaded(ROWS) == loaded(iter(ROWS)) == ROWS


def test_an_array_of_two_dimensions_has_a_fact_a_row():
    assert loaded(np.array([[1, 2], [3, 4]]), 2) == [(1, 2), (3, 4)]
    assert loaded(np.array([["a", "b"]]), 2) == [("a", "b")]
    assert loaded(np.array([["a", 1]], dtype=object), 2) == [("a", 1)]
    assert all(type(value) is int for row in loaded(np.array([[1, 2]]), 2) for value in row)


def test_an_array_of_one_dimension_is_a_column():
    assert loaded(np.array([1.5, 2.5]), 1) == [(1.5,), (2.5,)]


def test_a_structured_array_has_a_column_a_field():
    assert loaded(np.array(ROWS, dtype=[("name", "U9"), ("age", int), ("weight", float)])) == ROWS


def test_an_array_of_more_dimensions_is_refused():
    assert "one or two dimensions, not 3" in str(refused(np.zeros((2, 2, 2))))


def test_a_data_frame_has_a_fact_a_row():
    pandas = pytest.importorskip("pandas", reason="pandas is not installed: pip install casper-hri[tables]")
    frame = pandas.DataFrame(ROWS, columns=["name", "age", "weight"])
    assert loaded(frame) == ROWS
    frame.loc[1, "weight"] = None
    assert str(refused(frame)) == "row 2 has nothing in column weight: a fact needs an atom or a number there"


def test_an_arrow_table_has_a_fact_a_row_from_memory_and_from_parquet(tmp_path):
    arrow = pytest.importorskip("pyarrow", reason="pyarrow is not installed: pip install casper-hri[tables]")
    from pyarrow import parquet

    table = arrow.table({"name": ["ann", "bob"], "age": [3, 4], "weight": [20.5, 30.0]})
    assert loaded(table) == loaded(table.to_batches()[0]) == ROWS
    parquet.write_table(table, tmp_path / "people.parquet")
    assert loaded(tmp_path / "people.parquet") == loaded(str(tmp_path / "people.parquet")) == ROWS


def test_truth_and_dates_become_atoms():
    arrow = pytest.importorskip("pyarrow", reason="pyarrow is not installed: pip install casper-hri[tables]")
    table = arrow.table({"truth": [True, False], "day": [datetime.date(2024, 2, 29)] * 2})
    assert loaded(table, 2) == [("true", "2024-02-29"), ("false", "2024-02-29")]


@pytest.mark.parametrize("odd", [None, float("nan"), [1], b"bytes"])
def test_what_is_no_constant_is_told_with_row_and_column(odd):
    arrow = pytest.importorskip("pyarrow", reason="pyarrow is not installed: pip install casper-hri[tables]")
    first = odd if isinstance(odd, float) else type(odd)() if odd is not None else None
    mistake = refused(arrow.table({"a": [1, 2], "b": [first, odd]}))
    assert isinstance(mistake, ProgramError) and "row 1 has" in str(mistake) and "in column b" in str(mistake)


def test_a_table_that_is_no_parquet_is_told(file):
    pytest.importorskip("pyarrow", reason="pyarrow is not installed: pip install casper-hri[tables]")
    assert "this file cannot be read" in str(refused(file("no", "people.parquet")))


def test_parquet_without_its_library_is_one_sentence(file, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    assert str(refused(file("", "people.parquet"))) == "pyarrow is not installed: pip install 'casper-hri[tables]'"


def test_what_was_asked_is_a_source_too():
    base = KnowledgeBase.from_text("age(ann, 3). age(bob, 4).")
    assert loaded(base.table("age(X, Y)"), 2) == [("ann", 3), ("bob", 4)]


def test_a_table_without_rows_defines_its_predicate():
    base = KnowledgeBase()
    base.facts("p", np.empty((0, 2)))
    base.rule("q(X) :- p(X, _)")
    assert list(base.query("q(X)")) == []


# --- CSV -------------------------------------------------------------------------------------------------------------


def test_a_csv_has_a_header_unless_one_says_otherwise(file):
    assert loaded(file("name,age,weight\nann,3,20.5\nbob,4,30.0\n")) == ROWS
    assert loaded(file("ann,3,20.5\nbob,4,30.0"), header=False) == ROWS


def test_a_tsv_is_separated_by_tabs(file):
    assert loaded(file("name\tage\tweight\nann\t3\t20.5\nbob\t4\t30.0\n", "people.tsv")) == ROWS


@pytest.mark.parametrize(
    ("cell", "value"),
    [("3", 3), ("-3", -3), ("0.5", 0.5), ("1e3", 1000.0), ("007", "007"), ("+1", "+1"), ("1.", "1."), ("nan", "nan"),
        ("", ""), ("Ann", "Ann"), ('"a, ""b"""', 'a, "b"'), ("true", "true"), ("١", "١")],
)
def test_a_cell_is_a_number_where_the_language_writes_it_so_and_otherwise_an_atom(file, cell, value):
    [(found, _)] = loaded(file(f"a,b\n{cell},x\n"), 2)
    assert found == value and type(found) is type(value)


@pytest.mark.parametrize("cell", ["1234567890123456789", "-12345678901234567890", "9" * 4000, "0", "-7"])
def test_whole_numbers_of_any_size_are_exact(file, cell):
    base = KnowledgeBase()
    base.facts("size", file(f"a\n{cell}\n"))
    ((value,),) = base.rows("size", 1)
    assert (type(value), value) == (int, int(cell))


@pytest.mark.parametrize(("value", "told"), [(None, "nothing"), (float("nan"), "nothing"), ([1], "[1]"), (b"x", "b'x'")])
def test_a_value_that_no_fact_holds_is_told(value, told):
    array = np.array([("ann", None)], dtype=[("name", "U9"), ("thing", object)])
    array["thing"][0] = value
    assert str(refused(array)) == f"row 1 has {told} in column thing: a fact needs an atom or a number there"


@pytest.mark.parametrize(
    ("text", "line", "sentence"),
    [
        ("a,b\n1,2\n1\n", 3, "this line has 1 cell, the first has 2"),
        ("a,b\n1,2,3\n", 2, "this line has 3 cells, the first has 2"),
        ("a,b\n\n1,2\n", 2, "this line has no cell, the first has 2"),
        ('a,b\n"x\ny",2\n1\n', 4, "this line has 1 cell, the first has 2"),
        ("1,2\n3,4\n", 1, "1 is no name of a column; without a header, say header=False"),
        ("a,a\n3,4\n", 1, "two columns are called 'a'; without a header, say header=False"),
        (f"a\n{'7' * 5000}\n", 2, f"{'7' * 20}… (5000 digits) is too large for a number here"),
        ("a\n1e999\n", 2, "1e999 is too large for a number here"),
        ('a\n1\n"x\n', 3, "this file cannot be read any further"),
        ("", 1, "there is nothing in the first line"),
    ],
)
def test_a_mistake_in_a_csv_is_told_with_its_line(file, text, line, sentence):
    mistake = refused(file(text))
    assert isinstance(mistake, ReadError) and sentence in mistake.sentence
    assert (mistake.place.line, mistake.place.file.endswith("people.csv")) == (line, True)


def test_a_csv_in_another_encoding_is_told(file):
    assert "cannot be read any further" in str(refused(file("name\nJosé\n", encoding="latin-1")))


def test_a_file_that_is_not_there_or_of_another_kind_is_told(tmp_path, file):
    assert "cannot be read" in str(refused(tmp_path / "nothing.csv"))
    assert "facts are read from .csv, .tsv and .parquet" in str(refused(file("", "people.xlsx")))


def test_a_refused_file_leaves_the_base_as_it_was(file):
    base = KnowledgeBase.from_text("p(a, b).")
    with pytest.raises(ReadError):
        base.facts("p", file("a,b\n1,2\n1\n"))
    assert list(base.rows("p", 2)) == [("a", "b")]


cells = st.one_of(st.integers(-(10**17), 10**17), st.floats(allow_nan=False, allow_infinity=False), st.text(max_size=5))


@given(st.lists(st.tuples(cells, cells), min_size=1, max_size=6))
def test_what_is_written_as_csv_is_read_back(tmp_path_factory, rows):
    rows = [tuple(x.replace("\0", "") if isinstance(x, str) else x for x in row) for row in rows]
    path = tmp_path_factory.mktemp("csv") / "any.csv"
    text = io.StringIO(newline="")
    csv.writer(text).writerows([("first", "second"), *rows])
    try:
        path.write_text(text.getvalue(), encoding="utf-8", newline="")
    except UnicodeEncodeError:
        return
    found = loaded(path, 2)
    assert len(found) == len(set(map(written, rows)))
    assert {written(row) for row in found} == {written(row) for row in rows}


def written(row):
    return tuple(float(x) if is_number(x) else x for x in row)


def is_number(value):
    try:
        return isinstance(value, (int, float)) or (value.isascii() and value.strip() == value and float(value) == float(value))
    except ValueError:
        return False


def test_rows_of_two_lengths_are_still_refused():
    with pytest.raises(ProgramError, match="columns"):
        loaded([("a",), ("a", "b")])


# --- rows ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("odd", "told"),
    [
        *[(None, "nothing"), (float("nan"), "nothing"), (["a"], "['a']"), (("f", "a"), "('f', 'a')"), (b"x", "b'x'")],
        *[(Variable("X"), "X"), (Compound(("f", Variable("X"))), "f(X)"), (np.float64("nan"), "nothing")],
    ],
)
def test_what_is_no_constant_in_a_row_is_told_with_row_and_column(odd, told):
    assert str(refused([("ann", 1), ("bob", odd)])) == f"row 2 has {told} in column 1: a fact needs an atom or a number there"


def test_rows_may_have_ground_terms_truth_values_and_dates():
    plate = Compound(("on", "plate", "table"))
    assert loaded([(plate, True, datetime.date(2026, 1, 2)), (0.5, False, 1)]) == [(plate, "true", "2026-01-02"), (0.5, "false", 1)]


def test_numbers_of_numpy_in_rows_are_python_s():
    rows = loaded([(np.int64(3), np.float64(0.5), np.str_("a"))])
    assert rows == [(3, 0.5, "a")] and [type(value) for value in rows[0]] == [int, float, str]
