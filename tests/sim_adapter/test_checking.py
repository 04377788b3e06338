"""What ``casper check`` says of a scene that lacks something."""

import pytest

from casper.engine.domain.domain import SHIPPED, shipped_domains
from casper.kb.checks.finding import Severity
from casper.sim_adapter.checking import check_whole

FILES = ("ontology.pl", "plans.pl", "actions.pl", "scene.pl")


@pytest.fixture
def told(tmp_path):
    """The findings about the minimal domain with more in its files, or something replaced."""

    def findings(**more):
        for file in FILES:
            text, change = (SHIPPED / "minimal" / file).read_text(), more.get(file.removesuffix(".pl"), "")
            assert not isinstance(change, tuple) or change[0] in text
            (tmp_path / file).write_text(text.replace(*change) if isinstance(change, tuple) else text + change)
        return [(f.severity, f.message) for f in check_whole(tmp_path)]

    return findings


@pytest.mark.parametrize("name", shipped_domains())
def test_the_shipped_domains_lack_nothing(name):
    assert {finding.severity for finding in check_whole(name)} <= {Severity.NOTE}


@pytest.mark.parametrize(
    ("more", "severity", "said"),
    [
        ({"scene": "furniture(shed, counter, 5, 5)."}, "warning", "shed stands outside the room"),
        ({"scene": "position(pen, 0, 0). shape(pen, box)."}, "warning", "pen is on no furniture"),
        ({"scene": "start(robbie, -1.2, 1.2, 0)."}, "error", "robbie cannot start there"),
        ({"scene": "position(pen, desk). shape(pen, box)."}, "error", "needs the furniture desk"),
        ({"scene": "placing(tray, under)."}, "error", "tray cannot be under"),
        ({"ontology": "sing(A, cup, tray) :- human(A).", "plans": "song --> sing(cup, tray)."}, "warning", "nobody has a skill for sing(cup, tray)"),
        ({"ontology": "place(roof).", "plans": "up --> pick_and_place(cup, roof)."}, "warning", "the scene has no object roof"),
    ],
)  # fmt: skip
def test_what_is_amiss_is_said(told, more, severity, said):
    assert any(s.value == severity and said in message for s, message in told(**more))


def test_without_the_household_nobody_could_make_anything_out(told):
    found = told(actions=(':- include("household.pl").', ""))
    assert [message for s, message in found if s is Severity.ERROR] == [
        'there is a room, and nothing says how actions are made out in it; write :- include("household.pl"). in actions.pl',
        'there is a room, and nothing says how movements are made out in it; write :- include("household.pl"). in actions.pl',
    ]


def test_a_place_behind_furniture_is_out_of_reach(told):
    found = told(
        scene=("furniture(rack, counter, 0, -1.3)", "furniture(rack, counter, 0, -1.3). hole(pit, -2, -1.75, 2, -0.3)")
    )
    assert [message for _, message in found] == [
        "shelf is out of reach for people: there is no free floor within 0.6 m of it",
        "shelf is out of reach for robbie: there is no free floor within 0.7 m of it",
    ]


def test_places_that_are_reached_without_a_step_are_noted(told):
    near = "position(mat, 1.2, 1.7). shape(mat, panel)."
    found = told(scene=near, plans="lay --> pick_and_place(cup, mat).", ontology="place(mat).")
    assert [(s, message[:28]) for s, message in found if "apart" in message] == [
        (Severity.NOTE, "mat and tray are 0.40 m apar")
    ]
