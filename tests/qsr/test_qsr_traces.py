"""Traces from arrays, rows, files and data frames, and what is refused."""

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from traces import labels, traces

from casper import qsr
from casper.kb.errors import TraceError
from casper.qsr.traces.reading import to_pandas, to_rows, write_csv

NAMES = ("ann", "cup")
PLACES = np.zeros((3, 2, 2))


def same(one, other):
    assert one.names == other.names
    for mine, yours in ((one.t, other.t), *zip(one.where, other.where, strict=True), (one.heading, other.heading)):
        np.testing.assert_array_equal(mine, yours)
    np.testing.assert_array_equal(one.held, other.held)
    assert [a.tolist() for a in one.sizes or ()] == [a.tolist() for a in other.sizes or ()]


@pytest.mark.parametrize("way", ["rows", "pandas", "csv", "parquet"])
@settings(max_examples=5)
@given(trace=traces(least=2, space=True))
def test_a_trace_is_read_as_it_was_written(tmp_path_factory, way, trace):
    file = tmp_path_factory.mktemp("traces") / "trace"
    if way == "rows":
        read = qsr.from_rows(to_rows(trace))
    elif way == "pandas":
        read = qsr.from_pandas(to_pandas(trace))
    elif way == "csv":
        write_csv(trace, file)
        read = qsr.read_csv(file)
    else:
        to_pandas(trace).to_parquet(file)
        read = qsr.read_parquet(file)
    told = labels(read, "qdc", "qtc_c", "rcc8")
    before = labels(trace, "qdc", "qtc_c", "rcc8")
    steps = {t: at for at, t in enumerate(trace.t.tolist())}
    for key, labels_read in told.items():
        assert labels_read == [before[key][steps[t]] for t in read.t.tolist()]


def test_rows_may_come_in_any_order_and_leave_things_out():
    rows = [{"t": 2, "name": "cup", "x": 1, "y": 2}, {"t": 1, "name": "ann", "x": 0, "y": 0, "holding": "cup"}]
    trace = qsr.from_rows(rows)
    assert trace.t.tolist() == [1, 2] and trace.names == ("cup", "ann")
    assert trace.present.tolist() == [[False, True], [True, False]]
    assert repr(trace) == "<Trace of cup, ann, 2 steps>"


def test_an_empty_place_is_an_absence():
    trace = qsr.from_rows([{"t": t, "name": "cup", "x": x, "y": x} for t, x in ((0, 1.0), (1, None), (2, math.nan))])
    assert trace.present.tolist() == [[True, False, False]]


@pytest.mark.parametrize(
    ("lines", "sentence"),
    [
        ("t,name,x\n", "{file} has no column y; a trace has t, name, x, y and may have z, heading"),
        ("t,name,x,y\n0,cup,1,1\n0,cup,2,2\n", "{file}:3: cup is there twice at t=0"),
        ("t,name,x,y\n0,cup,1,\n", "{file}:2: cup has an x or a y only"),
        ("t,name,x,y\n0,cup,nan,1\n", "{file}:2 has 'nan' under x; leave the cell empty"),
        ("t,name,x,y\n0,cup,inf,1\n", "{file}:2: cup has inf as its x; coordinates are finite numbers"),
        ("t,name,x,y\n0,cup,one,1\n", "{file}:2 has 'one' under x, which is no number"),
        ("t,name,x,y\n,cup,1,1\n", "{file}:2 has no finite time"),
        ("t,name,x,y\n0,,1,1\n", "{file}:2 has no name"),
        ("t,name,x,y,heading\n0,cup,1,1,inf\n", "cup has an infinite heading at t=0"),
    ],
)
def test_a_mistake_in_a_file_is_told_with_its_line(tmp_path, lines, sentence):
    file = tmp_path / "trace.csv"
    file.write_text(lines)
    with pytest.raises(TraceError) as told:
        qsr.read_csv(file)
    assert sentence.format(file=file) in str(told.value)


@pytest.mark.parametrize("read", [qsr.read_csv, qsr.read_parquet])
def test_a_file_that_is_not_there_or_is_something_else_is_refused_in_a_sentence(tmp_path, read):
    other = tmp_path / "other"
    other.write_bytes(b"\xff\x00\xfe binary")
    for file in (Path("nowhere"), other):
        with pytest.raises(TraceError, match="cannot be read as"):
            read(file)


def given_(t=(0, 1, 2), names=NAMES, places=PLACES, **rest):
    return lambda: qsr.Trace.of(t, names, places, **rest)


def placed(value, at=(1, 1, 0)):
    places = np.zeros((3, 2, 2))
    places[at] = value
    return places


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (given_(places=placed(math.nan)), "cup has nan as its x at t=1; coordinates are finite numbers"),
        (given_(places=placed(math.inf, (2, 0, 1))), "ann has inf as its y at t=2"),
        (given_(places=placed(1e200)), r"cup has 1e\+200 as its x at t=1"),
        (given_(t=(0, 2, 1)), "time must advance from one step to the next: t=1 came after t=2"),
        (given_(t=(0, 1, 1)), "t=1 came after t=1"),
        (given_(t=(0, math.nan, 1)), "the time of step 1 is not finite"),
        (given_(t=[[0, 1, 2]]), "times are a row of numbers"),
        (given_(names=("cup", "cup")), "two things are named cup; names are given once"),
        (given_(names=("cup", "")), "things go by names, and '' is none"),
        (given_(places=np.zeros((3, 2))), r"places should have the shape \(3, 2, 2\) or \(3, 2, 3\)"),
        (given_(present=np.ones((2, 2))), r"present should have the shape \(3, 2\)"),
        (given_(headings=np.full((3, 2), math.inf)), "ann has an infinite heading at t=0"),
        (given_(headings=np.zeros((2, 2))), "headings should have the shape"),
        (given_(sizes=np.ones((2, 5))), "sizes should have the shape"),
        (given_(holding=[[None, None]]), "holding should have a row for each of 3 steps"),
        (
            given_(places=np.stack([np.zeros((3, 2)), np.zeros((3, 2)), [[0, 0], [math.nan, 0], [0, 0]]], axis=2)),
            "ann has a height at",
        ),
    ],
)
def test_a_trace_that_makes_no_sense_is_refused_in_a_sentence(make, sentence):
    with pytest.raises(TraceError, match=sentence):
        make()


def test_what_is_absent_may_have_any_numbers():
    trace = qsr.Trace.of((0, 1, 2), NAMES, placed(math.nan), present=[[1, 1], [1, 0], [1, 1]])
    assert list(qsr.relations(trace, "qdc")["qdc"].between("ann", "cup")) == ["touch", None, "touch"]


def test_what_is_only_held_is_a_thing_that_is_never_seen():
    trace = qsr.Trace.of((0, 1, 2), NAMES, PLACES, holding=[["jug", None]] * 3)
    assert trace.names == ("ann", "cup", "jug")
    found = qsr.relations(trace, "hold", "qdc", observer="ann")
    assert found.at(1) == {"hold": {("ann",): "holding"}, "qdc": {("ann", "cup"): "touch"}}


@pytest.mark.parametrize(
    ("named", "settings", "sentence"),
    [
        (("qdc",), {"observer": "bob"}, "bob is not in the trace; it has ann, cup"),
        (("qdc",), {"pairs": [("ann", "bob")]}, "bob is not in the trace"),
        (("egocentric",), {}, "egocentric needs a heading of ann, cup"),
        (("rcc8",), {}, "rcc8 needs a size of ann, cup"),
        (("block",), {}, "block needs a size of ann, cup"),
        (("qdc",), {"longest_step": -1}, "the longest step is a number of seconds above 0"),
    ],
)
def test_relations_that_cannot_be_taken_are_refused_in_a_sentence(named, settings, sentence):
    with pytest.raises(TraceError, match=sentence):
        qsr.relations(qsr.Trace.of((0, 1, 2), NAMES, PLACES), *named, **settings)


def test_a_missing_heading_is_told_with_its_time():
    headings = [[0, math.nan], [math.nan, math.nan], [0, math.nan]]
    trace = qsr.Trace.of((0, 1, 2), NAMES, PLACES, headings=headings)
    with pytest.raises(TraceError, match="ann has no heading at t=1, which egocentric needs"):
        qsr.relations(trace, "egocentric", observer="ann")


def test_an_empty_trace_has_no_relations():
    trace = qsr.Trace.of((), NAMES, np.zeros((0, 2, 2)))
    assert qsr.relations(trace, "qdc", "qtc_b")["qdc"].codes.shape == (2, 0)


def test_relations_are_rows_of_a_data_frame():
    frame = qsr.relations(qsr.Trace.of((0, 1, 2), NAMES, placed(5)), "mos", "qdc", observer="cup").to_pandas()
    assert list(frame.columns) == ["t", "calculus", "relation", "a", "b"]
    assert frame[frame.calculus == "qdc"].relation.tolist() == ["touch", "far", "touch"]
    assert frame[frame.calculus == "mos"].t.tolist() == [1.0, 2.0]


def test_what_was_not_worked_out_is_refused_by_name():
    found = qsr.relations(qsr.Trace.of((0, 1, 2), NAMES, PLACES), "qdc")
    with pytest.raises(TraceError, match="mos was not worked out; there are qdc"):
        found["mos"]
    with pytest.raises(TraceError, match="cup bob is not related by qdc here; there are ann cup, cup ann"):
        found["qdc"].between("cup", "bob")
