"""The benchmarks of a day at tiny sizes: they run, and what they generate is what they say. No time is judged."""

import random
import sys
from pathlib import Path

FOLDER = Path(__file__).resolve().parent.parent / "benchmarks" / "day"
if str(FOLDER) not in sys.path:
    sys.path.append(str(FOLDER))

import kitchens  # noqa: E402
import measuring  # noqa: E402
import recipes  # noqa: E402
import whole_days  # noqa: E402


def test_sets_of_dishes_are_read_and_rivals_are_asked():
    ours, theirs = measuring.kitchen(6, 3)
    assert ours.of == 3 and ours.right >= 2 and len(ours.seconds) > 10
    assert [score.of for score in theirs.values()] == [3, 3]


def test_with_needless_and_unseen_actions():
    for needless, unseen in ((0.1, 0.0), (0.0, 0.2)):
        ours, _ = measuring.kitchen(6, 2, needless, unseen, rivals=False)
        assert ours.of == 2


def test_changes_of_mind_are_noticed_and_none_is_invented():
    ours, theirs = measuring.changes(6)
    assert all(score.found.of == score.quiet.of == 6 for score in (ours, *theirs.values()))
    assert ours.found.right >= 5 and ours.quiet.right == 6


def test_a_day_is_read():
    score = measuring.whole_day(8, 6)
    assert score.of == 8 and score.right >= 6 and len(score.kept) == 4


def test_what_is_cooked_is_a_way_to_do_the_dishes():
    plans, chance = kitchens.library(10).ways, random.Random(0)
    seen = kitchens.cooked(plans, 3, chance)
    assert len(seen.pursued) == 3 and None not in seen.goals
    sizes = {plan.label: len(plan.leaves) for plan in plans}
    assert len(seen.observations) == sum(sizes[label] for label in seen.pursued)
    noisy = kitchens.cooked(plans, 3, chance, needless=0.5)
    assert noisy.goals.count(None) > 3


def test_no_two_dishes_have_the_same_verbs():
    plans = kitchens.library(40).ways
    bags = {tuple(sorted(leaf.functor for leaf in plan.leaves)) for plan in plans}
    assert len(bags) == 40


def test_recipes_share_beginnings_and_do_nothing_twice():
    rows = recipes.recipes()
    assert len(rows) == recipes.RECIPES and all(len(set(row)) == len(row) for row in rows.values())
    assert len({row[0] for row in rows.values()}) == recipes.RECIPES // recipes.FAMILY
    cook = recipes.cook(rows, True, random.Random(1))
    assert len(set(cook.actions)) == len(cook.actions) and len(set(cook.goals)) == 2
    assert cook.telling is None or cook.goals[cook.telling] != cook.first


def test_a_day_holds_all_its_goals():
    plans = kitchens.library(6).ways
    done = list(whole_days.day(plans, 5, random.Random(0), unseen=0.0))
    assert {action.number for action in done if action.number is not None} == set(range(5))
