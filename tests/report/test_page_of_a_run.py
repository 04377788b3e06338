"""The page of a simulated run: its figures are those of the events, and it plays in a browser."""

import contextlib
import io
import json
import re
import sys

import pytest
from chromium import Chromium, found

from casper.engine.domain.domain import SHIPPED
from casper.engine.events.event import Event
from casper.engine.perception.world import AgentState, ObjectState, WorldState
from casper.report.recording import Recording
from casper.report.writing import write_page

pytest.importorskip("mujoco")
pytestmark = pytest.mark.xdist_group("report")  # one run, one browser
in_browser = pytest.mark.skipif(found() is None, reason="no Chromium is installed, in which the page could be opened")


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """The events as printed, the page as text, and its file."""
    from casper.cli import main

    page, out = tmp_path_factory.mktemp("report") / "drink.html", io.StringIO()
    given = ["casper", "run", "kitchen", "--goal", "drink", "--seed", "3", "--json", "--report", str(page)]
    with pytest.MonkeyPatch.context() as patch, contextlib.redirect_stdout(out):
        patch.setattr(sys, "argv", given)
        with contextlib.suppress(SystemExit):
            main()
    return [json.loads(line) for line in out.getvalue().splitlines()], page.read_text(encoding="utf-8"), page


@pytest.fixture(scope="module")
def browser():
    with Chromium() as chromium:
        yield chromium


@pytest.fixture
def page(run, browser):
    browser.complaints.clear()
    browser.open(run[2])
    return browser


def embedded(text):
    return json.loads(re.search(r'<script type="application/json" id="recording">(.*?)</script>', text, re.S)[1])


def of_type(events, kind):
    return [event for event in events if event["type"] == kind]


def test_the_events_in_the_page_are_the_events_that_json_prints(run):
    events, text, _ = run
    assert embedded(text)["events"] == events


def test_the_shares_that_are_shown_are_those_of_the_readings(run):
    events, text, _ = run
    shown = [
        {goal: float(value) for goal, value in re.findall(r'<div class="goal"><b>(\w+)</b>.*?<data value="(.*?)"', article)}
        for article in re.findall(r'<article class="read".*?</article>', text, re.S)
    ]
    assert shown == [event["posterior"] for event in of_type(events, "reading")]


def test_the_page_tells_when_the_goal_was_known_and_what_the_robot_did(run):
    events, text, _ = run
    answers = re.search(r'<section class="answers".*?</section>', text, re.S)[0]
    known, part = of_type(events, "prediction")[0]["t"], [e for e in of_type(events, "robot") if e["status"] == "done"]
    assert f'data-t="{known}"' in answers
    assert part
    assert all(f'data-t="{event["t"]}"' in answers for event in part)


def test_a_world_state_is_kept_for_every_period_and_the_page_stays_small(run):
    events, text, _ = run
    states = embedded(text)["states"]
    assert states["t"] == pytest.approx([n / 2 for n in range(round(2 * events[-1]["t"]) + 1)])
    assert all(len(column) == len(states["t"]) for kind in ("agents", "objects") for column in states[kind].values())
    assert len(text.encode()) < 2_000_000


def test_every_refused_statement_is_shown_with_the_rule_that_failed(run):
    events, text, _ = run
    refused = [event for event in of_type(events, "verdict") if not event["valid"]]
    articles = re.findall(r'<article class="refused".*?</article>', text, re.S)
    assert len(articles) == len(refused)
    for event, article in zip(refused, articles):
        assert event["statement"] in article
        assert "how that was found" in article


def test_the_page_does_not_tell_where_the_domain_lies(run):
    assert "ontology.pl:" in run[1]
    assert not any(str(folder) in run[1] for folder in (SHIPPED, SHIPPED.resolve()))


def test_the_page_names_no_other_place(run):
    assert not re.findall(r'(?:src|href)="(?!data:,)|url\((?!#)|@import', run[1])
    assert "default-src 'none'" in run[1]


@in_browser
def test_the_page_opens_without_complaints_at_the_time_of_the_prediction(run, page):
    assert page.run("Number(document.getElementById('slider').value)") == of_type(run[0], "prediction")[0]["t"]
    assert page.complaints == []


@in_browser
@pytest.mark.parametrize("name", ["</script><script>document.title='obeyed'</script>\"'<img src=x>", "constructor", "__proto__"])
def test_any_name_is_shown_and_none_is_obeyed(browser, tmp_path, name):
    events = (
        Event("focus", 0.0, {"agent": name, "target": name, "destination": None, "scores": {name: 1.0}}),
        Event("movement", 0.0, {"agent": name, "movement": name}),
        Event("episode", 2.0, {"agent": name, "goal": name, "outcome": "unclear", "from": 0.0, "to": 2.0, "observed": 1, "missed": 0}),
    )
    states = [WorldState(t, {name: AgentState(t, 0.0, 0.0, name)}, {name: ObjectState(1.0, 1.0)}) for t in (0.0, 2.0)]
    write_page(Recording(name, (name,), "robot", events, tuple(states)), tmp_path / "named.html")
    browser.complaints.clear()
    browser.open(tmp_path / "named.html")
    assert browser.run("document.title").startswith(name)
    assert browser.run("document.getElementById('does').textContent") == f"{name}, holds {name}, attends to {name}"
    assert browser.complaints == []


@in_browser
def test_the_slider_moves_the_partner_to_where_they_were(run, page):
    states = embedded(run[1])["states"]
    at = len(states["t"]) // 2
    x, y = states["agents"]["human"][at][:2]
    page.run(f"s = document.getElementById('slider'); s.value = {states['t'][at]}; s.dispatchEvent(new Event('input'))")
    moved = page.run("document.querySelector('[data-agent=human]').getAttribute('transform')")
    assert [float(n) for n in re.findall(r"-?[\d.]+", moved)] == pytest.approx([100 * x, -100 * y], abs=0.06)


@in_browser
def test_keys_go_through_the_time(run, page):
    def clock():
        return float(page.run("document.getElementById('clock').textContent").split()[0])

    start = clock()
    page.press("ArrowLeft")
    assert clock() == pytest.approx(start - 1)
    page.press("ArrowRight", shift=True)
    assert clock() == pytest.approx(start + 9)
    page.press("End")
    assert clock() == run[0][-1]["t"]
    page.press("Home")
    assert clock() == 0
    page.press("n")
    assert clock() == min(event["t"] for event in run[0] if event["type"] in ("verdict", "reading"))


@in_browser
def test_space_plays_and_pauses(page):
    label = "document.getElementById('play').getAttribute('aria-label')"
    page.press(" ")
    assert page.run(label) == "pause"
    page.press(" ")
    assert page.run(label) == "play"


@in_browser
def test_a_time_that_is_pressed_is_gone_to(run, page):
    page.click(".answers button.at")
    first = of_type(run[0], "reading")[0]["t"]
    assert page.run("Number(document.getElementById('slider').value)") == first
    assert page.run("document.querySelectorAll('article.current').length") == 1


@in_browser
@pytest.mark.parametrize("dark", [False, True])
def test_a_phone_shows_the_page_without_scrolling_sideways(run, browser, dark):
    browser.open(run[2], wide=360, high=740, phone=True, dark=dark)
    assert browser.run("document.documentElement.scrollWidth") == 360
    light = browser.run("getComputedStyle(document.body).backgroundColor.match(/\\d+/)[0] > 128")
    assert light != dark
