"""Explanation trees as pictures, and the command line's way to one."""

from __future__ import annotations

import xml.etree.ElementTree as Xml

import pytest

from casper import Domain
from casper.engine.explanation.pictures import _figure, positions, save_picture
from casper.kb.errors import CasperError

pytest.importorskip("matplotlib")


def best(*observed):
    reading = Domain.load("kitchen").reading()
    for action in observed:
        reading.observe(action)
    return reading.best(2)


def test_leaves_stand_side_by_side_and_tasks_above_the_middle_of_what_they_are_done_by():
    tree = best("eat")[0].tree()
    places = positions(tree)
    assert [places[n][0] for n in sorted(tree) if tree.nodes[n]["kind"] == "action"] == [0.0, 1.0, 2.0, 3.0]
    for node in tree:
        below = [places[child][0] for child in tree.successors(node)]
        if below:
            assert places[node][0] == (min(below) + max(below)) / 2


@pytest.mark.parametrize("kind", ["svg", "png", "pdf"])
def test_the_same_explanations_give_the_same_bytes(tmp_path, kind):
    one, other = tmp_path / f"one.{kind}", tmp_path / f"other.{kind}"
    save_picture(best("eat"), one)
    save_picture(best("eat"), other)
    assert one.read_bytes() == other.read_bytes()


def test_observed_is_filled_missed_textured_and_unobserved_dashed(tmp_path):
    save_picture(best("eat")[:1], tmp_path / "eat.svg")
    drawn = {g.get("id"): Xml.tostring(g, encoding="unicode") for g in Xml.parse(tmp_path / "eat.svg").iter() if g.get("id")}
    assert "#9ecae1" in drawn["action eat(biscuits, plate): observed"]
    assert "url(#" in drawn["action pick_and_place(biscuits, plate): missed"]
    assert "stroke-dasharray" in drawn["action wash(plate, sink): unobserved"]


@pytest.mark.parametrize("name", ["a.png", "a.svg", "a.pdf", "a.PNG"])
def test_the_ending_says_the_format(tmp_path, name):
    save_picture(best("eat"), tmp_path / name)
    assert (tmp_path / name).stat().st_size > 1000


@pytest.mark.parametrize(
    ("name", "explanations", "sentence"),
    [
        ("a.gif", 1, "a picture is written as .svg, .png, .pdf, not as '.gif'"),
        ("a", 1, "not as 'a'"),
        ("a.svg", 0, "there is no explanation to draw"),
        ("nowhere/a.svg", 1, "cannot write"),
    ],
)
def test_a_picture_that_cannot_be_is_refused(tmp_path, name, explanations, sentence):
    with pytest.raises(CasperError, match=sentence):
        save_picture(best("eat")[:explanations], tmp_path / name)


def test_each_leaf_has_about_two_inches_and_each_row_one():
    width, height = _figure(best("eat")[:1]).get_size_inches()
    assert 1.5 < width / 4 < 2.5  # the plan has four actions
    assert 0.8 < height / 3 < 1.5


def test_a_line_runs_from_below_a_task_to_above_what_it_is_done_by():
    (axes,) = _figure(best("eat")[:1]).axes
    ends = [tuple(line.get_ydata()) for line in axes.lines]
    assert len(ends) == 5
    assert all(upper - lower == pytest.approx(1 - 2 * 0.22) and -lower % 1 == pytest.approx(0.78) for upper, lower in ends)
