"""Loading lets the garbage collector rest, and leaves it as it was."""

import gc

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.errors import ReadError
from casper.kb.store.loading import loading


def test_the_collector_rests_while_loading_and_goes_on_after_it():
    with loading():
        assert not gc.isenabled()
        with loading():
            pass
        assert not gc.isenabled()
    assert gc.isenabled()


def test_a_mistake_does_not_keep_it_from_going_on():
    with pytest.raises(ReadError):
        KnowledgeBase.from_text("p(a")
    assert gc.isenabled()


def test_one_that_was_off_stays_off():
    gc.disable()
    try:
        KnowledgeBase.from_text("p(a).")
        assert not gc.isenabled()
    finally:
        gc.enable()
