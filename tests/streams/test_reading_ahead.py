"""A recording of which many lines are read before the first is taken in tells what it tells line by line."""

import json
import math

import pytest

from casper import Domain
from casper.engine.live import Partners
from casper.streams.watching import watched


def recording():
    """Somebody who walks from thing to thing; a line that is none, one that is late, one that comes twice."""
    things = {"glass": (1.0, 0.5), "bottle": (2.0, 1.5), "sink": (3.0, 0.0)}
    objects = {name: {"x": x, "y": y, "z": 0.9} for name, (x, y) in things.items()}
    lines = []
    for n in range(120):
        at = {"x": 0.03 * n, "y": 0.2 * math.sin(n / 9), "heading": 0.01 * n, "holding": "glass" if 40 < n < 80 else None}
        lines.append(json.dumps({"t": n / 4, "agents": {"human": at}, "objects": objects}))
    lines[30:30] = ["no JSON", lines[28], lines[5]]
    return [*lines, lines[-1]]


@pytest.mark.parametrize("ahead", [2, 64, 1000])
def test_the_events_are_those_of_a_watch_line_by_line(ahead):
    domain = Domain.load("kitchen")
    said = [[event.to_json() for event in watched(Partners(domain), recording(), window=1.0, ahead=n)] for n in (1, ahead)]
    assert said[0] == said[1]
    assert {event["type"] for event in said[0]} >= {"focus", "movement", "warning", "summary"}
