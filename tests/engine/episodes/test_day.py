"""A day with a partner: goal after goal, several at once, given up, with needless and unknown actions."""

import pytest
from days import BREAKFAST, DRINK, LUNCH, day_of, lived, observing, row

from casper.kb.errors import CasperError, DomainError


def test_goal_follows_goal():
    day = lived(*BREAKFAST, *DRINK, *LUNCH)
    assert row(day) == [("breakfast", "finished"), ("drink", "finished"), ("lunch", "finished")]
    assert [episode.observations for episode in day.episodes] == [(1, 2, 3, 4), (5, 6, 7, 8), tuple(range(9, 15))]
    assert day.needless == () and day.leading == "lunch" and max(day.posterior.values()) < 0.01


def test_what_closed_is_told_once_and_when_it_closes():
    day = lived(*BREAKFAST[:3])
    assert day.closed() == []
    day.observe(BREAKFAST[3], t=9.5)
    (episode,) = day.closed()
    assert (episode.goal, episode.outcome, episode.start, episode.end) == ("breakfast", "finished", 1.0, 9.5)
    assert (episode.observed, episode.missed, str(episode.term)) == (4, 0, "breakfast(biscuits)")
    assert observing(day, *DRINK[:2]).closed() == []


def test_two_goals_interleave():
    day = lived(LUNCH[0], DRINK[0], LUNCH[1], DRINK[1], *LUNCH[2:4])
    assert row(day) == [("lunch", None), ("drink", None)]
    assert day.posterior["lunch"] > 0.9 and day.posterior["drink"] > 0.7 and day.posterior["breakfast"] < 0.01


def test_after_a_change_of_mind_the_new_goal_leads():
    day = lived(*LUNCH[:2], BREAKFAST[0])
    assert day.leading == "breakfast" and day.current["breakfast"] > 0.9
    day = observing(day, *BREAKFAST[1:], *DRINK * 10)
    assert ("lunch", "abandoned") in row(day)
    assert day.posterior["lunch"] < 0.05


def test_a_goal_that_is_left_alone_fades():
    day = lived(LUNCH[0])
    shares = [day.posterior["lunch"]]
    for action in DRINK[:4]:
        day.observe(action)
        shares.append(day.posterior["lunch"])
    assert shares == sorted(shares, reverse=True) and shares[-1] < shares[0]


def test_the_last_step_that_went_unseen_counts_as_missed():
    day = lived(*BREAKFAST[:3], *LUNCH * 12)
    first = day.episodes[0] if row(day)[0][0] == "breakfast" else next(e for e in day.closed() if e.goal == "breakfast")
    assert (first.outcome, first.missed, first.left) == ("finished", 1, 0)


def test_the_day_is_over():
    day = lived(*BREAKFAST[:3], *LUNCH[:2], DRINK[0])
    day.finish()
    assert row(day) == [("breakfast", "finished"), ("lunch", "abandoned")]
    assert [episode.goal for episode in day.closed()] == ["breakfast", "lunch"]
    assert [needless.number for needless in day.needless] == [6]  # cheaper than a goal that was begun for nothing


def test_an_unknown_action_is_needless_and_told_with_the_nearest():
    day = lived(BREAKFAST[0], "eatt(biscuits, plate)", "dance", "cook(meal, sink)", *BREAKFAST[1:])
    assert row(day) == [("breakfast", "finished")]
    foreign = [needless.foreign for needless in day.needless]
    assert [one.nearest for one in foreign] == ["eat(biscuits, plate)", None, "cook(meal, hobs)"]
    assert foreign[0].reasons == ("no plan has the action eatt",)
    assert "dance (no plan has the action dance)" in str(day)


def test_goals_that_nobody_needs_cost():
    day = day_of("goal(g). g --> a, b, c. goal(h). h --> a, d, e. goal(i). i --> b, f, e.")
    observing(day, "a", "b", "c")
    assert row(day) == [("g", "finished")]


def test_an_uncertain_action_is_weighed():
    day = lived({BREAKFAST[0]: 0.9, DRINK[0]: 0.1})
    assert day.current["breakfast"] > 5 * day.current["drink"] > 0


def test_partners_are_kept_apart():
    day = day_of("goal(g). g --> a, b, c. goal(h). h --> a, c, d.")
    for one, other in zip("abc", "acd"):
        day.observe(one, agent="ann")
        day.observe(other, agent="bob")
    assert [(e.goal, e.agent, e.outcome) for e in day.episodes] == [("g", "ann", "finished"), ("h", "bob", "finished")]


def test_what_an_agent_may_not_do_is_not_theirs():
    assert row(lived(*DRINK, agent="human")) == [("drink", "finished")]
    assert len(lived(*DRINK, agent="tiago").needless) >= 1  # robots do not sip


def test_a_step_that_fits_there_only_belongs_to_the_others_goal():
    day = day_of("goal(g). g --> a, b, c, d. goal(h). h --> x, y, z.")
    observing(day, "a", "b", agent="ann")
    observing(day, "x", agent="bob")
    observing(day, "c", agent="bob")
    assert [(e.goal, e.agent, e.observations) for e in day.episodes] == [("g", "ann", (1, 2, 4)), ("h", "bob", (3,))]


def test_one_would_rather_go_on_with_ones_own_goal():
    day = day_of("goal(g). g --> a, b. goal(h). h --> a, b, c.")
    observing(day, "a", agent="ann")
    observing(day, "a", agent="bob")
    observing(day, "b", agent="bob")
    (bobs,) = [e for e in day.episodes if e.agent == "bob"]
    assert bobs.observations == (2, 3)


def test_what_an_observation_serves_can_be_told():
    day = lived(needless=0.1)
    day.observe("pick_and_place(plate, sink)", goals=["lunch"])
    assert day.leading == "lunch"
    day.observe("eat(biscuits, plate)", goals=[])
    assert [needless.number for needless in day.needless] == [2]
    with pytest.raises(CasperError, match=r"lanch is no goal; did you mean lunch\?"):
        day.observe("eat", goals=["lanch"])


def test_the_robots_part_is_of_what_was_touched_last():
    day = lived(DRINK[0], *LUNCH[:3])
    plan = day.plan_for("tiago")
    assert plan.goal == "lunch" and [str(action) for action in plan.actions] == BREAKFAST[2:]
    assert lived().plan_for("tiago") is None and lived().frontier == ()


def test_why_an_open_goal_cannot_take_an_action():
    assert lived(DRINK[0]).reasons(BREAKFAST[1]) == {"drink": ("drink has no eat",)}
    assert lived(DRINK[0]).reasons(DRINK[1]) == {}


def test_it_prints_the_row_of_episodes():
    day = lived(*BREAKFAST, DRINK[0])
    assert repr(day) == "<Day of 5 observations: breakfast finished, drink under way>"
    assert "breakfast: finished (4 seen, 1 to 4)" in str(day) and "drink: under way (1 seen, 5 to 5)" in str(day)


def test_its_json_is_a_readings_and_more():
    told = lived(*BREAKFAST, DRINK[0]).to_json(1)
    assert {"observations", "explanations", "confidence", "outcome", "posterior", "best", "frontier", "rejected"} <= set(told)
    assert [(e["goal"], e["outcome"], e["observations"]) for e in told["episodes"]] == [
        ("breakfast", "finished", [1, 2, 3, 4]), ("drink", None, [5]),
    ]  # fmt: skip
    assert told["best"][0]["goals"] == ["breakfast", "drink"] and len(told["best"][0]["leaves"]) == 8
    assert told["rejected"] == [{"goal": "lunch", "reasons": ["Food of lunch is meal, not bottle"]}] or told["rejected"]


def test_domains_may_state_prices(tmp_path):
    (tmp_path / "plans.pl").write_text("g --> a, b.\nsetting(plans, begin, 0.2).\nsetting(plans, recursion, 2).\n")
    from casper import Domain

    domain = Domain.load(tmp_path)
    assert domain.prices.begin == 0.2 and domain.day(begin=0.3).prices.begin == 0.3


@pytest.mark.parametrize(
    ("stated", "said"),
    [
        ("setting(plans, begin, 2).", r"plans.pl:2.*a price is a number above 0 and below 1"),
        ("setting(plans, begin, much).", r"plans.pl:2.*should be a number"),
        ("setting(plans, begn, 0.1).", r"plans.pl:2.*is unknown; did you mean begin\?"),
    ],
)
def test_prices_that_make_no_sense_are_refused_with_their_place(tmp_path, stated, said):
    (tmp_path / "plans.pl").write_text(f"g --> a, b.\n{stated}\n")
    from casper import Domain

    with pytest.raises(DomainError, match=said):
        Domain.load(tmp_path).day()


@pytest.mark.parametrize("price", [0, 1, -1, float("nan"), True, "much"])
def test_a_price_that_is_none_is_refused(price):
    with pytest.raises(DomainError, match="a price is a number above 0 and below 1"):
        lived(needless=price)


def test_a_condition_in_a_plan_is_asked_where_it_stands_and_says_why_not(tmp_path):
    (tmp_path / "ontology.pl").write_text(
        "human(ann). robot(rob). vessel(pot). vessel(pan). at(pan, sink).\npick(A, V) :- human(A), vessel(V). wash(A, V) :- human(A), vessel(V).\n"
    )
    (tmp_path / "plans.pl").write_text(
        "goal(clean(_)). clean(V) --> {\\+ at(V, sink)}, pick(V), {did(pick(_, V), _)}, wash(V).\n"
    )
    from casper import Domain

    day = Domain.load(tmp_path).day()
    day.observe("pick(pan)")
    assert day.leading is None and day.rejected == {"clean": ("at(pan, sink) holds",)}
    assert "not this: at(pan, sink) holds" in str(day)
    day.observe("pick(pot)")
    day.observe("wash(pot)")
    [episode] = day.episodes
    assert (episode.outcome, episode.observations) == ("finished", (2, 3))


def test_a_condition_that_looks_back_is_asked_of_what_had_happened_when_it_was_due(tmp_path):
    (tmp_path / "ontology.pl").write_text(
        "human(ann). robot(rob). vessel(pot). vessel(pan).\npick(A, V) :- human(A), vessel(V). wash(A, V) :- human(A), vessel(V). go(A) :- human(A).\n"
    )
    (tmp_path / "plans.pl").write_text("goal(clean(_)). clean(V) --> {did(pick(_, V), _)}, go, wash(V).\ngoal(tidy(_)). tidy(V) --> pick(V).\n")
    from casper import Domain

    day = Domain.load(tmp_path).day(most_missed=0)
    for action in ("pick(pan)", "go", "pick(pot)", *["pick(pan)"] * 3, "wash(pot)"):
        day.observe(action)
    assert day.leading is None  # the pot was not picked yet when she went
    other = Domain.load(tmp_path).day(most_missed=0)
    for action in ("pick(pan)", "go", "pick(pot)", *["pick(pan)"] * 3, "wash(pan)"):
        other.observe(action)
    assert other.leading == "clean"
