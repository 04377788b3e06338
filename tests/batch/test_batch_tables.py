"""Tables in and out: what is written is read again, and bad rows are kept with their place."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper.batch.rows import texts_of
from casper.batch.tables import read_table, write_table
from casper.kb.errors import CasperError

texts = st.text(st.characters(codec="utf-8", exclude_characters="\x00\r"), min_size=1, max_size=8)
columns = st.fixed_dictionaries({"id": texts, "actions": st.lists(texts, max_size=3)})
KINDS = [".csv", ".jsonl", ".parquet"]


@pytest.mark.parametrize("kind", [".jsonl", ".parquet"])
@given(rows=st.lists(columns, min_size=1, max_size=4))
def test_rows_come_back_as_they_were(tmp_path_factory: pytest.TempPathFactory, kind: str, rows: list[dict]) -> None:
    file = tmp_path_factory.mktemp("table") / f"rows{kind}"
    write_table(file, rows)
    assert [row.given for row in read_table(file)] == rows


@given(actions=st.lists(st.sampled_from(["eat", "eat(meal, plate)", "'it''s'(\"a, b\")"]), min_size=1, max_size=3), name=texts)
def test_a_list_of_actions_comes_back_from_csv(tmp_path_factory: pytest.TempPathFactory, actions: list[str], name: str) -> None:
    file = tmp_path_factory.mktemp("table") / "rows.csv"
    write_table(file, [{"id": name, "actions": actions}])
    (row,) = read_table(file)
    assert texts_of(row.given["actions"], "actions") == actions and row.given["id"] == name


@pytest.mark.parametrize("kind", KINDS)
def test_columns_of_mixed_kinds_can_be_written(tmp_path: Path, kind: str) -> None:
    write_table(tmp_path / f"t{kind}", [{"a": 1, "b": ["x"]}, {"a": "one"}, {"c": {"x": 0.5}}])
    assert len(list(read_table(tmp_path / f"t{kind}"))) == 3


def test_bad_rows_are_kept_with_file_and_line(tmp_path: Path) -> None:
    (tmp_path / "r.csv").write_text('a,b\n1,2\n1\n"x"y,2\n3,4\n', encoding="utf-8")
    mistakes = [row.mistake for row in read_table(tmp_path / "r.csv")]
    assert mistakes[0] == mistakes[3] == "" and "r.csv:3: 1 cell under 2 columns" in mistakes[1] and "r.csv:4" in mistakes[2]
    (tmp_path / "r.jsonl").write_bytes(b'{"a": 1}\n\n[1]\n{"a\n\xff\n{"a": 2}\n')
    rows = list(read_table(tmp_path / "r.jsonl"))
    assert [row.number for row in rows] == [1, 2, 3, 4, 5] and rows[4].given == {"a": 2}
    assert "r.jsonl:3: a row is an object" in rows[1].mistake and "r.jsonl:4" in rows[2].mistake and "r.jsonl:5" in rows[3].mistake


@pytest.mark.parametrize(
    "name, text, word",
    [("r.txt", "", "known here"), ("r.csv", "", "names the columns"), ("r.csv", "a,a\n", "each once"), ("r.parquet", "PAR", "no Parquet")],
)
def test_a_file_that_is_no_table_is_told(tmp_path: Path, name: str, text: str, word: str) -> None:
    (tmp_path / name).write_text(text, encoding="utf-8")
    with pytest.raises(CasperError, match=word):
        list(read_table(tmp_path / name))


def test_a_file_that_is_not_there_is_told(tmp_path: Path) -> None:
    with pytest.raises(CasperError, match="cannot read"):
        list(read_table(tmp_path / "none.csv"))
