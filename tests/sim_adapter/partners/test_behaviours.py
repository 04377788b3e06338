"""What each behaviour makes of a partner's script: data to data, the same for the same seed."""

import random
from itertools import pairwise

import pytest

pytest.importorskip("mujoco")

from hypothesis import given
from hypothesis import strategies as st

from casper import Domain
from casper.kb.errors import DomainError
from casper.sim_adapter.partners.behaviours.table import BEHAVIOURS, NAMES, behaving, check_behaviours
from casper.sim_adapter.partners.conduct import Surroundings, plain
from casper.sim_adapter.room.facts import scene_of
from casper.sim_adapter.steps import check_objects

DOMAINS = {name: Domain.load(name) for name in ("kitchen", "workshop", "care_home", "minimal")}
SCENES = {name: scene_of(domain) for name, domain in DOMAINS.items()}
KITCHEN = ("breakfast", "drink", "lunch")
seeds = st.integers(0, 10_000)


def conduct_of(name, seed, goals=None, domain="kitchen"):
    """What somebody does for goals, drawn from the seed when none are named."""
    surroundings = Surroundings(DOMAINS[domain], SCENES[domain], seed)
    goals = goals or [random.Random(seed).choice(surroundings.goals)]
    return behaving(plain(surroundings, goals), name, surroundings)[0]


def steps_of(stretch, goal):
    """The steps that serve a goal, in order."""
    return [scripted.step for scripted in stretch.script if scripted.goal == goal and scripted.action is not None]


def asides_of(stretch):
    return [scripted.step for scripted in stretch.script if scripted.action is None]


@given(seeds, st.sampled_from([*BEHAVIOURS, "mixed", "forgetful,pausing,eager", "fickle,wandering,visited"]))
def test_the_same_seed_gives_the_same_conduct(seed, name):
    assert conduct_of(name, seed) == conduct_of(name, seed)


@given(seeds, st.sampled_from(list(BEHAVIOURS)), st.sampled_from(list(DOMAINS)))
def test_every_goal_keeps_its_steps_in_their_order_whatever_somebody_does_besides(seed, name, domain):
    try:
        conduct = conduct_of(name, seed, domain=domain)
    except DomainError as mistake:
        assert mistake.sentence  # nobody can behave so in that room
        return
    surroundings = Surroundings(DOMAINS[domain], SCENES[domain], seed)
    whole = [{s.step for s in surroundings.stretch(goal, n).script} for n in (0, 1) for goal in surroundings.goals]
    for stretch in conduct.stretches:
        assert all(set(steps_of(stretch, goal)) in whole for goal in stretch.goals)
    for scripted in (scripted for stretch in conduct.stretches for scripted in stretch.script):
        check_objects(SCENES[domain], scripted.step)


@given(seeds)
def test_who_changes_their_mind_stops_the_first_goal_in_the_middle_for_another_one(seed):
    first, second = conduct_of("fickle", seed).stretches
    assert first.goals != second.goals and second.stops is None
    assert 0 < first.stops < len(first.script)
    moved = {scripted.step.target for scripted in first.script[: first.stops]}
    assert moved.isdisjoint(second.things)


def test_people_change_their_mind_at_different_points():
    assert {conduct_of("fickle", seed, ["lunch", "drink"]).stretches[0].stops for seed in range(40)} == {1, 2, 3}


@given(seeds)
def test_pauses_are_seconds_of_standing_still(seed):
    pauses = asides_of(conduct_of("pausing", seed).stretches[0])
    assert 1 <= len(pauses) <= 3
    assert all(step.skill == "still" and 5 <= step.seconds <= 25 for step in pauses)


@given(seeds)
def test_who_wanders_handles_only_what_the_goal_does_not_need(seed):
    stretch = conduct_of("wandering", seed).stretches[0]
    handled = [step for step in asides_of(stretch) if step.skill in ("handle", "set_down")]
    assert handled and not {step.target for step in handled} & stretch.things


def test_a_forgotten_step_is_done_after_the_next_one_was_done_too_early():
    found = {conduct_of("forgetful", seed, ["lunch"]).stretches[0].script for seed in range(20)}
    texts = {tuple(str(s.step) for s in script) for script in found}
    assert any(
        row[:5]
        == ("pick_and_place(meal, hobs)", "pick_and_place(meal, plate)", "pick_and_place(meal, hobs)", "use(meal, hobs)", "pick_and_place(meal, plate)")
        for row in texts
    )
    assert any(row[:2] == ("walk_to(hobs)", "still()") for row in texts)


@given(seeds)
def test_two_goals_at_once_take_turns_and_move_different_things(seed):
    stretch = conduct_of("juggling", seed).stretches[0]
    whose = [scripted.goal for scripted in stretch.script]
    assert len(stretch.goals) == 2 and stretch.goals[0] == whose[0]
    assert sum(a != b for a, b in pairwise(whose)) > 1
    moved = [{s.target for s in steps_of(stretch, goal)} for goal in stretch.goals]
    assert moved[0].isdisjoint(moved[1])


def test_two_goals_that_move_the_same_thing_cannot_be_pursued_at_once():
    with pytest.raises(DomainError) as mistake:
        conduct_of("juggling", 0, ["breakfast", "lunch"])
    assert mistake.value.sentence == "there is no goal that can be pursued beside breakfast: two goals at once must move different things"


@given(seeds)
def test_who_stands_in_the_way_stands_where_something_is_left_to_be_done(seed):
    stretch = conduct_of("blocking", seed).stretches[0]
    walk, stand = asides_of(stretch)
    own = next(n for n, scripted in enumerate(stretch.script) if scripted.action is None)
    left = {name for s in stretch.script[own:] for name in (s.step.target, s.step.destination) if s.action is not None}
    assert walk.target in left and 10 <= stand.seconds <= 45


@given(seeds)
def test_what_is_put_elsewhere_lies_far_from_every_place_a_plan_knows(seed):
    (step,) = asides_of(conduct_of("misplacing", seed).stretches[0])
    others = [thing for name, thing in SCENES["kitchen"].things.items() if name != step.target]
    assert all((thing.x - step.spot[0]) ** 2 + (thing.y - step.spot[1]) ** 2 > 0.3**2 for thing in others)


@given(seeds)
def test_a_visitor_moves_what_the_goal_needs(seed):
    conduct = conduct_of("visited", seed)
    things = {step.target for step in conduct.visit if step.skill == "set_down"}
    assert things and things <= conduct.stretches[0].things


def test_who_does_everything_alone_keeps_every_step_and_the_eager_one_or_two():
    assert conduct_of("alone", 0).keeps is None
    assert {conduct_of("eager", seed).keeps for seed in range(20)} == {1, 2}


def test_mixed_draws_each_behaviour_and_plain_from_the_seed():
    surroundings = [Surroundings(DOMAINS["kitchen"], SCENES["kitchen"], seed) for seed in range(120)]
    drawn = {behaving(plain(s, ["lunch"]), "mixed", s)[1] for s in surroundings}
    assert drawn == {(), *((name,) for name in BEHAVIOURS)}


def test_mixed_leaves_out_what_nobody_can_do_in_a_room():
    surroundings = [Surroundings(DOMAINS["minimal"], SCENES["minimal"], seed) for seed in range(60)]
    for where in surroundings:
        assert behaving(plain(where, [where.goals[0]]), "mixed", where)[0].stretches


@pytest.mark.parametrize(
    ("wanted", "said"),
    [
        ("forgetfull", f"there is no partner 'forgetfull': choose {', '.join(NAMES)}; did you mean forgetful?"),
        ("", f"there is no partner '': choose {', '.join(NAMES)}"),
        ("mixed,eager", "plain and mixed stand alone, not in 'mixed,eager'"),
        ("fickle,juggling", "fickle and juggling do not go together: each says which goals there are"),
    ],
)
def test_a_setting_that_makes_no_sense_is_refused(wanted, said):
    with pytest.raises(DomainError) as mistake:
        check_behaviours(wanted)
    assert mistake.value.sentence.replace("juggling and fickle", "fickle and juggling") == said
