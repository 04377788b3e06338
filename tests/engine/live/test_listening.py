"""Who listens to a run sees each moment once, and what stood behind an event before the next one comes."""

from types import SimpleNamespace

from casper.engine.events.event import Event
from casper.engine.live.listening import Listener, followed
from casper.engine.perception.world import WorldState


class Notes(Listener):
    def __init__(self):
        super().__init__()
        self.notes = []

    def seen(self, world):
        self.notes.append(world.t)

    def take(self, event, minds):
        self.notes.append((event.type, minds.name))


def world(t):
    return WorldState(t, {}, {})


def test_a_world_state_that_is_no_later_than_the_last_is_left_out():
    listener = Notes()
    for state in (None, world(1.0), world(1.0), world(0.5), world(2.0), None):
        listener.see(state)
    assert listener.notes == [1.0, 2.0]


def test_the_world_is_seen_before_an_event_is_heard_and_that_before_it_is_passed_on():
    now, listener = {}, Notes()

    def happening():
        for t, name in ((1.0, "first"), (2.0, "made anew")):
            now["minds"] = SimpleNamespace(tracker=SimpleNamespace(latest=world(t)), name=name)
            yield Event("focus", t, {})

    heard = [list(listener.notes) for _ in followed(happening(), [listener], lambda: now["minds"])]
    first = [1.0, ("focus", "first")]
    assert heard == [first, [*first, 2.0, ("focus", "made anew")]]
