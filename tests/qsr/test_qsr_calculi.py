"""What each calculus says of plain examples."""

import math

import pytest

from casper import qsr
from casper.kb.errors import TraceError
from casper.qsr.calculi.table import CALCULI, calculus


def label(name, *things, before=None, dt=1.0):
    """What is told of things now, in the order given, where they were ``before``."""
    stream = qsr.Stream(name)
    names = "abc"[: len(things)]
    if before is not None:
        stream.update(0.0, dict(zip(names, before)))
    told = stream.update(dt, dict(zip(names, things)))
    return next(iter(told.values())).get(tuple(names))


@pytest.mark.parametrize("name", sorted(CALCULI))
def test_the_labels_of_a_calculus_are_different_and_go_by_its_name(name):
    made = calculus(name)
    assert made.name == name and len(set(made.labels)) == len(made.labels) > 1


def test_distances_are_taken_in_space_where_both_have_a_height():
    assert label("qdc", (0, 0, 0), (0.5, 0, 4)) == "far"
    assert label("qdc", (0, 0, 0), (0.5, 0)) == "touch"
    assert label(qsr.Qdc(heights=False), (0, 0, 0), (0.5, 0, 4)) == "touch"


def test_bands_may_be_any():
    assert label(qsr.Qdc((("mine", 0.5), ("ours", 3.0))), (0, 0), (99, 0)) == "ours"


@pytest.mark.parametrize(
    ("one", "other", "said"), [((1, 0), (3, 0), "closer"), ((3, 0), (0, 3), "same"), ((3, 0), (0, 2), "farther")]
)
def test_a_relative_distance_compares_two(one, other, said):
    assert label("relative_distance", (0, 0), one, other) == said


@pytest.mark.parametrize(
    ("k", "other", "said"),
    [
        ((1, 0), (4, 0), "-0"),
        ((-1, 0), (4, 0), "+0"),
        ((0, 0), (3, 0), "0-"),
        ((1, 0), (5, 0), "-+"),
        ((0, 1), (4, 0.05), "00"),
    ],
)
def test_qtc_b_has_a_symbol_for_each_of_two(k, other, said):
    assert label("qtc_b", k, other, before=((0, 0), (4, 0))) == said
    assert label("qtc_b11", k, other, before=((0, 0), (4, 0))) == said[0]


def test_the_textbook_and_qsrlib_differ_on_who_passes_by():
    passing = {"before": ((0, 0), (1, 0))}
    assert label(qsr.QtcB(), (0, 1), (1, 0), **passing) == "00"
    assert label(qsr.QtcB(variant="distance"), (0, 1), (1, 0), **passing) == "+0"


@pytest.mark.parametrize(
    ("k", "other", "said"),
    [((1, 1), (4, 0), "-0-0"), ((1, -1), (4, 0), "-0+0"), ((0, 0), (4, 1), "000+"), ((0, 0), (4, -1), "000-")],
)
def test_qtc_c_adds_the_side_of_the_line_as_each_sees_it(k, other, said):
    assert label("qtc_c", k, other, before=((0, 0), (4, 0))) == said


def test_qtc_bc_tells_sides_of_those_who_are_near():
    assert label("qtc_bc", (1, 1), (4, 0), before=((0, 0), (4, 0))) == "-0"
    assert label("qtc_bc", (0.5, 0.5), (1, 0), before=((0, 0), (1, 0))) == "-0-0"


def test_rising_is_motion_only_where_heights_count():
    up = {"before": ((0, 0, 0), (3, 0, 0))}
    assert label("qtc_b", (0, 0, 1), (3, 0, 0), **up) == "00"
    assert label(qsr.QtcB(heights=True), (0, 0, 1), (3, 0, 4), before=((0, 0, 0), (3, 0, 4))) == "-0"
    stream = qsr.Stream("mos", qsr.Mos(heights=True, name="in_space"))
    stream.update(0, {"a": (0, 0, 0)})
    assert stream.update(1, {"a": (0, 0, 1)}) == {"mos": {("a",): "stationary"}, "in_space": {("a",): "moving"}}


def test_a_threshold_is_a_length_or_a_speed():
    assert label(qsr.QtcB11(qsr.Distance(0.09)), (0.08, 0), (4, 0), before=((0, 0), (4, 0)), dt=0.5) == "0"
    assert label(qsr.QtcB11(qsr.Speed(0.09)), (0.08, 0), (4, 0), before=((0, 0), (4, 0)), dt=0.5) == "-"


@pytest.mark.parametrize(
    ("place", "said"),
    [
        ((0, 1), "n"),
        ((1, 1), "ne"),
        ((1, 0), "e"),
        ((1, -1), "se"),
        ((0, -1), "s"),
        ((-1, -1), "sw"),
        ((-1, 0), "w"),
        ((-1, 1), "nw"),
        ((0, 0), "eq"),
        ((0.4, 1), "n"),
        ((1, 0.4), "e"),
        ((0.43, 1), "ne"),
    ],
)
def test_the_first_lies_in_a_cardinal_direction_of_the_second(place, said):
    assert label("cardinal", place, (0, 0)) == said


def test_by_projection_only_what_is_straight_north_is_north():
    assert label(qsr.Cardinal("projection"), (0.1, 9), (0, 0)) == "ne"
    assert label(qsr.Cardinal("projection", 0.2), (0.1, 9), (0, 0)) == "n"


@pytest.mark.parametrize(
    ("place", "said"), [((0, 1), "front"), ((1, 0), "right"), ((-1, 1), "front_left"), ((0, -1), "back")]
)
def test_directions_are_seen_along_the_heading(place, said):
    assert label("egocentric", qsr.Body(0, 0, heading=math.pi / 2), qsr.Body(*place, heading=0.0)) == said


@pytest.mark.parametrize(
    ("place", "said"),
    [
        ((2, 0), "dsb"),
        ((1.5, 0), "csb"),
        ((0.5, 0), "csf"),
        ((-1, 0), "dsf"),
        ((1, 0), "sam"),
        ((1, 1), "dsl"),
        ((1, -0.5), "csr"),
        ((3, 1), "dbl"),
        ((2, 3), "dlb"),
        ((0.9, 3), "dlf"),
        ((-3, 1), "dfl"),
        ((3, -1), "dbr"),
        ((0, 0), "dsf"),
    ],
)
def test_tpcc_tells_where_the_third_is_for_one_who_looks_from_the_first_to_the_second(place, said):
    assert label("tpcc", (0, 0), (1, 0), place) == said


def test_tpcc_tells_apart_who_coincides():
    assert label("tpcc", (1, 1), (1, 1), (2, 2)) == "dou"
    assert label("tpcc", (1, 1), (1, 1), (1, 1)) == "tri"


def box(x0, x1, y0=0.0, y1=1.0):
    return qsr.Body((x0 + x1) / 2, (y0 + y1) / 2, size=(x1 - x0, y1 - y0))


@pytest.mark.parametrize(
    ("one", "along_x"),
    [
        ((0, 1), "before"),
        ((0, 2), "meets"),
        ((0, 3), "overlaps"),
        ((2, 3), "starts"),
        ((3, 4), "during"),
        ((3, 5), "finishes"),
        ((2, 5), "equals"),
        ((0, 5), "finished_by"),
        ((0, 6), "contains"),
        ((2, 6), "started_by"),
        ((3, 6), "overlapped_by"),
        ((5, 6), "met_by"),
        ((6, 7), "after"),
    ],
)
def test_rectangles_are_related_along_each_axis(one, along_x):
    assert label("rectangle", box(*one), box(2, 5)) == f"{along_x},equals"


@pytest.mark.parametrize(
    ("one", "rcc8", "rcc5", "rcc4", "rcc3", "rcc2"),
    [
        (box(0, 1), "dc", "dr", "dc", "dc", "dc"),
        (box(0, 2), "ec", "dr", "po", "po", "c"),
        (box(1, 3), "po", "po", "po", "po", "c"),
        (box(2, 3), "tpp", "pp", "pp", "o", "c"),
        (box(3, 4, 0.25, 0.75), "ntpp", "pp", "pp", "o", "c"),
        (box(1, 5), "tppi", "ppi", "ppi", "o", "c"),
        (box(1, 6, -1, 2), "ntppi", "ppi", "ppi", "o", "c"),
        (box(2, 5), "eq", "eq", "pp", "o", "c"),
        (box(3, 4, -1, 2), "po", "po", "po", "po", "c"),
        (box(0, 2, 1, 2), "ec", "dr", "po", "po", "c"),
    ],
)
def test_regions_are_connected_in_eight_ways_and_fewer(one, rcc8, rcc5, rcc4, rcc3, rcc2):
    found = [label(f"rcc{kind}", one, box(2, 5)) for kind in (8, 5, 4, 3, 2)]
    assert found == [rcc8, rcc5, rcc4, rcc3, rcc2]


def test_borders_within_the_tolerance_touch():
    assert label("rcc8", box(0, 1.9), box(2, 5)) == "dc"
    assert label(qsr.Rcc(tolerance=0.2), box(0, 1.9), box(2, 5)) == "ec"


def test_who_has_something_in_the_hand_holds():
    assert label("hold", qsr.Body(0, 0, holding="cup")) == "holding"
    assert label("hold", (0, 0)) == "free"


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: qsr.Qdc((("near", 2), ("far", 1))), "ends that grow"),
        (lambda: qsr.Qdc((("near", math.nan),)), "ends that grow"),
        (lambda: qsr.Qdc(()), "ends that grow"),
        (lambda: qsr.Qdc((("near", 1), ("near", 2))), "named twice"),
        (lambda: qsr.Qdc(margin=-1), "the margin of QDC is a length from 0, not -1"),
        (lambda: qsr.Speed(math.nan), "a threshold is a speed from 0, not nan"),
        (lambda: qsr.Distance(-1), "a threshold is a length from 0, not -1"),
        (lambda: qsr.QtcB(variant="neither"), "projection or distance, not neither"),
        (lambda: qsr.QtcBC(margin=qsr.Speed(1)), "QTC_BC has no margin"),
        (lambda: qsr.Cardinal("star"), "by cone or projection, not star"),
        (lambda: qsr.Rcc(7), "not RCC7"),
        (lambda: qsr.Rcc(axes=1), "2 or 3 axes, not 1"),
        (lambda: qsr.Tpcc(math.nan), "tolerance of TPCC"),
        (lambda: qsr.Stream("qtc"), "there is no calculus 'qtc'; there are block, cardinal"),
        (lambda: qsr.Stream(), "no calculus is named"),
        (lambda: qsr.Stream("qdc", qsr.Qdc(margin=1)), "two calculi are named qdc"),
    ],
)
def test_a_calculus_that_makes_no_sense_is_refused_in_a_sentence(make, sentence):
    with pytest.raises(TraceError, match=sentence.replace("(", r"\(")):
        make()
