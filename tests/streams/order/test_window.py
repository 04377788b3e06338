"""What comes late or twice is put in order within a window, and left out with a sentence beyond it."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st
from streamed import line, state, times, warnings, watch

from casper.engine.live import Report
from casper.engine.perception.world import WorldState
from casper.kb.errors import CasperError
from casper.streams.items import Given, Line, Note
from casper.streams.order.messages import messages
from casper.streams.order.window import MOST, Window, check_window, in_order


def ordered(*what, window):
    return list(in_order(messages(Line(line(each), n) for n, each in enumerate(what, 1)), window))


def report(t):
    return json.dumps({"type": "robot", "t": t, "action": "wash(plate, sink)", "status": "done"})


def test_a_state_within_the_window_is_put_in_its_place():
    events = watch(state(1), state(2), state(1.5), state(3), window=1)
    assert times(events) == [1, 1.5, 2, 3]
    assert warnings(events) == []


def test_a_state_later_than_the_window_is_left_out_and_the_sentence_says_what_window_it_takes():
    events = watch(state(1), state(3), state(1.5), state(4), window=1)
    assert times(events) == [1, 3, 4]
    assert warnings(events) == ["line 3 is left out: t=1.5 came after t=3; --window 1.5 or more puts it in order"]


def test_without_a_window_every_state_is_told_at_once():
    window = Window(0.0)
    first, second = ordered(state(1), state(2), window=0)
    assert list(window.take(first)) == [first]
    assert list(window.take(second)) == [second]


def test_a_window_holds_back_what_may_still_be_preceded():
    window = Window(1.0)
    first, second, third = ordered(state(1), state(1.5), state(2.5), window=0)
    assert [list(window.take(each)) for each in (first, second, third)] == [[], [], [first, second]]
    assert list(window.rest()) == [third]


@pytest.mark.parametrize("window", [0.0, 1.0])
def test_repeats_are_told_once_and_counted(window):
    events = watch(state(1), state(1), state(1), state(2), window=window)
    assert times(events) == [1, 2]
    assert warnings(events) == [
        "line 2 is left out: it repeats line 1; more that do so are counted",
        "2 lines that repeat a world state were left out in all",
    ]


def test_another_state_of_the_same_time_is_left_out_with_both_places():
    (message,) = warnings(watch(state(1), state(1, human=(0.1, 0)), window=1))
    assert message.startswith("line 2 is left out: time must advance") and "was at line 1, too, and differs" in message


def test_a_report_stands_behind_the_state_of_its_time():
    found = ordered(state(1), report(2), state(2), state(4), window=1)
    assert [(item.message.t, isinstance(item.message, Report)) for item in found] == [(1, False), (2, False), (2, True), (4, False)]


def test_a_report_of_the_past_is_left_out():
    _, note, _, last = ordered(state(1), state(5), report(3), state(6), window=1)
    assert note.sentence.startswith("line 3 is left out: time must not run backwards: what the robot did at t=3")
    assert last.message.t == 6


def test_what_waits_is_bounded():
    window = Window(1e9)
    told = [item for t in range(MOST + 3) for item in window.take(Given(WorldState(float(t), {}, {}), t))]
    assert [item.message.t for item in told] == [0.0, 1.0, 2.0]


@pytest.mark.parametrize("seconds", [-1.0, float("nan"), float("inf")])
def test_a_window_that_is_none_is_refused(seconds):
    with pytest.raises(CasperError, match="a finite number of seconds from 0"):
        check_window(seconds)


@given(st.lists(st.tuples(st.integers(0, 40), st.integers(0, 3)), max_size=40), st.integers(0, 6))
def test_whatever_comes_what_is_told_advances_and_nothing_within_the_window_is_lost(steps, window):
    """Each line has its time (tenths of a second) and may be late; every other one is told of in a sentence."""
    lines = [state(t / 10, human=(late / 10, 0)) for t, late in steps]
    found = ordered(*lines, window=window / 10)
    told = [item.message.t for item in found if isinstance(item, Given)]
    assert told == sorted(set(told))
    newest, due = -1.0, set()
    for t, _ in steps:
        newest = max(newest, t / 10)
        due |= {t / 10} if newest - t / 10 <= window / 10 and (t / 10 == newest or window) else set()
    assert due <= set(told)
    first_repeats = sum("repeats line" in item.sentence for item in found if isinstance(item, Note))
    assert len(told) + sum("is left out" in item.sentence for item in found if isinstance(item, Note)) >= len(set(map(str, lines)))
    assert first_repeats <= 1


@given(st.permutations(range(12)))
def test_a_shuffle_by_less_than_the_window_comes_out_sorted(order):
    newest, late = -1, 0
    for t in order:
        newest = max(newest, t)
        late = max(late, newest - t)
    found = ordered(*(state(float(t)) for t in order), window=float(late))
    assert [item.message.t for item in found] == [float(t) for t in range(12)]
