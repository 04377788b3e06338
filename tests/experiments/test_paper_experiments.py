"""The paper's tables and figures come out, and each is drawn of its data file alone."""

import json
import re
from pathlib import Path

import pytest

from casper.engine.domain.domain import Domain
from casper.experiments.experiment import Asked, Data, shown
from casper.experiments.figures.focus import _covers, spread
from casper.experiments.figures.movements import forks
from casper.experiments.files import read_data
from casper.experiments.page import block, renewed
from casper.experiments.paper.verification import verdict
from casper.experiments.printed import GOAL_ROWS, SEQUENCES, WINNERS
from casper.experiments.registry import EXPERIMENTS, KITCHEN, named
from casper.experiments.runner import Where, run_experiments
from casper.kb.errors import CasperError

ASKED = Asked(Domain.load("kitchen"))
GOLDEN = Path(__file__).parents[1] / "golden"
DOCS = Path(__file__).parents[2] / "docs"


def worked(name: str, found=()) -> Data:
    return EXPERIMENTS[name].work(ASKED, lambda trials: [dict(row) for row in found])


# --- what comes out -------------------------------------------------------------------------------------------------


def test_every_row_of_the_goal_table_is_as_printed():
    data = worked("goals")
    assert len(data.rows) == len(GOAL_ROWS) and all(row["equal"] for row in data.rows)


def test_the_printed_numbers_are_those_of_the_golden_files():
    rows = json.loads((GOLDEN / "goal_reasoner.json").read_text())["rows"]
    told = [(r["trial"], r["observations"][-1], r["explanations"], r["confidence"], r["outcome"]) for r in rows]
    assert told == [(r.trial, r.observation, r.explanations, r.confidence, r.outcome) for r in GOAL_ROWS]
    curves = json.loads((GOLDEN / "fsm_response.json").read_text())["letters"]["first"]
    assert {name: curve["winner"]["step"] for name, curve in curves.items()} == WINNERS
    assert {name: tuple(map(str.lower, curve["movements"])) for name, curve in curves.items()} == SEQUENCES


def test_the_machines_win_at_the_printed_steps():
    rows = [row for row in worked("responses").summary if row["recogniser"] == "the paper's letters"]
    assert {row["winner"]: row["step"] for row in rows} == WINNERS


def test_the_example_of_the_score_adds_up_to_one():
    shares = [row["share"] for row in worked("score").summary]
    assert shares == pytest.approx([0.6, 0.4])


def test_the_plans_are_the_papers():
    assert [row["actions"] for row in worked("plans").summary] == [4, 4, 6]


def trial(goal, seed, **told):
    told = {"right": True, "predicted": goal, "helped": True, "prediction_time": 10.0, "partner_finished": 30.0, **told}
    rest = {"observed": 1, "missed": 0, "waiting": 1, "planned": 2, "wrong_announcements": 0, "wrong_interventions": []}
    return {"trial": {"goal": goal, "seed": seed}, "gave_up": None, "help_ended": True, "least_distance": None, "mistake": None, **rest, **told}


def test_the_kitchen_table_has_the_means_of_each_goal():
    found = [trial("lunch", 1, observed=1), trial("lunch", 2, observed=2, prediction_time=20.0, right=False)]
    (row,) = worked("results", found).summary
    assert (row["observed"], row["prediction_time"], row["right"], row["helped"]) == (1.5, 15.0, 0.5, 1)


def test_a_trial_that_broke_off_counts_as_such():
    lost = dict.fromkeys(trial("lunch", 3)) | {"trial": {"goal": "lunch", "seed": 3}, "mistake": "no goal"}
    data = worked("results", [trial("lunch", 1), lost])
    assert data.about["broken off"] == 1 and data.summary[0]["trials"] == 1
    many = worked("many", [trial("lunch", 1), lost]).summary[-1]
    assert (many["trials"], many["right"], many["broken off"]) == (2, 1, 1)


def test_verification_is_compared_where_both_read_the_goal():
    pairs = [(10.0, 20.0, True), (12.0, 30.0, True), (10.0, 5.0, False)]
    found = [t for at, (a, b, right) in enumerate(pairs) for t in (trial("drink", at, prediction_time=a), trial("drink", at, prediction_time=b, right=right))]
    row = worked("verification", found).summary[-1]
    assert (row["trials"], row["pairs"], row["mean"]) == (3, 2, 14.0)


@pytest.mark.parametrize(
    ("low", "high", "says"),
    [(1, 2, "predicts earlier"), (-2, -1, "predicts later"), (-1, 1, "No difference"), (None, None, "Not decided")],
)
def test_the_page_says_whether_verification_is_earlier(low, high, says):
    assert says in verdict({"low": low, "high": high, "mean": 1.5})


# --- figures and pages ----------------------------------------------------------------------------------------------


def test_the_same_data_give_the_same_figures_and_page(tmp_path):
    names, where = ["score", "goals"], Where(tmp_path)
    written = [file for _, _, files in run_experiments(names, where) for file in files]
    assert {file.name for file in written} >= {"score.svg", "score.png", "score.csv", "goals.json"}
    before = {file.name: file.read_bytes() for file in tmp_path.iterdir()}
    for file in written:
        if file.suffix in (".svg", ".png"):
            file.unlink()
    list(run_experiments(names, Where(tmp_path, redraw=True)))
    assert {file.name: file.read_bytes() for file in tmp_path.iterdir()} == before


def test_the_questions_of_the_tree_are_found_again_from_its_leaves():
    leaves = [
        {"allowed": [["still"], ["free"], ["touch"], ["-"]], "label": "pick", "samples": 3},
        {"allowed": [["still"], ["holding"], ["touch"], ["-"]], "label": "place", "samples": 4},
        {"allowed": [["moving"], ["free", "holding"], ["touch"], ["-"]], "label": "walk", "samples": 5},
    ]
    root = forks(leaves)
    assert (root.text, root.below[0].text, root.below[1].label) == ("MOS is\nstill?", "HOLD is\nfree?", "walk")
    assert root.samples == 12


def test_no_plot_of_the_map_hides_another_or_an_object():
    things = {f"o{at}": (0.4 * at, 0.1 * at) for at in range(6)}
    corners = spread(things, [(0.2, 0.2)], (-3, -3), (4, 4))
    for name, corner in corners.items():
        assert not any(_covers(corner, spot, 0) for spot in things.values())
        others = [other for other in corners if other != name]
        assert not any(_covers(corner, corners[other], 0) for other in others)


def test_a_part_of_a_page_is_renewed_in_its_place():
    data = worked("score")
    part = block(EXPERIMENTS["score"], data, "paper/")
    page = renewed(renewed("# Mine\n\nkept\n", "score", part), "plans", block(EXPERIMENTS["plans"], worked("plans"), ""))
    other = renewed(page, "score", "<!-- experiment score -->\nnew\n<!-- experiment score: end -->")
    assert page.startswith("# Mine\n\nkept\n") and "paper/score.svg" in page
    assert other.count("experiment score -->") == 1 and "\nnew\n" in other and "experiment plans: end" in other


@pytest.mark.parametrize(("value", "text"), [(None, "–"), (True, "yes"), (2.0, "2"), (0.125, "0.12"), ("a", "a"), (3, "3")])
def test_values_are_shown_briefly(value, text):
    assert shown(value) == text


# --- what cannot be used --------------------------------------------------------------------------------------------


def test_kitchen_is_all_of_the_paper():
    assert named(["kitchen", "goals"]) == list(KITCHEN)


def test_an_unknown_experiment_is_told_with_the_nearest_names(tmp_path):
    with pytest.raises(CasperError, match=r"no experiment 'goalz'.*did you mean goals"):
        list(run_experiments(["goalz"], Where(tmp_path)))


def test_a_folder_that_cannot_be_written_is_told_before_anything_is_run(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(CasperError, match=r"cannot write to .*choose another folder with --out"):
        list(run_experiments(["results"], Where(tmp_path / "file" / "below")))


def test_a_missing_library_is_told(tmp_path, monkeypatch):
    monkeypatch.setattr("casper.experiments.runner.find_spec", lambda name: None if name == "matplotlib" else name)
    with pytest.raises(CasperError, match=re.escape("casper-hri[plot]")):
        list(run_experiments(["goals"], Where(tmp_path)))


@pytest.mark.parametrize(
    ("given", "says"),
    [({"trials": 0}, "whole number from 1"), ({"seed": -1}, "seed"), ({"jobs": 0}, "whole number from 1")],
)
def test_numbers_that_are_none_are_told(tmp_path, given, says):
    where = Where(tmp_path, jobs=given.pop("jobs", 1))
    with pytest.raises(CasperError, match=says):
        list(run_experiments(["goals"], where, **given))


@pytest.mark.parametrize("text", [None, "no JSON", "[]", "{}"])
def test_what_cannot_be_drawn_is_told(tmp_path, text):
    if text is not None:
        (tmp_path / "goals.json").write_text(text)
    with pytest.raises(CasperError, match="without --redraw"):
        list(run_experiments(["goals"], Where(tmp_path, redraw=True)))


# --- the page of this repository ------------------------------------------------------------------------------------


def parts_of(page: str) -> list[str]:
    text = (DOCS / f"{page}.md").read_text()
    return re.findall(r"<!-- experiment (\w+) -->\n.*?<!-- experiment \w+: end -->", text, re.DOTALL)


@pytest.mark.parametrize(("page", "name"), [(page, name) for page in ("paper", "studies") for name in parts_of(page)])
def test_a_page_is_what_its_data_say_and_is_not_typed(page, name):
    part = block(EXPERIMENTS[name], read_data(DOCS / page, name), f"{page}/")
    assert part in (DOCS / f"{page}.md").read_text()


def test_the_page_has_all_of_the_paper():
    assert [experiment.name for experiment in KITCHEN] == parts_of("paper")
