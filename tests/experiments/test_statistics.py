"""Intervals and the paired test keep the laws that any such figures must keep."""

import itertools
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper.experiments.statistics import EXACT, mean_interval, paired, share_interval

VALUES = st.floats(-100, 100).map(lambda x: round(x, 3))
PAIRS = st.lists(st.tuples(VALUES, VALUES), min_size=1, max_size=8)


@given(PAIRS)
def test_the_exact_test_counts_the_exchanges_that_are_as_far_out(pairs):
    d = [a - b for a, b in pairs]
    sums = [abs(sum(s * x for s, x in zip(signs, d))) for signs in itertools.product((1, -1), repeat=len(d))]
    out = sum(total >= abs(sum(d)) - 1e-9 * sum(map(abs, d)) for total in sums)
    assert paired(*zip(*pairs)).p == pytest.approx(out / len(sums))


@given(PAIRS)
def test_exchanging_both_sides_turns_the_difference_round_and_leaves_the_test(pairs):
    one, other = zip(*pairs)
    there, back = paired(one, other), paired(other, one)
    assert there.mean == pytest.approx(-back.mean) and there.p == back.p
    assert there.low <= there.mean + 1e-9 and there.mean <= there.high + 1e-9


@given(st.lists(VALUES, min_size=1, max_size=30))
def test_equal_sides_show_no_difference(values):
    found = paired(values, values)
    assert (found.mean, found.low, found.high, found.p) == (0, 0, 0, 1)


def test_many_pairs_are_drawn_and_a_clear_difference_is_seen():
    found = paired([10.0 + at % 3 for at in range(60)], [at % 2 for at in range(60)])
    assert EXACT < 60 and found.low > 0 and found.p < 0.001
    assert paired([0.0, 1.0] * 30, [1.0, 0.0] * 30).p > 0.9


def test_no_pairs_say_nothing():
    assert paired([], []).p is None


@given(st.lists(VALUES, min_size=1, max_size=20))
def test_the_same_values_have_the_same_interval(values):
    assert mean_interval(values) == mean_interval(values)


@given(st.integers(1, 400).flatmap(lambda n: st.tuples(st.integers(0, n), st.just(n))))
def test_the_interval_of_a_share_holds_it_and_lies_between_0_and_1(counted):
    hits, count = counted
    low, high = share_interval(hits, count)
    assert 0 <= low <= hits / count + 1e-12 and hits / count - 1e-12 <= high <= 1
    assert share_interval(count - hits, count) == pytest.approx((1 - high, 1 - low))


def test_the_interval_of_a_share_is_wilsons():
    assert share_interval(15, 15)[0] == pytest.approx(1 / (1 + 1.959963984540054**2 / 15))
    assert math.isclose(share_interval(15, 15)[1], 1)


@pytest.mark.parametrize(("hits", "count"), [(1, 0), (0, 0), (3, 2), (-1, 4)])
def test_what_is_no_share_is_refused(hits, count):
    with pytest.raises(ValueError):
        share_interval(hits, count)


def test_values_that_are_no_pairs_are_refused():
    with pytest.raises(ValueError, match="2 and 1"):
        paired([1, 2], [1])
