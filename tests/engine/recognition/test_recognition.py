"""Readings of people as they really act: options, uncertain observations, forks, outlook, questions, pictures."""

from __future__ import annotations

import random

import pytest
from readings import KITCHEN, domain, reading

from casper.engine.reading.reading import Reading
from casper.engine.recognition.arrays.arrays import Arrays
from casper.engine.recognition.arrays.noisy_arrays import NoisyArrays
from casper.engine.recognition.arrays.pairs import Pairs
from casper.engine.recognition.kernels.chains import Chains
from casper.engine.recognition.kernels.counting import Counting, Interleaving
from casper.engine.recognition.options import Options
from casper.engine.verification.matching import NameMatcher, ParameterMatcher
from casper.kb.errors import CasperError
from casper.plans.library import PlanLibrary


def test_a_needless_action_loses_the_paper_and_costs_its_price_with_noise():
    seen = ("pick_and_place", "sip", "eat")
    assert reading(*seen, verification=False).count == 0
    tolerant = reading(*seen, verification=False, noise=0.1)
    best = tolerant.best()[0]
    assert (best.goal, best.needless) == ("breakfast", (1,))
    assert best.score == pytest.approx(0.1 * 2 / 4)
    assert tolerant.to_json()["best"][0]["needless"] == [2]


def test_what_is_needless_altogether_is_no_explanation():
    seen = reading("sip", noise=0.5, verification=False)
    assert (seen.count, set(seen.rejected)) == (1, {"breakfast", "lunch"})


def test_two_goals_explain_what_none_does_alone():
    seen = reading("pick_and_place", "sip", "eat", goals=2)
    told = seen.to_json()
    assert told["best"][0]["goals"] == ["breakfast", "drink"]
    assert told["posterior"]["drink"] == 1.0
    assert sum(told["posterior"].values()) == pytest.approx(2.0)
    assert reading("sip", goals=2).rejected == {"breakfast": ("breakfast has no sip",), "lunch": ("lunch has no sip",)}


def test_with_two_goals_the_robot_helps_with_the_one_of_which_it_can_do_most():
    plan = reading("pick_and_place", "sip", "eat", goals=2).plan_for("tiago")
    assert plan.goal in ("breakfast", "drink")
    assert len(plan.actions) == 2


def test_an_uncertain_action_weighs_by_its_likelihoods():
    seen = reading({"eat": 0.6, "sip": 0.3}, verification=False)
    certain = {goal: reading(a, verification=False).best()[0].score for a, goal in (("eat", "breakfast"), ("sip", "drink"))}
    assert seen.posterior["breakfast"] / seen.posterior["drink"] == pytest.approx(
        0.6 * certain["breakfast"] / (0.3 * certain["drink"])
    )
    assert str(seen.observations[0]) == "eat: 0.6 | sip: 0.3"


@pytest.mark.parametrize("likelihoods", [{}, {"eat": -0.1}, {"eat": 0}, {"eat": 0.7, "sip": 0.7}, {"eat": float("nan")}, {"eat": True}])
def test_likelihoods_that_are_none_are_refused_and_change_nothing(likelihoods):
    seen = reading("pick_and_place")
    with pytest.raises(CasperError):
        seen.observe(likelihoods)
    assert len(seen.observations) == 1


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"noise": -1}, "the price of a needless observation"),
        ({"noise": 0}, "the price of a needless observation"),
        ({"noise": 1.5}, "the price of a needless observation"),
        ({"noise": float("nan")}, "the price of a needless observation"),
        ({"goals": 0}, "the number of goals"),
        ({"goals": 1.5}, "the number of goals"),
        ({"budget": 0}, "budget"),
        ({"score": "gut feeling"}, "there is no score 'gut feeling'; choose paper"),
    ],
)
def test_options_that_make_no_sense_are_refused(options, sentence):
    with pytest.raises(CasperError, match=sentence):
        KITCHEN.reading(**options)


def test_priors_are_facts_of_the_domain(tmp_path):
    text = "goal(tea). goal(milk). tea --> boil, pour. milk --> open, pour. prior(tea, 0.9). prior(milk, 0.1)."
    seen = domain(tmp_path, text).reading()
    seen.observe("pour")
    assert seen.posterior == pytest.approx({"tea": 0.9, "milk": 0.1})
    assert (seen.outcome, seen.best()[0].goal) == (None, "tea")  # strict waits: boiling was missed


@pytest.mark.parametrize(
    ("facts", "sentence"),
    [
        ("prior(tea, 0.9). prior(milk, 0.2).", "the priors sum to 1.1, not to 1"),
        ("prior(tea, 1).", "it lacks for milk"),
        ("prior(tea, 0.5). prior(milk, 0.5). prior(soup, 0).", "soup is no goal"),
        ("prior(tea, 0). prior(milk, 1).", "a prior is a number above 0"),
        ("prior(tea, -1). prior(milk, 2).", "a prior is a number above 0"),
        ("prior(tea, much). prior(milk, 1).", "a prior is a number above 0"),
        ("prior(tea, 0.5). prior(tea, 0.4). prior(milk, 0.5).", "tea has two priors"),
    ],
)
def test_priors_that_are_none_are_refused(tmp_path, facts, sentence):
    with pytest.raises(CasperError, match=sentence) as caught:
        domain(tmp_path, f"goal(tea). goal(milk). tea --> boil. milk --> open.\n{facts}").reading()
    assert caught.value.place is not None and caught.value.place.line == 2


@pytest.mark.parametrize("seen", ["pick_and_place pick_and_place wash", "pick_and_place", "wash", "sip"])
def test_the_ties_of_the_best_explanation_are_counted(seen):
    found = reading(*seen.split(), verification=False)
    scores = [explanation.score for explanation in found.explanations()]
    assert found.ties == scores.count(max(scores))


def test_before_anything_is_observed_no_goal_has_a_share_whatever_the_score():
    for score in ("paper", "coverage", "diligence", "uniform"):
        assert set(reading(score=score).posterior.values()) == {0.0}


def test_likelihoods_that_underflow_leave_answers():
    seen = reading(verification=False)
    for _ in range(3):
        seen.observe({"pick_and_place": 1e-200})
    assert seen.count == 1  # lunch
    assert set(seen.next_actions) == {"wash(plate, sink)"}
    assert seen.questions() != []


def test_more_explanations_than_can_be_weighed_are_refused_in_a_sentence():
    library = PlanLibrary()
    library.plan("g", *["a"] * 1100)
    seen = Reading(library, NameMatcher(library.ways))
    with pytest.raises(CasperError, match="more explanations than can be weighed"):
        for _ in range(1100):
            seen.observe("a")
    assert seen.posterior == {"g": 1.0}


def test_scores_are_chosen_by_name():
    seen = [reading("wash", score=name, verification=False).posterior for name in ("paper", "uniform", "coverage", "diligence")]
    assert seen[1] == pytest.approx({"breakfast": 1 / 3, "drink": 1 / 3, "lunch": 1 / 3})
    assert seen[0] != pytest.approx(seen[1])


@pytest.mark.parametrize(
    ("goals", "options", "engine"),
    [
        (3, {}, Chains),
        (200, {}, Chains),
        (1000, {}, Arrays),
        (3, {"noise": 0.1}, Counting),
        (200, {"noise": 0.1}, NoisyArrays),
        (3, {"goals": 2}, Interleaving),
        (20, {"goals": 2}, Pairs),
        (20, {"goals": 3}, Interleaving),
        (20, {"goals": 2, "noise": 0.1}, Pairs),
        (3, {"goals": 2, "noise": 0.1}, Interleaving),
        (20, {"goals": 3, "noise": 0.1}, Interleaving),
    ],
)
def test_a_reading_picks_its_engine(goals, options, engine):
    library = PlanLibrary()
    for number in range(goals):
        library.plan(f"g{number}", "a", f"b{number % 7}", "c")
    assert type(Reading(library, NameMatcher(library.ways), options=Options(**options))._engine.kernel) is engine


def test_a_plan_with_shapes_or_parameters_is_counted_by_states():
    shaped = PlanLibrary.from_text("goal(g). g --> optional(a), b.")
    assert type(Reading(shaped, NameMatcher(shaped.ways))._engine.kernel) is Counting
    bound = PlanLibrary.from_text("goal(g). g --> a(X), b(X).")
    assert type(Reading(bound, ParameterMatcher(bound.ways))._engine.kernel) is Counting


@pytest.mark.parametrize("options", [{}, {"goals": 2}])
def test_a_fast_reading_takes_an_uncertain_action_too(options):
    library = PlanLibrary()
    for number in range(120):
        library.plan(f"g{number}", "a", f"b{number % 7}", "c")
    seen = Reading(library, NameMatcher(library.ways), options=Options(**options))
    seen.observe("a")
    seen.observe({"b1": 0.5, "b2": 0.25})
    if options:
        assert seen.posterior["g1"] > seen.posterior["g2"] > seen.posterior["g3"]
    else:
        assert seen.posterior["g1"] == pytest.approx(2 * seen.posterior["g2"])


def test_optional_steps_are_no_part_of_a_plan_until_one_is_seen(tmp_path):
    seen = domain(tmp_path, "goal(tea). tea --> boil, optional((milk, stir)), drink.").reading()
    seen.observe("boil")
    seen.observe("drink")
    assert seen.best()[0].score == 1.0
    assert seen.best()[0].status == ("observed", "skipped", "skipped", "observed")
    with_milk = domain(tmp_path, "goal(tea). tea --> boil, optional((milk, stir)), drink.").reading()
    for action in ("boil", "milk", "drink"):
        with_milk.observe(action)
    assert with_milk.best()[0].status == ("observed", "observed", "missed", "observed")
    assert with_milk.best()[0].score == pytest.approx(3 / 4 * 3 / 4)


def test_what_no_order_relates_may_interleave(tmp_path):
    text = "goal(tidy). tidy --> unordered((take, put), wipe)."
    for order in ("wipe take put", "take wipe put", "take put wipe"):
        allowed = domain(tmp_path, text).reading()
        for action in order.split():
            allowed.observe(action)
        assert allowed.best()[0].missed == 0
    refused = domain(tmp_path, text).reading()
    for action in ("put", "take"):
        refused.observe(action)
    assert refused.count == 0


def test_two_tasks_under_way_side_by_side_are_both_gone_on_with(tmp_path):
    text = "goal(cook). cook --> unordered(sauce, pasta), serve. sauce --> chop, stir, taste. pasta --> boil, salt, drain."
    cook = domain(tmp_path, text).reading()
    for action in ("boil", "chop", "salt", "stir"):
        cook.observe(action)
    assert cook.count == 1
    assert cook.best()[0].missed == 0
    assert set(cook.next_actions) == {"taste", "drain"}


def test_goals_of_seventeen_partly_ordered_steps_are_told_apart_while_five_interleave():
    chance, things, names = random.Random(3), ["cup", "pot", "pan", "jar"], [f"do{n}" for n in range(30)]
    lines, plans = [], []
    for number in range(20):
        steps = [(f"s{at}", f"{chance.choice(names)}(X, {chance.choice(things)})") for at in range(chance.randint(5, 17))]
        pairs = [f"s{a} < s{b}" for a in range(len(steps)) for b in range(a + 1, len(steps)) if chance.random() < 0.15]
        lines.append(f"g{number}(X) --> steps([{', '.join(f'{n}: {s}' for n, s in steps)}], [{', '.join(pairs)}]).")
        thing = chance.choice(things)
        plans.append([step.replace("X", thing) for _, step in steps])
    library = PlanLibrary.from_text("\n".join(lines))
    pursued = chance.sample(range(20), 5)
    rows = [plans[number][:6] for number in pursued]  # steps are written in an order that fits
    seen = Reading(library, ParameterMatcher(library.ways), options=Options(goals=5))
    while any(rows):
        seen.observe(chance.choice([row for row in rows if row]).pop(0))
    assert set(seen.best()[0].goals) == {f"g{number}" for number in pursued}
    likeliest = sorted(seen.posterior, key=seen.posterior.get)[-5:]
    assert set(likeliest) == {f"g{number}" for number in pursued}


def test_a_bounded_search_says_so_in_json():
    library = PlanLibrary()
    for number in range(12):
        library.plan(f"g{number}", *"abab")
    seen = Reading(library, NameMatcher(library.ways), options=Options(goals=3, budget=5))
    for action in "abab":
        seen.observe(action)
    assert not seen.is_exact
    assert seen.to_json()["exact"] is False
