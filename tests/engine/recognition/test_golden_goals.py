"""The paper's goal table (table "results on the Goal Reasoner"), row by row, through the command line's own JSON."""

import json
from pathlib import Path

import pytest

from casper import Domain

ROWS = json.loads((Path(__file__).parents[2] / "golden/goal_reasoner.json").read_text())["rows"]
KITCHEN = Domain.load("kitchen")


@pytest.mark.parametrize("verification", [True, False])
@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row['trial']}-{'-'.join(row['observations'])}")
def test_the_reading_is_that_of_the_paper(row: dict, verification: bool) -> None:
    reading = KITCHEN.reading("strict", verification)
    for action in row["observations"]:
        reading.observe(action)
    told = reading.to_json()
    assert told["explanations"] == row["explanations"]
    assert round(told["confidence"], 2) == row["confidence"]
    assert told["outcome"] == row["outcome"]
