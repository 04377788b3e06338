"""Alternatives stay open in a plan: nothing is spelled out, and nothing that was not seen is decided."""

from fractions import Fraction

import pytest

from casper import Domain
from casper.engine.reading.reading import Reading
from casper.engine.verification.matching import NameMatcher, ParameterMatcher
from casper.kb.errors import PlanError
from casper.plans.library import PlanLibrary
from casper.plans.trees.tree import tree_text


def reading(text, *seen, matcher=NameMatcher):
    library = PlanLibrary.from_text(text)
    found = Reading(library, matcher(library.ways))
    for action in seen:
        found.observe(action)
    return found


BREAKFAST = "goal(breakfast). breakfast --> drink, food, clean. drink --> tea ; brew, coffee. food --> toast ; egg, salt ; soup."


def test_what_was_not_seen_is_not_decided():
    seen = reading(BREAKFAST, "tea")
    assert (seen.count, seen.confidence) == (1, 1.0)


def test_a_goal_does_not_gain_by_having_more_ways_to_go_on():
    text = "goal(g). goal(h). g --> a, (b ; c ; d ; e), f. h --> a, b, f."
    assert reading(text, "a").posterior == {"g": 0.5, "h": 0.5}


def test_an_alternative_belongs_to_the_plan_once_it_was_seen_and_shuts_its_rivals_out():
    seen = reading(BREAKFAST, "brew", "salt")
    (found,) = seen.explanations()
    assert found.status == ("skipped", "observed", "missed", "skipped", "missed", "observed", "skipped", "unobserved")
    assert found.score == pytest.approx(2 * (5 - 2) / 5**2)


def test_a_rival_of_what_was_seen_is_not_explained():
    assert reading(BREAKFAST, "brew", "tea").count == 0


def test_an_open_choice_counts_as_its_smallest_alternative():
    (found,) = reading("goal(g). g --> a, (b, c ; d), e.", "e").explanations()
    assert found.status == ("missed", "skipped", "skipped", "missed", "observed")
    assert found.score == pytest.approx(1 * (3 - 2) / 3**2)


def test_the_frontier_of_an_open_choice_is_its_smallest_alternative():
    seen = reading("goal(g). g --> a, (b, c ; d), e.", "a")
    assert [leaf[0] for leaf in seen.frontier] == ["d", "e"]
    assert seen.best()[0].status == ("observed", "alternative", "alternative", "unobserved", "unobserved")


def test_every_alternative_may_come_next():
    assert set(reading(BREAKFAST, "tea").next_actions) == {"toast", "egg", "soup"}


def test_a_plan_with_a_hundred_million_ways_is_read_at_once():
    tasks = " ".join(f"t{n} --> a{n} ; b{n} ; c{n}, d{n}." for n in range(17))
    seen = reading(f"goal(g). g --> {', '.join(f't{n}' for n in range(17))}. {tasks}", "a0", "c5", "d5", "b16")
    (found,) = seen.explanations()
    assert Fraction(found.score).limit_denominator(10_000) == Fraction(4 * 4 + 0, 18 * 18) * 1
    assert found.missed == 14


def test_a_task_that_calls_itself_is_one_plan_however_deep():
    text = "setting(plans, recursion, 40). goal(fill). fill --> step, close. step --> scoop, step. step --> pour."
    seen = reading(text, *["scoop"] * 12, "pour", "close")
    assert len(seen.library.ways) == 1
    assert seen.best()[0].missed == 0
    assert seen.best()[0].score == 1.0


@pytest.mark.parametrize("bound", [30, 2000])
def test_what_cannot_be_unrolled_is_refused_in_a_sentence(bound):
    text = f"setting(plans, recursion, {bound}). goal(g). g --> a, g, g. g --> b."
    with pytest.raises(PlanError, match="lower the bound of its recursion or repetition"):
        PlanLibrary.from_text(text)


def test_choices_inside_choices_are_numbered_apart(tmp_path):
    (tmp_path / "plans.pl").write_text("goal(g). g --> (a ; (b ; c), d), (e ; f).")
    rows = sorted(Domain.load(tmp_path).kb.rows("alternative", 4))
    assert rows == [("g", 1, 1, 1), ("g", 1, 2, 2), ("g", 1, 2, 3), ("g", 1, 2, 4), ("g", 2, 1, 2), ("g", 2, 2, 3), ("g", 3, 1, 5), ("g", 3, 2, 6)]


def test_a_goal_with_hundreds_of_ways_is_a_small_program(tmp_path):
    (tmp_path / "plans.pl").write_text("goal(g).\n" + "".join(f"g --> a{n}, b{n}, c.\n" for n in range(300)))
    kb = Domain.load(tmp_path).kb
    assert len(list(kb.rows("alternative", 4))) == 900


def test_a_library_is_shown_without_spelling_it_out():
    library = PlanLibrary.from_text(f"goal(g). g --> unordered({', '.join(f'a{n}' for n in range(30))}).")
    assert (repr(library), len(library), bool(library)) == ("<PlanLibrary: 1 goals, 1 plans>", 1, True)


@pytest.mark.parametrize("body", ["repeat(a, 1000000000, 1000000000)", "repeat(a, 1, 1001)", "repeat((a, b), 20000, 20000)"])
def test_repetition_is_bounded(body):
    with pytest.raises(PlanError, match="at most 1000 times"):
        PlanLibrary.from_text(f"goal(g). g --> {body}.")


def test_alternatives_that_settle_a_parameter_outside_are_plans_of_their_own():
    library = PlanLibrary.from_text("goal(g(X)). g(X) --> t(X), put(X). t(tea) --> boil. t(milk) --> warm. t(Y) --> buy(Y).")
    assert [[str(leaf) for leaf in plan.leaves] for plan in library.ways] == [
        ["boil", "put(tea)"],
        ["warm", "put(milk)"],
        ["buy(X)", "put(X)"],
    ]


def test_alternatives_of_one_production_keep_their_parameters_apart():
    text = "goal(g). g --> pick(X), put(X), wash. pick(tea) --> reach(tea). pick(milk) --> reach(milk)."
    library = PlanLibrary.from_text(text)
    assert [str(leaf) for leaf in library.ways[0].leaves] == ["reach(tea)", "put(tea)", "wash", "reach(milk)", "put(milk)", "wash"]
    assert [leaf for leaf in map(str, reading(text, "reach(milk)", matcher=ParameterMatcher).frontier)] == ["put(milk)", "wash"]


def test_a_tree_says_or_between_alternatives():
    text = tree_text(reading("goal(g). g --> a, (b ; c, d), e.", "a").best()[0].tree())
    assert [line.split("─╼ ")[-1] for line in text.splitlines()[1:]] == ["● a", "○ b", "◌ or c", "◌ d", "○ e"]


def test_alternatives_can_be_asked_for(tmp_path):
    (tmp_path / "plans.pl").write_text("goal(g). g --> a, (b ; c), d.")
    kb = Domain.load(tmp_path).kb
    assert sorted(kb.rows("alternative", 4)) == [("g", 1, 1, 2), ("g", 1, 2, 3)]
    assert sorted(kb.rows("before", 3)) == [("g", 1, 2), ("g", 1, 3), ("g", 2, 4), ("g", 3, 4)]
    assert sorted(kb.rows("optional", 2)) == [("g", 2), ("g", 3)]
