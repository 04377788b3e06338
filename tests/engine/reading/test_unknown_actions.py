"""Actions that no plan has: needless where needless ones have a price, a mistake elsewhere."""

import pytest
from readings import KITCHEN, domain, reading

from casper.kb.errors import PlanError

SEEN = "pick_and_place(meal, hobs)"


@pytest.mark.parametrize("options", [{}, {"goals": 2}, {"verification": False}, {"verification": False, "goals": 2}])
@pytest.mark.parametrize("unknown", ["dance", "leap(meal)", {"dance": 0.5, "jump": 0.25}])
def test_an_action_that_no_plan_has_changes_no_shares(options, unknown):
    plain = reading(SEEN, noise=0.1, **options)
    noisy = reading(SEEN, unknown, noise=0.1, **options)
    assert noisy.posterior == pytest.approx(plain.posterior) and noisy.outcome == plain.outcome
    assert noisy.first.needless == (1,) and list(noisy.unknown) == [1]


@pytest.mark.parametrize("goals", [1, 2])
@pytest.mark.parametrize("count", [3, 150])
def test_whatever_kernel_counts(tmp_path, goals, count):
    chosen = domain(tmp_path, "\n".join(f"g{n} --> a{n % 7}, b{n % 5}, c{n}." for n in range(count)))
    noisy = chosen.reading(noise=0.1, goals=goals)
    for action in ("a1", "dance", "b1"):
        noisy.observe(action)
    plain = chosen.reading(noise=0.1, goals=goals)
    plain.observe("a1")
    plain.observe("b1")
    assert noisy.posterior == pytest.approx(plain.posterior)


def test_it_is_told_with_the_nearest_action_of_the_plans():
    told = reading("eatt(meal, plate)", SEEN, noise=0.1)
    assert "needless: eatt(meal, plate) (no plan has the action eatt; did you mean eat(meal, plate)?)" in str(told)
    unknown = {"observation": 1, "reasons": ["no plan has the action eatt"], "nearest": "eat(meal, plate)"}
    assert told.to_json()["unknown"] == [unknown]


def test_other_arguments_than_any_plan_allows_are_told_too():
    told = reading(SEEN, "cook(meal, sink)", noise=0.1)
    assert told.unknown[1].reasons == ("no plan has cook(meal, sink)",) and told.unknown[1].nearest == "cook(meal, hobs)"


def test_of_an_uncertain_action_what_plans_have_counts():
    told = reading({SEEN: 0.5, "dance": 0.5}, noise=0.1)
    assert told.outcome == "lunch" and told.unknown == {}


def test_another_number_of_arguments_is_needless_too():
    told = reading(SEEN, "cook(meal)", noise=0.1)
    assert told.first.needless == (1,) and "cook takes 2 arguments here" in told.unknown[1].reasons[0]


@pytest.mark.parametrize("seen", ["cook(meal, sink)", "cook(meal)"])
def test_names_alone_take_any_arguments(seen):
    told = reading(SEEN, seen, noise=0.1, verification=False)
    assert told.unknown == {} and told.first.needless == ()


def test_without_a_price_it_is_a_mistake():
    with pytest.raises(PlanError, match="no plan has the action dance"):
        KITCHEN.reading().observe("dance")
