"""What minds say does not depend on how a Python adds floats up: from 3.12 on its `sum` is more exact than before."""

import builtins
import json
import math
import random

import pytest

from casper import Domain
from casper.engine.live import Partners, by_day
from casper.engine.perception.world import AgentState, ObjectState, WorldState

PLAIN = builtins.sum


def exact(values, start=0):
    """As `sum` of later Pythons, or still more exact."""
    values = list(values)
    return math.fsum([start, *values]) if any(type(value) is float for value in values) else PLAIN(values, start)


def one_by_one(values, start=0):
    """As `sum` of Python 3.11."""
    for value in values:
        start = start + value
    return start


def worlds(noise):
    """Somebody who goes round the kitchen with the glass and without."""
    source, things = random.Random(3), {"glass": (1.0, 0.5), "bottle": (2.0, 1.5), "sink": (3.0, 0.0)}
    for n in range(500):
        held = "glass" if 40 < n % 160 < 110 else None
        x, y = 1.6 + 1.4 * math.cos(n / 25), 0.7 + 0.8 * math.sin(n / 25)
        seen = dict(things, glass=(x, y)) if held else things
        objects = {k: ObjectState(a + source.gauss(0, noise), b + source.gauss(0, noise), 0.9) for k, (a, b) in seen.items()}
        human = AgentState(x + source.gauss(0, noise), y + source.gauss(0, noise), n / 25, held)
        yield WorldState(n / 4, {"human": human}, objects)


@pytest.mark.parametrize("noise", [0.0, 0.06])
@pytest.mark.parametrize("choices", [{}, {"noise": 0.1}, {"goals": 2, "noise": 0.07}, {"by_day": True}])
def test_events_are_the_same_however_floats_are_added_up(monkeypatch, noise, choices):
    told = []
    for adding in (one_by_one, exact):
        monkeypatch.setattr(builtins, "sum", adding)
        domain = Domain.load("kitchen")
        minds = Partners(domain, **({"segments": by_day(domain)} if "by_day" in choices else choices))
        events = [event for world in worlds(noise) for event in minds.update(world)]
        told.append([json.dumps(event.to_json()) for event in events])
    monkeypatch.undo()
    assert told[0] == told[1]
