"""Made-up days and the judge of recognisers: every figure of a tally, told by a recogniser that says what it is told."""

import random

import pytest

from casper.engine.actions.comparison import Step, Tally, compare_recognisers, completion, judge, simulate
from casper.engine.actions.fsm import Fsm
from casper.engine.actions.prediction import Prediction

DRINK = Fsm("drink", {"pick": {"sip": 1.0}, "sip": {"pick": 1.0}}, ("pick", "sip"))
NOBODY = frozenset()


class Says:
    """A recogniser that says an action at certain steps."""

    def __init__(self, said):
        self.said, self.accepted = said, 0

    def reset(self):
        self.accepted = 0

    def accept(self):
        self.accepted += 1

    def update(self, movement):
        action = self.said.get(movement.t)
        return None if action is None else Prediction(movement.t, action, 1.0, {}, ())


def day(finished, length=10):
    return [Step("walk", "walk", finished.get(t)) for t in range(length)]


def figures(said, finished, ignored=NOBODY):
    tally = judge(Says(said), day(finished), ignored)
    return {name: getattr(tally, name) for name in ("actions", "right", "missed", "early", "extra", "faultless")}, tally.delays


@pytest.mark.parametrize(
    ("said", "right", "missed", "early", "extra", "delays"),
    [
        ({4: "drink"}, 1, 0, 0, 0, [0]),
        ({6: "drink"}, 1, 0, 0, 0, [2]),
        ({}, 0, 1, 0, 0, []),
        ({2: "drink"}, 0, 1, 1, 0, []),
        ({6: "eat"}, 0, 1, 0, 1, []),
        ({6: "drink", 7: "drink"}, 1, 0, 0, 1, [2]),
        ({2: "drink", 6: "drink"}, 1, 0, 1, 0, [2]),
    ],
)
def test_an_action_is_right_after_it_happened_early_before_and_extra_otherwise(said, right, missed, early, extra, delays):
    found, times = figures(said, {4: "drink"})
    assert found == {
        "actions": 1, "right": right, "missed": missed, "early": early, "extra": extra,
        "faultless": int((right, early, extra) == (1, 0, 0)),
    }  # fmt: skip
    assert times == delays


def test_an_action_that_is_recognised_after_the_next_one_happened_is_missed():
    found, delays = figures({7: "drink", 8: "eat"}, {2: "drink", 6: "eat"})
    assert (found["actions"], found["right"], found["extra"], delays) == (2, 1, 1, [2])


def test_what_is_ignored_is_neither_right_nor_wrong():
    found, _ = figures({3: "move", 4: "drink"}, {4: "drink"}, frozenset({"move"}))
    assert (found["right"], found["extra"], found["faultless"]) == (1, 0, 1)


def test_everything_that_is_said_is_accepted():
    recogniser = Says({2: "drink", 6: "eat"})
    judge(recogniser, day({4: "drink"}), NOBODY)
    assert recogniser.accepted == 2


@pytest.mark.parametrize(("movements", "at"), [("pick sip", 1), ("pick walk sip pick", 2), ("sip pick", -1), ("", -1)])
def test_the_movement_that_completes_a_cycle_is_numbered_from_zero(movements, at):
    assert completion(DRINK, movements.split()) == at


def test_a_day_without_errors_is_seen_as_it_is_and_each_movement_lasts_as_long_as_it_should():
    steps = simulate([(None, ["pick"]), ("drink", ["pick", "sip"])], [DRINK], 0.0, random.Random(1), lasts=(2, 2))
    assert [(step.true, step.finished) for step in steps] == [
        ("pick", None), ("pick", None), ("pick", None), ("pick", None), ("sip", "drink"), ("sip", None),
    ]  # fmt: skip
    assert all(step.seen == step.true for step in steps)


@pytest.mark.parametrize("burst", [1, 3])
def test_errors_come_in_bursts_of_one_wrong_movement(burst):
    three = Fsm("drink", {"pick": {"sip": 1.0}, "sip": {"look": 1.0}, "look": {"pick": 1.0}}, ("pick", "sip"))
    steps = simulate([(None, ["pick"])], [three], 1.0, random.Random(3), lasts=(9, 9), burst=burst)
    seen = [step.seen for step in steps]
    assert "pick" not in seen
    assert all(len(set(seen[at : at + burst])) == 1 for at in range(0, 9, burst))
    rare = simulate([(None, ["pick"])], [three], 0.05, random.Random(3), lasts=(400, 400), burst=burst)
    wrong = [step.seen != step.true for step in rare]
    runs = "".join("x" if w else " " for w in wrong).split()
    assert runs and all(len(run) % burst == 0 for run in runs)


def test_totals_add_up_the_days_of_every_script():
    script = [("drink", ["pick", "sip"])]
    totals = compare_recognisers({"one": Says({2: "drink"}), "none": Says({})}, [script, script], [DRINK], error=0.0, days=3, lasts=(2, 2))
    assert totals["one"] == Tally(6, 6, 0, 0, 6, 6, [0] * 6)
    assert totals["none"] == Tally(6, 0, 0, 0, 6, 0, [])


def test_totals_add_up_what_was_early_and_what_was_extra():
    script = [("drink", ["pick", "sip"])]
    said = {"early": Says({0: "drink"}), "extra": Says({2: "drink", 3: "drink"})}
    totals = compare_recognisers(said, [script], [DRINK], error=0.0, days=3, lasts=(2, 2))
    assert totals["early"] == Tally(3, 0, 3, 0, 3, 0, [])
    assert totals["extra"] == Tally(3, 3, 0, 3, 3, 0, [0] * 3)
