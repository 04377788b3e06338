"""Answers as columns: the same as those of a query, whatever holds the rows."""

from __future__ import annotations

import subprocess
import sys
from collections import Counter

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from programs import programs

from casper.kb.base import KnowledgeBase
from casper.kb.bottom_up import materialise as fixpoints
from casper.kb.errors import CasperError, ProgramError, Undefined
from casper.kb.relations.tables import libraries
from casper.kb.relations.tables.answers import typed
from casper.kb.terms.terms import Compound, Variable

VALUES = ("a", "b", 1, 2, 0.5)
QUERIES = ["e(X, Y)", "e(X, X)", "e(a, X)", "e(X, 1)", "e(X, _)", "e(_, _)", "e(_, X)", "e(_A, _A)", "e(a, b)", "e(nowhere, X)"]
QUERIES += ["path(X, Y)", "path(X, X)", "path(_, 2)", "e(X, Y), path(Y, Z)", "e(X, Y) ; path(Y, X)", "path(X, Y), X \\= Y"]
edges = st.lists(st.tuples(st.sampled_from(VALUES), st.sampled_from(VALUES)), max_size=8)
HOME = "human(ann). human(bob). age(ann, 3). age(bob, 4). weigh(ann, 20). weigh(bob, 20.5). at(ann, p(1, 2)). at(bob, sea)."


def graph(rows):
    base = KnowledgeBase.from_text(":- dynamic(e/2). path(X, Y) :- e(X, Y). path(X, Y) :- path(X, Z), e(Z, Y).")
    base.facts("e", rows)
    return base


def answers(base, query):
    found = base.query(query)
    return Counter(frozenset(answer.items()) for answer in found)


def as_answers(table):
    return Counter(frozenset(zip(table.columns, row)) for row in table)


@pytest.mark.parametrize("columns_from", [0, 10**9], ids=["columns", "rows"])
@given(rows=edges, query=st.sampled_from(QUERIES))
def test_a_table_has_the_answers_of_the_query(columns_from, rows, query):
    before, fixpoints.COLUMNS_FROM = fixpoints.COLUMNS_FROM, columns_from
    try:
        base = graph(rows)
        table = base.table(query)
        assert as_answers(table) == answers(base, query)
        assert len(table) == sum(answers(base, query).values())
    finally:
        fixpoints.COLUMNS_FROM = before


@given(programs())
def test_a_table_of_anything_has_the_answers_of_the_query(text):
    base = KnowledgeBase.from_text(text)
    for query in ("d0(X)", "d1(X, Y)", "d1(X, Y), d0(X)", "d2(X), \\+ d0(X)"):
        assert told(lambda asked=query: as_answers(base.table(asked))) == told(lambda asked=query: answers(base, asked))


def told(question):
    """The answers, or the sentence that says why there are more that are undefined."""
    try:
        return question()
    except Undefined as doubt:
        return doubt.sentence


def test_columns_stand_in_the_order_of_the_variables_with_types_that_keep_every_value():
    base = KnowledgeBase.from_text(HOME)
    table = base.table("age(Who, Years), weigh(Who, Kilos)")
    assert list(table.columns) == ["Who", "Years", "Kilos"]
    assert [column.dtype for column in table.columns.values()] == [object, np.int64, np.float64]
    assert list(table) == [("ann", 3, 20.0), ("bob", 4, 20.5)]


def test_terms_stay_terms():
    assert list(KnowledgeBase.from_text(HOME).table("at(W, P)").columns["P"]) == [Compound(("p", 1, 2)), "sea"]


def test_a_part_that_may_be_anything_is_a_variable():
    [(left, right)] = KnowledgeBase.from_text("same(X, X).").table("same(A, B)")
    assert isinstance(left, Variable) and left == right


def test_a_query_without_variables_has_no_columns_and_one_answer_or_none():
    base = KnowledgeBase.from_text(HOME)
    assert (len(base.table("human(ann)")), len(base.table("human(eve)"))) == (1, 0)
    assert list(base.table("human(ann)")) == [()]


def test_a_large_relation_is_not_made_python_rows():
    base = graph([(at, at + 1) for at in range(fixpoints.COLUMNS_FROM)])
    table = base.table("path(X, Y)")
    count = fixpoints.COLUMNS_FROM
    assert len(table) == count * (count + 1) // 2
    assert int(table.columns["Y"].sum() - table.columns["X"].sum()) == sum(d * (count + 1 - d) for d in range(count + 1))
    assert base.stored(("path", 2)).interned() is not None


def test_an_unknown_predicate_is_refused():
    with pytest.raises(ProgramError, match="nothing defines humn/1"):
        KnowledgeBase.from_text(HOME).table("humn(X)")


@given(st.lists(st.one_of(st.integers(), st.floats(allow_nan=False), st.sampled_from("ab"))))
def test_an_array_keeps_every_value(values):
    assert typed(values).tolist() == values


def test_a_table_becomes_a_data_frame():
    pandas = pytest.importorskip("pandas", reason="pandas is not installed: pip install casper-hri[tables]")
    frame = KnowledgeBase.from_text(HOME).table("age(Who, Years)").to_pandas()
    assert isinstance(frame, pandas.DataFrame)
    assert frame.to_dict("list") == {"Who": ["ann", "bob"], "Years": [3, 4]}
    assert len(KnowledgeBase.from_text(HOME).table("human(ann)").to_pandas()) == 1


def test_a_table_becomes_an_arrow_table():
    pytest.importorskip("pyarrow", reason="pyarrow is not installed: pip install casper-hri[tables]")
    table = KnowledgeBase.from_text(HOME).table("age(Who, Years), weigh(Who, Kilos)").to_arrow()
    assert [str(column.type) for column in table.schema] == ["string", "int64", "double"]
    assert table.to_pylist()[1] == {"Who": "bob", "Years": 4, "Kilos": 20.5}


def test_what_arrow_has_no_type_for_is_told():
    pytest.importorskip("pyarrow", reason="pyarrow is not installed: pip install casper-hri[tables]")
    with pytest.raises(CasperError, match="column P holds terms"):
        KnowledgeBase.from_text(HOME).table("at(W, P)").to_arrow()


@pytest.mark.parametrize(("method", "library"), [("to_pandas", "pandas"), ("to_arrow", "pyarrow")])
def test_a_missing_library_is_one_sentence_that_says_how_to_get_it(method, library, monkeypatch):
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(CasperError, match=rf"^{library} is not installed: pip install 'casper-hri\[tables\]'$"):
        getattr(KnowledgeBase.from_text(HOME).table("human(X)"), method)()
    assert libraries.needed("json").dumps(1) == "1"


def test_numpy_pandas_and_arrow_are_loaded_for_those_who_ask():
    program = (
        "import sys; from casper.kb.base import KnowledgeBase; kb = KnowledgeBase.from_text('p(a).'); kb.facts('q', [('b',)]);"
        "kb.ask('q(b)'); print([m for m in ('numpy', 'pandas', 'pyarrow') if m in sys.modules])"
    )
    assert subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout == "[]\n"
