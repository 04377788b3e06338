"""A stream of relations: what comes and goes, what is refused, what is kept."""

import math
import subprocess
import sys

import pytest

from casper import qsr
from casper.kb.errors import TraceError

PLACES = {"ann": (0.0, 0.0), "cup": (1.0, 0.0)}


@pytest.fixture(params=["plain", "arrays"])
def stream(request):
    return qsr.Stream("qdc", "qtc_b11", observer="ann", kernel=request.param)


def test_the_first_step_has_places_and_no_motion(stream):
    assert stream.update(0, PLACES) == {"qdc": {("ann", "cup"): "near"}, "qtc_b11": {}}


def test_who_comes_late_has_no_motion_at_first_and_who_is_gone_is_not_told_of(stream):
    stream.update(0, PLACES)
    told = stream.update(1, {"ann": (0.5, 0), "cup": (1, 0), "jug": (3, 0)})
    assert told["qtc_b11"] == {("ann", "cup"): "-"} and ("ann", "jug") in told["qdc"]
    assert set(stream.update(2, {"ann": (0.5, 0), "jug": (3, 0)})["qdc"]) == {("ann", "jug")}


def test_without_the_observer_nothing_is_told_and_motion_begins_anew(stream):
    stream.update(0, PLACES)
    assert stream.update(1, {"cup": (1, 0)}) == {"qdc": {}, "qtc_b11": {}}
    assert stream.update(2, PLACES)["qtc_b11"] == {}


def test_motion_is_not_taken_across_a_step_that_is_too_long():
    stream = qsr.Stream("mos", longest_step=2.0)
    told = [stream.update(t, {"ann": (t, 0)})["mos"] for t in (0, 1, 2, 9, 10)]
    assert [bool(each) for each in told] == [False, True, True, False, True]


WRONG = [
    (1.0, {"cup": (math.nan, 0)}, "cup has nan as its x at t=1; coordinates are finite numbers"),
    (1.0, {"cup": (0, -math.inf)}, "cup has -inf as its y at t=1"),
    (1.0, {"cup": (0, 0, math.nan)}, "cup has nan as its z at t=1"),
    (1.0, {"cup": (0, 1e200)}, "cup has 1e\\+200 as its y at t=1"),
    (0.0, PLACES, "time must advance from one step to the next: t=0 came after t=0"),
    (-5.0, PLACES, "t=-5 came after t=0"),
    (math.nan, PLACES, "the time of a step is a finite number, not nan"),
    ("soon", PLACES, "the time of a step is a finite number, not 'soon'"),
    (1.0, {"cup": (1, 2, 3, 4)}, "cup should be a Body, \\(x, y\\) or \\(x, y, z\\) at t=1"),
    (1.0, {"cup": "here"}, "cup should be a Body"),
    (1.0, {"cup": (1, 2, 3)}, "cup has a height at some steps and none at others \\(t=1\\)"),
]


@pytest.mark.parametrize(("t", "things", "sentence"), WRONG)
def test_a_wrong_step_is_refused_in_a_sentence_and_the_stream_goes_on(stream, t, things, sentence):
    stream.update(0, PLACES)
    with pytest.raises(TraceError, match=sentence):
        stream.update(t, PLACES | things)
    assert stream.update(1, {"ann": (0.5, 0), "cup": (1, 0)})["qtc_b11"] == {("ann", "cup"): "-"}


@pytest.mark.parametrize(
    ("name", "body", "sentence"),
    [
        ("egocentric", qsr.Body(0, 0), "ann has no heading at t=3, which egocentric needs"),
        ("egocentric", qsr.Body(0, 0, heading=math.nan), "ann has no heading"),
        ("rcc8", qsr.Body(0, 0), r"ann has no size at t=3, which rcc8 needs \(above 0\)"),
        ("rcc8", qsr.Body(0, 0, size=(1.0, 0.0)), "ann has no size"),
        ("block", qsr.Body(0, 0, size=(1.0, 1.0, 1.0)), "ann has no height at t=3, which block needs"),
    ],
)
def test_what_a_calculus_needs_is_asked_for_by_name(name, body, sentence):
    stream = qsr.Stream(name, observer="ann")
    with pytest.raises(TraceError, match=sentence):
        stream.update(3, {"ann": body, "cup": qsr.Body(1, 1, 1.0, 0.0, (1.0, 1.0, 1.0))})


@pytest.mark.parametrize(
    ("settings", "sentence"),
    [
        ({"kernel": "fast"}, "a kernel is plain or arrays, not 'fast'"),
        ({"longest_step": 0}, "the longest step is a number of seconds above 0, not 0"),
        ({"longest_step": math.nan}, "the longest step is a number of seconds above 0, not nan"),
        ({"pairs": [("ann", "ann")]}, "pairs are 2 different names"),
        ({"triples": [("ann", "cup")]}, "triples are 3 different names"),
    ],
)
def test_a_stream_of_nonsense_is_refused_in_a_sentence(settings, sentence):
    with pytest.raises(TraceError, match=sentence):
        qsr.Stream("qdc", **settings)


def test_all_pairs_of_very_many_things_are_refused_before_they_are_made():
    with pytest.raises(TraceError, match=r"10,000 things have 99,990,000 pairs; name an observer"):
        qsr.Stream("qdc").update(0, {f"o{n}": (n, 0) for n in range(10_000)})


def test_many_things_are_told_of_by_arrays_and_few_without(monkeypatch):
    stream = qsr.Stream("qdc", "mos", observer="o0")
    stream.update(0, {f"o{n}": (n, 0) for n in range(9)})
    assert stream._arrays is None
    told = stream.update(1, {f"o{n}": (n, 0) for n in range(900)})
    assert stream._arrays is not None
    assert len(told["qdc"]) == 899 and told["mos"] == {("o0",): "stationary"}


def test_after_a_reset_time_may_start_again(stream):
    stream.update(5, PLACES)
    stream.reset()
    assert stream.update(1, PLACES)["qtc_b11"] == {}


def test_a_stream_keeps_one_step_however_long_it_is(monkeypatch):
    monkeypatch.setattr("casper.qsr.stream.MOST_NAMES", 10)
    stream = qsr.Stream("qdc", "qtc_b", qsr.Mos(margin=qsr.Speed(1)))
    for t in range(100):
        stream.update(t, {f"a{t}": (0, 0), f"b{t}": (1, 1)})
    assert len(stream._low) <= 12 and len(stream._seen) == 2 and len(stream._held["qdc"]) == 2


def test_a_stream_of_few_things_needs_no_numpy():
    code = (
        "import sys; from casper import qsr; s = qsr.Stream('qdc', 'qtc_c', 'rcc8', 'tpcc'); "
        "s.update(0, {n: qsr.Body(i, 0, size=(1, 1)) for i, n in enumerate('abc')}); sys.exit('numpy' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0
