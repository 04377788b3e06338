"""The robot's part: the longest run of what is yet to be done that it can do, whatever order the plan leaves open."""

from itertools import combinations, pairwise
from unittest.mock import ANY

import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper import Domain
from casper.engine.collaboration.collaboration import collaborative_plan, longest_run
from casper.engine.collaboration.supervisor import Supervisor
from casper.engine.explanation.situation import Situation
from casper.engine.reading.policy import best
from casper.engine.reading.reading import Reading
from casper.engine.recognition.options import Options
from casper.engine.verification.matching import NameMatcher
from casper.plans.library import PlanLibrary


def part(text, *seen, can=()):
    """The robot's part when it can do these actions, after these observations."""
    library = PlanLibrary.from_text(text)
    reading = Reading(library, NameMatcher(library.ways), capability=lambda e, leaf, _: (e.leaves[leaf], e.leaves[leaf][0] in can))
    for action in seen:
        reading.observe(action)
    plan = reading.plan_for("robot")
    return [leaf[0] for leaf in plan.waiting], [leaf[0] for leaf in plan.actions]


@pytest.mark.parametrize(
    ("able", "run"),
    [([], []), ([0], []), ([1], [0]), ([1, 0, 1], [2]), ([1, 1, 0, 1], [0, 1]), ([1, 1, 0, 1, 1, 0], [3, 4])],
)
def test_in_a_row_the_longest_run_is_the_later_of_equally_long_ones(able, run):
    before = [(1 << at) - 1 for at in range(len(able))]
    can = [at for at, yes in enumerate(able) if yes]
    assert list(longest_run(can, [at for at in range(len(able)) if at not in can], before)) == run


@st.composite
def orders(draw):
    """A partial order of a few leaves, as masks of what comes before each, and who can do which."""
    size = draw(st.integers(1, 6))
    before = []
    for leaf in range(size):
        directly = draw(st.sets(st.integers(0, leaf - 1))) if leaf else set()
        before.append(0)
        for earlier in directly:
            before[leaf] |= 1 << earlier | before[earlier]
    return before, draw(st.sets(st.integers(0, size - 1)))


def is_one_go(run, able, before):
    """Whether nothing that others must do comes between two leaves of the run."""
    others = set(range(len(before))) - able
    return not any(before[last] >> other & 1 and before[other] >> first & 1 for first in run for last in run for other in others)


@given(orders())
def test_a_run_can_be_done_in_one_go(order):
    before, able = order
    run = longest_run(sorted(able), sorted(set(range(len(before))) - able), before)
    assert set(run) <= able
    assert is_one_go(run, able, before)
    assert bool(run) == bool(able)


@given(orders())
def test_no_run_of_what_waits_for_the_same_is_longer(order):
    before, able = order
    others = sorted(set(range(len(before))) - able)
    theirs = sum(1 << other for other in others)
    run = longest_run(sorted(able), others, before)
    for size in range(len(run) + 1, len(able) + 1):
        for rival in combinations(sorted(able), size):
            same = len({before[leaf] & theirs for leaf in rival}) == 1
            assert not (same and is_one_go(rival, able, before))


def test_the_robot_waits_only_for_what_must_come_before_its_run():
    text = "goal(g). g --> lay, steps([x: (eat, stack), y: read, z: wash], [x < z])."
    assert part(text, "lay", can=("stack", "wash")) == (["eat"], ["stack", "wash"])


def test_the_robot_begins_at_once_where_its_part_waits_for_nothing():
    text = "goal(g). g --> greet, unordered(eat, (fetch, fill))."
    assert part(text, "greet", can=("fetch", "fill")) == ([], ["fetch", "fill"])


def test_the_robot_does_not_wait_for_what_may_never_come():
    assert part("goal(g). g --> eat, optional(drink), wash.", "eat", can=("wash",)) == ([], ["wash"])


def test_of_an_open_choice_the_robot_plans_on_the_smallest_alternative():
    text = "goal(g). g --> a, (fetch, carry, put ; push), eat."
    assert part(text, "a", can=("fetch", "carry", "put")) == (["push", "eat"], [])
    assert part(text, "a", "fetch", can=("carry", "put")) == ([], ["carry", "put"])


def test_an_agent_that_can_do_nothing_waits_for_everything():
    assert part("goal(g). g --> a, b, c.", "a") == (["b", "c"], [])


def supervised(text, can, *seen, **options):
    library = PlanLibrary.from_text(text)
    capability = lambda e, leaf, _: (e.leaves[leaf], e.leaves[leaf][0] in can)  # noqa: E731
    reading = Reading(library, NameMatcher(library.ways), best, capability, Options(**options))
    supervisor = Supervisor(reading, "robot")
    told = []
    for t, action in enumerate(seen):
        reading.observe(action)
        events = [e for e in supervisor.update(float(t)) if e.type != "says"]
        told.append([(e.type, e.data.get("waiting"), e.data.get("actions")) for e in events])
    return supervisor, told


def said_of(text, can, *seen):
    """What the robot says, with the type of the event before it."""
    library = PlanLibrary.from_text(text)
    capability = lambda e, leaf, _: (e.leaves[leaf], e.leaves[leaf][0] in can)  # noqa: E731
    reading = Reading(library, NameMatcher(library.ways), best, capability)
    supervisor, events = Supervisor(reading, "robot"), []
    for t, action in enumerate(seen):
        reading.observe(action)
        events += supervisor.update(float(t))
    return supervisor, [(before.type, e.data["text"]) for before, e in pairwise(events) if e.type == "says"]


def test_the_robot_says_in_a_sentence_what_it_will_do_when_its_turn_has_come_and_once_only():
    _, said = said_of("goal(g). goal(h). g --> a, b, wash, dry, optional(c). h --> other.", ("wash", "dry"), "a", "b", "c")
    assert said == [("plan", "Robot will now do wash, then dry, since the goal is g.")]


def test_the_robot_says_nothing_while_it_waits():
    assert said_of("goal(g). goal(h). g --> a, b, wash. h --> other.", ("wash",), "a") == (ANY, [])


def test_what_it_has_said_it_takes_back_in_a_sentence_and_only_then():
    supervisor, _ = said_of("goal(g). goal(h). g --> a, wash. h --> other.", ("wash",), "a")
    withdrawn, says = supervisor.withdraw(2.0, "the goal is h by now")
    assert (withdrawn.type, says.data["text"]) == ("withdrawn", "Robot does none of that now: the goal is h by now.")
    quiet, _ = said_of("goal(g). goal(h). g --> a, b, wash. h --> other.", ("wash",), "a")
    assert [event.type for event in quiet.withdraw(2.0, "the goal is h by now")] == ["withdrawn"]


def test_the_supervisor_waits_for_less_whatever_order_the_partner_chooses():
    text = "goal(g). g --> start, unordered(p, q), wash. h --> other. goal(h)."
    _, told = supervised(text, ("wash",), "start", "q", "p")
    assert [events[-1][1] for events in told] == [["p", "q"], ["p"], []]


def test_the_supervisor_plans_anew_when_the_goal_is_pursued_another_way():
    text = "goal(g). g --> a, b, wash, c. g --> a, d, wash. goal(h). h --> x."
    supervisor, told = supervised(text, ("wash",), "a", "d")
    assert told[0][-1] == ("plan", ["d"], ["wash"]) or told[0][-1] == ("plan", ["b"], ["wash"])
    assert (supervisor.waiting, [str(a) for a in supervisor.actions]) == ((), ["wash"])
    assert supervisor.ready


@pytest.mark.parametrize(
    ("text", "can", "seen", "part"),
    [
        ("g --> a, (sweep ; fill, wash, dry), c.", ("sweep", "wash", "dry"), ("a", "fill"), ([], ["wash", "dry"])),
        ("g --> a, (b ; c, d), wash.", ("wash",), ("a", "c"), (["d"], ["wash"])),
        ("g --> a, optional((u, v)), wash.", ("wash",), ("a", "u"), (["v"], ["wash"])),
        ("g --> a, b, wash.", ("wash",), ("a", "b"), ([], ["wash"])),
    ],
)
def test_the_robots_part_follows_the_way_that_the_partner_takes(text, can, seen, part):
    supervisor, told = supervised(f"goal(g). goal(h). {text} h --> other.", can, *seen)
    assert (told[-1][-1][1:], supervisor.ready) == (part, not part[0])


def test_a_goal_far_down_the_list_is_followed_without_listing_what_is_better():
    text = f"goal(a). goal(b). goal(c). a --> x, y. b --> x, {', '.join(['s'] * 59)}. c --> x, {', '.join(['s'] * 59)}."
    supervisor, _ = supervised(text, ("y",), "x", *["s"] * 14)
    assert supervisor.commitment.goal == "a"
    assert supervisor.reading.count > 10**12


def test_an_optional_step_of_the_partner_does_not_split_the_robots_run():
    assert part("goal(g). g --> a, wash, optional(sip), dry.", "a", can=("wash", "dry")) == ([], ["wash", "dry"])


def test_what_was_not_done_does_not_count_as_done(tmp_path):
    (tmp_path / "ontology.pl").write_text(
        "human(ann). robot(bot). agent(X) :- human(X). agent(X) :- robot(X).\n"
        + "".join(f"{action}(X) :- agent(X).\n" for action in ("a", "rinse", "soak", "dry"))
        + 'never("a robot dries what was soaked") :- claim(dry(X)), robot(X), \\+ did(soak(_), _).\n'
        + 'never("a robot does nothing else") :- claim(S), S \\= dry(_), S = rinse(bot).\n'
    )
    (tmp_path / "plans.pl").write_text("g --> a, (rinse ; soak), dry.\n")
    kitchen = Domain.load(tmp_path)
    for seen, can in (("rinse", []), ("soak", ["dry"])):
        reading = kitchen.reading()
        reading.observe("a")
        reading.observe(seen)
        assert [leaf[0] for leaf in reading.plan_for("bot").actions] == can


def test_with_several_goals_the_robot_helps_with_the_one_it_can_do_most_of():
    text = "goal(g). g --> a, b, wash. goal(h). h --> c, d, tidy, sweep."
    supervisor, told = supervised(text, ("wash", "tidy", "sweep"), "a", "c", goals=2)
    assert supervisor.commitment.goal == "g + h"
    assert supervisor.commitment.plan.goal == "h"
    assert told[-1][-1] == ("plan", ["d"], ["tidy", "sweep"])


def test_a_collaborative_plan_names_the_leaves_behind_it():
    (plan,) = PlanLibrary.from_text("goal(g). g --> a, b, wash.").ways
    part = collaborative_plan("robot", Situation.of(plan, 0b1, ()), lambda e, leaf, _: (e.leaves[leaf], leaf == 2))
    assert (part.awaited, part.leaves) == ((1,), (2,))
    later = part.after(Situation.of(plan, 0b11, ()))
    assert (later.awaited, later.leaves) == ((), (2,))
