"""The qualitative relations as functions on metres: their bounds, and what a margin does."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper.qsr.plain.motion import approach_by_distance, approach_by_projection, moving, qtc
from casper.qsr.plain.points import qdc

BANDS = (("touch", 1.0), ("near", 2.0), ("medium", 4.0), ("far", 8.0))


@pytest.mark.parametrize(
    ("distance", "label"),
    [(0.0, "touch"), (1.0, "touch"), (1.01, "near"), (2.0, "near"), (3.0, "medium"), (8.0, "far"), (9.0, "far")],
)
def test_a_band_ends_at_its_threshold_and_the_last_never(distance, label):
    assert qdc(distance, BANDS) == label


@pytest.mark.parametrize(
    ("distance", "before", "label"),
    [
        (2.05, "near", "near"),
        (2.1, "near", "near"),
        (2.15, "near", "medium"),
        (0.95, "near", "near"),
        (0.9, "near", "touch"),
        (2.05, None, "medium"),
        (2.05, "touch", "medium"),
        (3.95, "far", "far"),
        (3.8, "far", "medium"),
        (1.05, "touch", "touch"),
        (1.5, "gone", "near"),
    ],
)
def test_with_a_margin_the_band_before_is_kept_a_little_longer(distance, before, label):
    assert qdc(distance, BANDS, before, 0.1) == label
    assert qdc(distance, BANDS, before) == qdc(distance, BANDS)


points = st.tuples(st.floats(-9, 9), st.floats(-9, 9))


@pytest.mark.parametrize("approach", [approach_by_projection, approach_by_distance])
def test_going_nearer_is_positive_and_going_away_negative(approach):
    assert approach((0.0, 0.0), (1.0, 0.0), (5.0, 0.0)) == pytest.approx(1.0)
    assert approach((0.0, 0.0), (-2.0, 0.0), (5.0, 0.0)) == pytest.approx(-2.0)
    assert approach((3.0, 3.0), (1.0, 0.0), (3.0, 3.0)) == 0.0
    assert approach((1.0, 1.0), (1.0, 3.0), (1.0, 6.0)) == pytest.approx(2.0)
    assert approach((1.0, 2.0), (4.0, 6.0), (7.0, 10.0)) == pytest.approx(5.0)


def test_sideways_is_no_approach_by_projection_and_a_little_away_by_distance():
    assert approach_by_projection((0.0, 0.0), (0.0, 3.0), (4.0, 0.0)) == 0.0
    assert approach_by_distance((0.0, 0.0), (0.0, 3.0), (4.0, 0.0)) == pytest.approx(-1.0)


@given(points, points, points)
def test_nobody_comes_nearer_than_along_the_line(before, now, towards):
    if before != towards:
        assert approach_by_distance(before, now, towards) <= approach_by_projection(before, now, towards) + 1e-9


@pytest.mark.parametrize(
    ("approach", "before", "margin", "symbol"),
    [
        (0.2, None, 0.0, "-"),
        (-0.2, None, 0.0, "+"),
        (0.1, None, 0.0, "0"),
        (-0.1, None, 0.0, "0"),
        (0.0, None, 0.0, "0"),
        (0.12, "0", 0.05, "0"),
        (0.16, "0", 0.05, "-"),
        (0.06, "-", 0.05, "-"),
        (0.05, "-", 0.05, "0"),
        (-0.06, "+", 0.05, "+"),
        (-0.06, "-", 0.05, "0"),
        (0.12, None, 0.05, "0"),
    ],
)
def test_an_approach_within_the_threshold_is_none(approach, before, margin, symbol):
    assert qtc(approach, 0.1, before, margin) == symbol


@pytest.mark.parametrize(
    ("displacement", "before", "margin", "moves"),
    [
        (0.1, None, 0.0, False),
        (0.11, None, 0.0, True),
        (0.12, False, 0.05, False),
        (0.16, False, 0.05, True),
        (0.06, True, 0.05, True),
        (0.04, True, 0.05, False),
        (0.12, None, 0.05, True),
    ],
)
def test_who_moves_moves_more_than_the_threshold(displacement, before, margin, moves):
    assert moving(displacement, 0.1, before, margin) is moves


def test_without_a_margin_what_was_before_does_not_matter():
    assert moving(0.12, 0.1, False) is True
    assert moving(0.06, 0.1, True) is False
    assert [qtc(0.12, 0.1, before) for before in ("-", "0", "+", None)] == ["-"] * 4
    assert qdc(2.05, BANDS, "near") == "medium"
