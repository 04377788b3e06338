import dataclasses
import inspect

import pytest

from casper.engine.events import Event
from casper.engine.movements.movements import Movement
from casper.engine.perception.focus import Focus
from casper.engine.perception.perception import Relations
from casper.engine.perception.world import AgentState, ObjectState, WorldState
from casper.streams.items import Given, Line

RECORDS = (AgentState, Event, Focus, Given, Line, Movement, ObjectState, Relations, WorldState)


@pytest.mark.parametrize("kind", RECORDS)
def test_a_record_takes_its_fields_in_their_order_with_their_defaults(kind):
    fields = dataclasses.fields(kind)
    given = dict(inspect.signature(kind).parameters)
    assert list(given) == [field.name for field in fields]
    for field in fields:
        made = None if field.default_factory is not dataclasses.MISSING else field.default
        expected = inspect.Parameter.empty if made is dataclasses.MISSING else made
        assert given[field.name].default == expected


@pytest.mark.parametrize("kind", RECORDS)
def test_a_record_holds_what_it_was_made_of_and_stays_as_it_is(kind):
    names = [field.name for field in dataclasses.fields(kind)]
    record = kind(*names)
    assert [getattr(record, name) for name in names] == names
    assert dataclasses.replace(record, **{names[0]: "other"}) == kind("other", *names[1:])
    with pytest.raises(dataclasses.FrozenInstanceError):
        setattr(record, names[0], "other")


def test_events_without_data_share_none():
    one, other = Event("warning", 0.0), Event("warning", 0.0)
    assert one.data == {} and one.data is not other.data
