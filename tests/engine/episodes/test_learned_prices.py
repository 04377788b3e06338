"""Prices learned from recorded days."""

import json
import random
from dataclasses import asdict

import pytest
from days import BREAKFAST, DRINK, KITCHEN, LUNCH

from casper.engine.episodes.prices import Prices
from casper.engine.episodes.training import Recorded, learn, read_day
from casper.kb.errors import CasperError, DomainError


def make(prices):
    return KITCHEN.day(**asdict(prices))


def days(count, needless, unseen, labelled=False, seed=0):
    """Days of five goals, so many of whose actions are needless or unseen."""
    chance, found = random.Random(seed), []
    rows = {"breakfast": BREAKFAST, "drink": DRINK, "lunch": LUNCH}
    for _ in range(count):
        day = []
        for goal in chance.choices(sorted(rows), k=5):
            for action in rows[goal]:
                if chance.random() >= unseen:
                    day.append(Recorded(action, goals=(goal,) if labelled else None))
                if chance.random() < needless:
                    day.append(Recorded("sip(bottle, plate)", goals=() if labelled else None))
        found.append(day)
    return found


@pytest.mark.parametrize("labelled", [False, True])
def test_more_needless_and_unseen_actions_make_them_cheaper(labelled):
    clean = learn(make, days(12, 0.0, 0.0, labelled), Prices()).prices
    noisy = learn(make, days(12, 0.2, 0.0, labelled), Prices()).prices
    hidden = learn(make, days(12, 0.0, 0.2, labelled), Prices()).prices
    assert clean.needless < 0.01 < 0.1 < noisy.needless < 0.25
    assert clean.missed < 0.02 < 0.1 < hidden.missed < 0.3


def test_what_was_learned_is_text_for_the_plans(tmp_path):
    learned = learn(make, days(2, 0.1, 0.1), Prices())
    (tmp_path / "plans.pl").write_text("g --> a, b.\n" + learned.to_text())
    from casper import Domain

    assert asdict(Domain.load(tmp_path).prices) == pytest.approx(asdict(learned.prices), rel=1e-3)


def test_a_record_is_read_line_by_line(tmp_path):
    lines = [{"action": "eat"}, {"action": "sip", "t": 2, "agent": "human", "goal": None}, {"action": "wash", "goal": "drink"}]
    (tmp_path / "day.jsonl").write_text("\n".join(map(json.dumps, lines)) + "\n\n")
    read = read_day(tmp_path / "day.jsonl")
    assert [(one.action, one.t, one.agent, one.goals) for one in read] == [
        ("eat", None, None, None), ("sip", 2.0, "human", ()), ("wash", None, None, ("drink",)),
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("{", "day.jsonl:1.*this is no JSON"),
        ("[]", "day.jsonl:1.*an observation is an object"),
        ('{"action": 3}', "day.jsonl:1.*an observation is an object"),
        ('{"action": "eat", "goal": 3}', "day.jsonl:1.*are names, or null"),
        ('{"action": "eat", "t": "now"}', "day.jsonl:1.*a number of seconds"),
    ],
)
def test_a_line_that_is_none_is_refused_with_its_place(tmp_path, line, said):
    (tmp_path / "day.jsonl").write_text(line)
    with pytest.raises(DomainError, match=said):
        read_day(tmp_path / "day.jsonl")


def test_a_goal_that_is_none_is_refused_with_its_place(tmp_path):
    (tmp_path / "day.jsonl").write_text('{"action": "eat", "goal": "lanch"}')
    with pytest.raises(CasperError, match=r"day.jsonl:1.*did you mean lunch\?"):
        learn(make, [read_day(tmp_path / "day.jsonl")], Prices())


def test_nothing_is_learned_from_nothing():
    with pytest.raises(DomainError, match="nothing to learn from"):
        learn(make, [[]], Prices())
