"""Between two episodes what nobody holds any more goes; the events are those there were."""

import gc
import weakref

from hypothesis import given
from hypothesis import strategies as st

from casper.engine.events.event import Event
from casper.engine.live.memory import Uninterrupted, tidied


class Circle:
    """Something that only the collector sees to be held by nobody."""

    def __init__(self):
        self.itself = self


@given(st.lists(st.sampled_from(["action", "episode", "reading"]), max_size=8))
def test_events_pass_as_they_are(types):
    events = [Event(name, float(t), {}) for t, name in enumerate(types)]
    assert list(tidied(events)) == events


def test_after_an_episode_nothing_is_left_of_what_nobody_holds():
    gc.disable()
    try:
        seen = weakref.ref(Circle())
        events = tidied([Event("action", 0.0, {}), Event("episode", 1.0, {}), Event("action", 2.0, {})])
        next(events), next(events)
        assert seen() is not None
        next(events)
        assert seen() is None
    finally:
        gc.enable()


def test_within_a_step_nothing_is_collected_and_afterwards_it_is_as_before():
    for is_on in (True, False):
        (gc.enable if is_on else gc.disable)()
        try:
            with Uninterrupted():
                assert not gc.isenabled()
            assert gc.isenabled() == is_on
        finally:
            gc.enable()
