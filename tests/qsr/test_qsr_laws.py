"""Laws of qualitative relations over random traces in which things come and go."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from traces import (
    BOXES,
    CALCULI,
    NAMES,
    OF_ALL_KINDS,
    QUARTER,
    bodies,
    changed,
    eighths,
    labels,
    mirrored,
    quarter_turn,
    traces,
)

from casper import qsr
from casper.qsr import batch

FEW = settings(max_examples=settings().max_examples // 4)


@FEW
@given(traces(space=True), st.sampled_from((9.0, 0.75)), st.sampled_from(("plain", "arrays")))
def test_a_step_at_a_time_says_what_the_whole_trace_says(trace, longest, kernel):
    found = qsr.relations(trace, *OF_ALL_KINDS[:-1], longest_step=longest)
    stream = qsr.Stream(*OF_ALL_KINDS[:-1], longest_step=longest, kernel=kernel)
    for at, t in enumerate(trace.t.tolist()):
        assert stream.update(t, bodies(trace, at)) == found.at(at)


@FEW
@given(traces(space=True))
def test_boxes_in_space_are_related_alike_by_both_kernels(trace):
    found = qsr.relations(trace, OF_ALL_KINDS[-1])
    stream = qsr.Stream(OF_ALL_KINDS[-1], kernel="plain")
    for at, t in enumerate(trace.t.tolist()):
        assert stream.update(t, bodies(trace, at)) == found.at(at)


@FEW
@given(traces(least=3, most=12), st.integers(1, 40))
def test_where_a_long_trace_is_cut_into_pieces_does_not_matter(trace, cells):
    whole = labels(trace, *OF_ALL_KINDS[:17], *OF_ALL_KINDS[18:-1])
    usual, batch.CELLS = batch.CELLS, cells
    try:
        assert labels(trace, *OF_ALL_KINDS[:17], *OF_ALL_KINDS[18:-1]) == whole
    finally:
        batch.CELLS = usual


@FEW
@given(traces(), st.permutations(["x1", "b", "zoe", "a9"]))
def test_names_do_not_matter(trace, others):
    told = labels(trace, *CALCULI, *BOXES)
    other = dict(zip(NAMES, others))
    renamed = labels(changed(trace, names=others), *CALCULI, *BOXES)
    assert renamed == {(name, tuple(other[n] for n in row)): found for (name, row), found in told.items()}


@FEW
@given(traces(), st.permutations(range(4)))
def test_the_order_in_which_things_are_given_does_not_matter(trace, order):
    shuffled = qsr.Trace(
        trace.t,
        tuple(trace.names[i] for i in order),
        tuple(rows[list(order)] for rows in trace.where),
        None if trace.present is None else trace.present[list(order)],
        trace.heading[list(order)],
        tuple(rows[list(order)] for rows in trace.sizes),
    )
    assert labels(shuffled, *CALCULI, *BOXES) == labels(trace, *CALCULI, *BOXES)


@FEW
@given(traces(), eighths, eighths)
def test_where_the_scene_is_does_not_matter(trace, dx, dy):
    assert labels(changed(trace, lambda x, y: (x + dx, y + dy)), *CALCULI, *BOXES) == labels(trace, *CALCULI, *BOXES)


TURNS = ("qdc", "mos", "qtc_b", "qtc_b11", "qtc_c", "qtc_bc", "egocentric", "tpcc", "relative_distance", *BOXES[1:])
A_QUARTER_ON = {"n": "w", "nw": "sw", "w": "s", "sw": "se", "s": "e", "se": "ne", "e": "n", "ne": "nw", "eq": "eq"}
REVERSED = dict(zip(qsr.algebra("allen").relations, qsr.algebra("allen").relations[::-1])) | {
    "starts": "finishes", "finishes": "starts", "started_by": "finished_by", "finished_by": "started_by",
    "during": "during", "contains": "contains",
}  # fmt: skip


def turned(trace):
    return changed(trace, quarter_turn, lambda heading: heading + QUARTER, swap_sides=True)


@FEW
@given(traces())
def test_which_way_the_scene_is_turned_does_not_matter_to_what_knows_no_compass(trace):
    assert labels(turned(trace), *TURNS) == labels(trace, *TURNS)


def each(word, found):
    return {key: [None if label is None else word(label) for label in told] for key, told in found.items()}


@FEW
@given(traces(), st.sampled_from(("cone", "projection")))
def test_a_quarter_turn_turns_cardinal_directions_by_a_quarter(trace, model):
    told = labels(trace, qsr.Cardinal(model))
    assert labels(turned(trace), qsr.Cardinal(model)) == each(A_QUARTER_ON.__getitem__, told)


def turned_rectangle(label):
    x, y = label.split(",")
    return f"{REVERSED[y]},{x}"


@FEW
@given(traces())
def test_a_quarter_turn_exchanges_the_axes_of_rectangles(trace):
    assert labels(turned(trace), "rectangle") == each(turned_rectangle, labels(trace, "rectangle"))


OTHER_SIDE = str.maketrans("-+", "+-")
MIRRORED = {
    "qtc_c": lambda label: label[:2] + label[2:].translate(OTHER_SIDE),
    "qtc_bc": lambda label: label[:2] + label[2:].translate(OTHER_SIDE),
    "cardinal": lambda label: label if label == "eq" else label.translate(str.maketrans("ew", "we")),
    "tpcc": lambda label: label if label in ("dou", "tri", "sam") else label.translate(str.maketrans("lr", "rl")),
    "egocentric": lambda label: "_".join(
        {"left": "right", "right": "left"}.get(part, part) for part in label.split("_")
    ),
    "rectangle": lambda label: f"{REVERSED[label.split(',')[0]]},{label.split(',')[1]}",
}


@FEW
@given(traces())
def test_a_mirror_changes_left_and_right_and_nothing_else(trace):
    mirror = changed(trace, mirrored, lambda heading: np.pi - heading)
    for name in (*CALCULI, *BOXES):
        assert labels(mirror, name) == each(MIRRORED.get(name, str), labels(trace, name))


@FEW
@given(traces(), st.sampled_from((0.25, 2.0, 8.0)))
def test_a_trace_slowed_down_is_told_alike_with_speeds_slowed_down_as_much(trace, slower):
    slow = changed(trace, time=lambda t: t * slower)
    by_speed = labels(trace, qsr.Mos(qsr.Speed(0.5)), qsr.QtcC(qsr.Speed(0.5), margin=qsr.Speed(0.25)))
    assert (
        labels(
            slow, qsr.Mos(qsr.Speed(0.5 / slower)), qsr.QtcC(qsr.Speed(0.5 / slower), margin=qsr.Speed(0.25 / slower))
        )
        == by_speed
    )
    lengths = (qsr.Mos(qsr.Distance(0.25)), qsr.QtcC(qsr.Distance(0.25)))
    timeless = ("qdc", "cardinal", "tpcc", "egocentric", "relative_distance", *BOXES, *lengths)
    assert labels(slow, *timeless) == labels(trace, *timeless)


@FEW
@given(st.lists(st.tuples(eighths, eighths, eighths, eighths), min_size=2, max_size=3), st.sampled_from((2, 4, 8)))
def test_with_speeds_as_thresholds_the_frame_rate_does_not_matter_to_steady_motion(lines, rate):
    def at_rate(steps_a_second):
        t = np.arange(0, 3 * steps_a_second + 1) / steps_a_second
        places = np.array([[(x + u * s, y + v * s) for x, y, u, v in lines] for s in t])
        return labels(qsr.Trace.of(t, NAMES[: len(lines)], places), qsr.Mos(qsr.Speed(0.5)))

    slow, fast = at_rate(1), at_rate(rate)
    assert {key: told[1:] for key, told in slow.items()} == {key: told[rate::rate] for key, told in fast.items()}


@FEW
@given(traces())
def test_what_is_told_of_some_is_what_is_told_of_all(trace):
    every = labels(trace, *CALCULI, "rcc8")
    some = labels(trace, *CALCULI, "rcc8", observer="cup")
    assert some == {key: told for key, told in every.items() if key[1][0] == "cup"}
    named = labels(trace, "qdc", "mos", things=["pan"], pairs=[("jug", "ann")])
    assert named == {key: every[key] for key in named} and len(named) == 2


@pytest.mark.parametrize("name", ["qdc", "qtc_b", "qtc_c", "rcc8", "rcc5", "rectangle", "cardinal"])
@FEW
@given(trace=traces())
def test_a_relation_and_its_converse_hold_together(name, trace):
    converse = qsr.algebra(name).converse if name != "qdc" else lambda label: {label}
    told = labels(trace, name)
    for one, other in itertools.permutations(trace.names, 2):
        for here, there in zip(told[name, (one, other)], told[name, (other, one)]):
            assert (here is None) == (there is None)
            assert here is None or there in converse(here)
