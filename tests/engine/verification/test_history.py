"""What happened earlier today is remembered for did/2, within bounds: what was done again loses its earliest times first."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper import KnowledgeBase
from casper.engine.verification.history import History, history_settings
from casper.kb.errors import DomainError
from casper.kb.terms.terms import Compound


def statement(name):
    return Compound((name, "ann"))


def done(history):
    return [(statement.functor, seconds) for statement, seconds in history]


def test_as_long_as_there_is_room_everything_is_remembered():
    history = History(3)
    for t, name in enumerate("aba"):
        history.remember(statement(name), float(t))
    assert done(history) == [("a", 0.0), ("b", 1.0), ("a", 2.0)]
    assert history.lost is None


def test_of_what_was_done_again_the_earliest_time_goes_first():
    history = History(3)
    for t, name in enumerate("baac"):
        history.remember(statement(name), float(t))
    assert done(history) == [("b", 0.0), ("a", 2.0), ("c", 3.0)]
    assert history.lost is None


def test_where_nothing_was_done_again_what_was_done_longest_ago_is_lost_and_that_is_known():
    history = History(2)
    for t, name in enumerate("abc"):
        history.remember(statement(name), float(t))
    assert done(history) == [("b", 1.0), ("c", 2.0)]
    assert history.lost == statement("a")


@given(st.lists(st.sampled_from("abcdef")), st.integers(1, 8))
def test_no_statement_is_lost_while_there_is_a_row_for_each(names, most):
    history = History(most)
    for t, name in enumerate(names):
        history.remember(statement(name), float(t))
    assert len(history) == min(most, len(names))
    assert [seconds for _, seconds in history] == sorted(seconds for _, seconds in history)
    if len(set(names)) <= most:
        assert {functor for functor, _ in done(history)} == set(names)
        assert history.lost is None
    latest = {name: float(t) for t, name in enumerate(names)}
    kept = {name: seconds for name, seconds in done(history)}
    assert all(latest[name] == seconds for name, seconds in kept.items())


def test_how_much_is_remembered_is_a_setting():
    stated = KnowledgeBase.from_text("setting(verification, remembered, 7).")
    assert history_settings(stated.rows).remembered == 7
    with pytest.raises(DomainError, match=r"setting\(verification, remembered, 0\) starts at 1"):
        history_settings(KnowledgeBase.from_text("setting(verification, remembered, 0).").rows)
