"""``casper experiment``: names, output, mistakes."""

import json

from casper.experiments.registry import EXPERIMENTS


def test_without_a_name_it_lists_what_there_is(casper):
    told = casper("experiment")
    assert [line.split()[0] for line in told.out.splitlines()] == list(EXPERIMENTS)
    assert [row["experiment"] for row in casper("experiment", "--json").json] == list(EXPERIMENTS)


def test_json_has_one_object_a_condition(casper, tmp_path):
    rows = casper("experiment", "score", "plans", "--out", str(tmp_path), "--json").json
    assert [row["experiment"] for row in rows] == ["score"] * 2 + ["plans"] * 3
    assert json.loads((tmp_path / "score.json").read_text())["summary"] == [
        {key: value for key, value in row.items() if key != "experiment"} for row in rows[:2]
    ]


def test_what_was_found_is_drawn_anew_without_running_anything(casper, tmp_path):
    casper("experiment", "plans", "--out", str(tmp_path), "--quiet")
    before = (tmp_path / "plans.svg").read_bytes()
    (tmp_path / "plans.svg").unlink()
    told = casper("experiment", "plans", "--out", str(tmp_path), "--redraw")
    assert (tmp_path / "plans.svg").read_bytes() == before and "written: plans.svg, plans.png" in told.out


def test_a_page_is_renewed_with_its_figures_and_data_beside_it(casper, tmp_path):
    page = tmp_path / "docs" / "mine.md"
    page.parent.mkdir()
    page.write_text("# Mine\n")
    casper("experiment", "score", "--out", str(tmp_path / "found"), "--page", str(page), "--quiet")
    assert page.read_text().startswith("# Mine\n") and "(mine/score.svg)" in page.read_text()
    assert {file.name for file in (page.parent / "mine").iterdir()} == {"score.svg", "score.json"}


def test_mistakes_are_one_sentence(casper, tmp_path):
    (tmp_path / "file").write_text("")
    for arguments, word in (
        (["scores"], "did you mean score"),
        (["score", "--out", str(tmp_path / "file")], "choose another folder with --out"),
        (["score", "--out", str(tmp_path), "--redraw"], "without --redraw"),
        (["score", "--out", str(tmp_path), "--trials", "0"], "whole number from 1"),
        (["results", "--out", str(tmp_path), "--trials", "1", "--cluster", "nowhere"], "cannot be reached"),
    ):
        told = casper("experiment", *arguments)
        assert (told.code, told.out) == (2, "") and word in told.err and len(told.err.splitlines()) == 1, told


def test_trials_of_another_version_are_refused_until_one_says_so(casper, tmp_path):
    (tmp_path / "trials.jsonl").write_text('{"casper trials": 1, "domain": "", "code": ""}\n')
    told = casper("experiment", "results", "--trials", "1", "--out", str(tmp_path))
    assert told.code == 2 and "another version of casper" in told.err and "--fresh" in told.err
