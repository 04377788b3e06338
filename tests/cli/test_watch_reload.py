"""``casper watch --reload``: changes in the domain's files are taken in between two world states, and told."""

import json
import shutil

import pytest

from casper.engine.domain.domain import SHIPPED, Domain
from casper.engine.mind import Mind
from casper.streams.watching import watched

STATE = {
    "agents": {"human": {"x": 0.0, "y": 0.0, "heading": 0.0, "holding": None}},
    "objects": {"plate": {"x": 0.5, "y": 0.0, "z": 0.7}},
}


@pytest.fixture
def folder(tmp_path):
    shutil.copytree(SHIPPED / "kitchen", tmp_path / "kitchen")
    return tmp_path / "kitchen"


def lines(folder, *changes):
    """World states; before each but the first a change of a file."""
    yield json.dumps({"t": 1.0, **STATE})
    for number, (file, text) in enumerate(changes, 2):
        (folder / file).write_text((folder / file).read_text() + text)
        yield json.dumps({"t": float(number), **STATE})


def warnings(events):
    return [event.data["message"] for event in events if event.type == "warning"]


def test_a_change_is_told_and_the_watch_goes_on(folder):
    changes = [("ontology.pl", "sink(tub).\n"), ("plans.pl", "goal(rest"), ("ontology.pl", "\n")]
    events = list(watched(Mind(Domain.load(folder)), lines(folder, *changes), reload=True))
    told = warnings(events)
    assert told[0] == "the domain was read anew"
    assert "the changed domain is not taken" in told[1] and "plans.pl:14" in told[1]
    assert [event.t for event in events if event.type == "movement"] == [1.0, 2.0, 3.0, 4.0]


def test_without_the_option_nothing_is_read_anew(folder):
    events = list(watched(Mind(Domain.load(folder)), lines(folder, ("ontology.pl", "sink(tub).\n"))))
    assert warnings(events) == []
