"""Every event prints itself; a timeline says only what is new."""

import pytest

from casper.engine.events import TYPES, Event
from casper.engine.events.entries import Names
from casper.engine.events.timeline import Timeline
from casper.kb.text.lines import text_of

FOCUS = Event("focus", 9.0, {"target": "a:x:b", "destination": "hobs", "scores": {"hobs": 0.5, "a:x:b": 1.0, "far": 0.0}})
MOVEMENT = Event("movement", 9.0, {"movement": "place", "features": {}})
ACTION = Event("action", 15.0, {"statement": "eat(ann, '[bold]')", "score": 0.8})
VALID = Event("verdict", 15.0, {"statement": "eat(ann, _)", "valid": True, "completed": "eat(ann, '[bold]')", "reasons": []})
THROWN = Event(
    "verdict", 15.0,
    {"statement": "eat(tim, meal)", "valid": False, "completed": "eat(tim, meal)", "reasons": ["tim is no [red]human[/]"]},
)  # fmt: skip
READING = Event(
    "reading", 15.0,
    {
        "explanations": 1, "observations": ["eat('[bold]')"], "posterior": {"lunch": 1.0, "drink": 0.0},
        "rejected": [{"goal": "drink", "reasons": ["drink has no eat", "and more"]}],
    },
)  # fmt: skip
PREDICTION = Event("prediction", 15.0, {"goal": "lunch", "observed": 1, "missed": 0})
PLAN = Event("plan", 15.0, {"agent": "tim", "waiting": ["eat(meal)"], "actions": ["wash(p)", "go"]})
SAYS = Event("says", 15.0, {"agent": "tim", "goal": "lunch", "text": "Tim will now do wash(p), since the goal is [x]."})
ASKED = Event("robot", 16.0, {"status": "asked", "action": "wash(p)"})
FAILED = Event("robot", 20.0, {"status": "failed", "action": "wash(p)", "reason": "it slipped"})
WITHDRAWN = Event("withdrawn", 26.5, {"agent": "tim", "partner": "ann", "goal": "lunch", "because": "ann went over to [x]"})
EPISODE = Event(
    "episode", 26.5,
    {"agent": "ann", "goal": "lunch", "outcome": "abandoned", "from": 15.0, "to": 20.0, "observed": 1, "missed": 0},
)  # fmt: skip
WARNING = Event("warning", 20.0, {"message": "line 3 is left out: [x]"})
SUMMARY = Event(
    "summary", 100.0,
    {"predicted": "lunch", "prediction_time": 15.0, "goal": "lunch", "correct": True, "robot": {"actions": ["wash(p)"], "done": True}},
)  # fmt: skip

SHOWN = [
    (FOCUS, ["   9.0  focus      a:x:b    ████████ 1.00  hobs     ████     0.50"]),
    (MOVEMENT, ["   9.0  place"]),
    (ACTION, ["  15.0  it looks like eat(ann, '[bold]') (score 0.80)"]),
    (VALID, ["  15.0  ✔ eat(ann, _) (so eat(ann, '[bold]'))"]),
    (THROWN, ["  15.0  ✘ eat(tim, meal) is thrown out", "        tim is no [red]human[/]"]),
    (
        READING,
        [
            "  15.0  eat('[bold]')",
            "        1 explanation of 1 observed",
            "          lunch       ██████████ 1.00",
            "          drink                  0.00  not this: drink has no eat",
        ],
    ),
    (PREDICTION, ["  15.0  ★ the goal is lunch (1 action seen, 0 missed)"]),
    (PLAN, ["  15.0  tim waits for eat(meal)", "        and will then wash(p), then go"]),
    (SAYS, ["  15.0  » Tim will now do wash(p), since the goal is [x]."]),
    (ASKED, ["  16.0  ▷ the robot asked wash(p)"]),
    (FAILED, ["  20.0  ✘ the robot failed wash(p): it slipped"]),
    (WITHDRAWN, ["  26.5  ✗ tim withdraws its part in lunch", "        ann went over to [x]"]),
    (EPISODE, ["  26.5  ○ lunch is abandoned (15.0 to 20.0 s; 1 seen, 0 missed)"]),
    (WARNING, ["  20.0  ! line 3 is left out: [x]"]),
    (
        SUMMARY,
        [
            " 100.0  the partner wanted lunch; predicted lunch at 15.0 s: right",
            "        the robot's part (wash(p)) is finished",
        ],
    ),
]  # fmt: skip


@pytest.mark.parametrize(("event", "lines"), SHOWN, ids=lambda thing: thing.type if isinstance(thing, Event) else "")
def test_an_event_prints_its_time_and_what_happened(event, lines):
    assert str(event).splitlines() == lines


def test_every_type_of_event_is_among_them():
    assert {event.type for event, _ in SHOWN} == set(TYPES)


@pytest.mark.parametrize("event", [event for event, _ in SHOWN], ids=lambda event: event.type)
def test_the_repr_is_one_line(event):
    assert repr(event) == f"<Event {event.type} at {event.t:g} s>"


@pytest.mark.parametrize("kind", [*TYPES, "smell"])
def test_an_event_made_by_hand_without_its_data_prints_what_it_has(kind):
    told = str(Event(kind, 1.0, {"scores": 3, "what": "[bold]"}))
    assert told.splitlines() == [f'   1.0  {kind} {{"scores": 3, "what": "[bold]"}}']


def test_the_agents_go_by_their_names():
    told = text_of(SUMMARY.lines(Names("ann", "tim")))
    assert "ann wanted lunch" in told and "tim's part" in told


def timeline(*events):
    told = Timeline("ann", "tim")
    return [text_of(told.lines(event)) for event in events]


def test_a_timeline_tells_a_movement_with_what_it_is_about_and_only_once():
    assert timeline(FOCUS, MOVEMENT, MOVEMENT) == ["", "   9.0  place      a:x:b    ████████ 1.00  hobs     ████     0.50", ""]


def test_of_several_partners_every_line_says_whom_it_is_about():
    ann, bob = (Event("verdict", 15.0, {**VALID.data, "agent": name}) for name in ("ann", "bob"))
    plan = Event("plan", 16.0, {**PLAN.data, "partner": "bob"})
    first, second, third = timeline(ann, bob, plan)
    assert first.startswith("  15.0  ✔")  # as long as there is one only
    assert second.startswith("bob    15.0  ✔")
    assert [line.split()[0] for line in third.splitlines()] == ["bob", "bob"]


def test_the_movements_of_two_partners_are_told_apart():
    of = lambda event, name: Event(event.type, event.t, {**event.data, "agent": name})  # noqa: E731
    told = timeline(*(of(event, name) for event in (FOCUS, MOVEMENT, MOVEMENT) for name in ("ann", "bob")))
    assert [bool(text) for text in told] == [False, False, True, True, False, False]


def test_a_day_is_summed_up_goal_by_goal():
    rows = [{**EPISODE.data, "goal": goal, "outcome": "finished", "to": to} for goal, to in (("drink", 50.0), (None, 90.0))]
    day = Event("summary", 100.0, {**SUMMARY.data, "goals": ["drink", "lunch"], "correct": False, "episodes": rows})
    assert str(day).splitlines() == [
        " 100.0  the partner wanted drink, lunch; read drink, ?: wrong",
        "        ann: drink finished at 50.0 s",
        "        ann: ? finished at 90.0 s",
        "        the robot's part (wash(p)) is finished",
    ]


def test_an_event_names_whom_it_is_about():
    assert MOVEMENT.about("ann").data["agent"] == "ann"
    assert {"agent": "tim", "partner": "ann"}.items() <= PLAN.about("ann").data.items()
    assert WITHDRAWN.about("eve").data == WITHDRAWN.data


def test_a_timeline_tells_a_reason_once():
    first, second = timeline(READING, READING)
    assert ("not this" in first, "not this" in second) == (True, False)


def test_a_timeline_leaves_out_what_another_event_tells():
    assert timeline(ACTION, ASKED) == ["", ""]


def test_of_many_goals_a_timeline_shows_the_likeliest_in_a_column_that_is_wide_enough():
    posterior = {f"goal_number_{number}": number / 1000 for number in range(50)}
    told = timeline(Event("reading", 1.0, {"explanations": 2, "observations": ["a"], "posterior": posterior, "rejected": []}))
    lines = told[0].splitlines()
    assert lines[1].startswith("          goal_number_49 ▌")
    assert (len(lines), lines[-1]) == (32, "          … and 20 goals that are no likelier")
