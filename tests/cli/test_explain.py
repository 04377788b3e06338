import json
from pathlib import Path

import pytest

ROWS = json.loads((Path(__file__).parent.parent / "golden/goal_reasoner.json").read_text())["rows"]


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row['trial']}-{len(row['observations'])}")
def test_the_last_line_is_the_papers_row(casper, row):
    told = casper("explain", "kitchen", *row["observations"], "--json")
    last = told.json[-1]
    assert (last["explanations"], round(last["confidence"], 2), last["outcome"]) == (
        row["explanations"],
        row["confidence"],
        row["outcome"],
    )


def test_there_is_one_line_an_observation_with_the_keys_of_the_design(casper):
    told = casper("explain", "kitchen", "pick_and_place(meal, hobs)", "cook", "--json")
    assert [line["observations"] for line in told.json] == [
        ["pick_and_place(meal, hobs)"],
        ["pick_and_place(meal, hobs)", "cook"],
    ]
    assert set(told.json[0]) == {
        "observations", "explanations", "confidence", "outcome", "posterior", "best", "frontier", "rejected",
    }  # fmt: skip
    assert told.json[1]["best"][0]["leaves"][1] == {"action": "cook(meal, hobs)", "status": "observed"}


def test_an_action_on_the_biscuits_rules_lunch_out_and_says_why(casper):
    told = casper("explain", "kitchen", "pick_and_place(biscuits, plate)", "--json")
    reasons = {entry["goal"]: entry["reasons"] for entry in told.json[0]["rejected"]}
    assert told.json[0]["outcome"] == "breakfast"
    assert "Food of lunch is meal, not biscuits" in reasons["lunch"]


def test_without_verification_only_the_names_count(casper):
    told = casper("explain", "kitchen", "pick_and_place(biscuits, plate)", "--no-verification", "--json")
    assert told.json[0]["explanations"] == 7


def test_the_policy_best_commits_where_strict_waits(casper):
    assert casper("explain", "kitchen", "eat", "--json").json[0]["outcome"] is None
    assert casper("explain", "kitchen", "eat", "--policy", "best", "--json").json[0]["outcome"] == "breakfast"


def test_top_bounds_how_many_explanations_are_shown(casper):
    assert len(casper("explain", "kitchen", "wash", "--top", "2", "--json").json[0]["best"]) == 2


def test_a_person_is_shown_bars_trees_and_reasons(casper):
    told = casper("explain", "kitchen", "pick_and_place", "eat")
    assert "● eat(biscuits, plate)" in told.out
    assert "not this: drink has no eat" in told.out


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["explain", "kitchn", "eat"], "there is no domain 'kitchn'"),
        (["explain", "kitchen", "eet"], "did you mean eat?"),
        (["explain", "kitchen", "eat(biscuits)"], "eat takes 2 arguments here (the agent is left out), not 1"),
        (["explain", "kitchen", "eat(biscuits,"], "the text ends here"),
        (["explain", "kitchen", "eat", "--policy", "bold"], "choose strict or best"),
    ],
)
def test_a_mistake_is_one_sentence_and_exit_code_2(casper, arguments, sentence):
    told = casper(*arguments)
    assert told.code == 2
    assert sentence in told.err
    assert told.out == ""
