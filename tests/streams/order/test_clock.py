"""A clock that jumps: what follows decides whether it was a pause, a clock that was set, or a mistake."""

from streamed import state, times, warnings, watch


def test_one_time_far_ahead_is_a_mistake_and_the_rest_goes_on():
    events = watch(state(1), state(1e9), state(2), state(3))
    assert times(events) == [1, 2, 3]
    assert warnings(events) == ["line 2 is left out: its time t=1e+09 is 1e+09 s after t=1, and nothing that follows agrees"]


def test_one_time_far_back_is_a_mistake_and_the_rest_goes_on():
    events = watch(state(100), state(3), state(101))
    assert times(events) == [100, 101]
    assert len(warnings(events)) == 1


def test_a_pause_is_told_and_nothing_behind_it_is_lost():
    events = watch(state(1), state(4000), state(4000.5), state(4001))
    assert times(events) == [1, 4000, 4000.5, 4001]
    assert warnings(events) == ["line 2: nothing came from t=1 to t=4000"]


def test_a_clock_that_was_set_back_is_counted_on():
    events = watch(state(100), state(100.5), state(0), state(0.5), state(1), state(1.5))
    assert times(events) == [100, 100.5, 101, 101.5, 102, 102.5]
    assert warnings(events) == ["line 3: the clock was set back from t=100.5 to t=0; from here 101 s are added"]


def test_a_first_time_that_was_wrong_does_not_shut_out_the_others():
    events = watch(state(1e6), state(1), state(2), state(3), state(4))
    assert len(times(events)) == 5
    assert len(warnings(events)) == 1


def test_a_slow_stream_is_no_stream_of_jumps():
    events = watch(*(state(90.0 * n) for n in range(5)))
    assert times(events) == [90.0 * n for n in range(5)]
    assert [w for w in warnings(events) if "left out" in w] == []


def test_what_is_doubted_at_the_end_is_told():
    events = watch(state(1), state(1e9))
    assert times(events) == [1]
    assert "nothing that follows agrees" in warnings(events)[0]
