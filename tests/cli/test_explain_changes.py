"""``casper explain --changes`` and ``casper train --plans``."""

import json

import pytest
from days import BREAKFAST, LUNCH

from casper.cli import app


@pytest.fixture
def casper():
    from typer.testing import CliRunner

    return lambda *arguments: CliRunner().invoke(app, list(arguments))


def test_an_explanation_is_a_row_of_episodes_with_their_trees(casper):
    said = casper("explain", "kitchen", *LUNCH[:2], *BREAKFAST, "--changes", "0.05", "--top", "1").output
    assert "breakfast: finished (4 seen, 3 to 6)" in said and "lunch: under way (2 seen, 1 to 2)" in said
    assert "● wash(plate, sink)" in said and "○ pick_and_place(meal, plate)" in said


def test_its_json_has_the_fields_of_a_reading_and_more(casper):
    lines = casper("explain", "kitchen", *LUNCH[:2], "dance", "--changes", "0.05", "--json").output.splitlines()
    told = [json.loads(line) for line in lines]
    assert len(told) == 3 and told[1]["outcome"] == "lunch" and told[1]["best"][0]["goal"] == "lunch"
    assert told[2]["needless"][0]["reasons"] == ["no plan has the action dance"]


def test_pictures_and_questions_are_not_of_rows(casper):
    assert "leave --picture and --questions out" in str(casper("explain", "kitchen", "eat", "--changes", "0.1", "--questions", "1").exception)


def test_prices_are_learned_from_records(casper, tmp_path):
    (tmp_path / "day.jsonl").write_text("".join(json.dumps({"action": action}) + "\n" for action in BREAKFAST))
    told = json.loads(casper("train", "kitchen", "--plans", str(tmp_path / "day.jsonl"), "--json").output)
    assert told["observations"] == 4 and told["episodes"] == 1 and 0 < told["needless"] < 0.01
    out = tmp_path / "prices.pl"
    said = casper("train", "kitchen", "--plans", str(tmp_path / "day.jsonl"), "--output", str(out)).output
    assert "setting(plans, begin, " in said and out.read_text() in said
