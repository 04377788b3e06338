"""A course of episodes: where each action belongs, how episodes end, and what is withdrawn."""

import pytest

from casper import Domain
from casper.engine.reading.course import Course
from casper.engine.reading.episodes import MOST_HELPED
from casper.engine.reading.policy import best
from casper.engine.reading.reading import Reading
from casper.engine.recognition.options import Options
from casper.engine.verification.matching import NameMatcher
from casper.engine.verification.observation import Observation
from casper.kb.errors import CasperError
from casper.kb.terms.terms import Compound
from casper.plans.library import PlanLibrary

HOME = """
goal(tea). tea --> boil, pour, drink, rinse.
goal(toast). toast --> slice, grill, eat.
goal(mail). mail --> fetch, open.
"""


def course(text=HOME, can=("rinse",), **options):
    """A course over plans by name, with a robot that can do some actions."""
    stops = options.pop("stops", False)
    library = PlanLibrary.from_text(text)
    capability = lambda s, leaf, _: (s.leaves[leaf], s.leaves[leaf][0] in can)  # noqa: E731
    fresh = lambda: Reading(library, NameMatcher(library.ways), best, capability, Options(**options))  # noqa: E731
    return Course("ann", "bot", fresh, stops=stops)


def seen(day, *actions, after=0.0):
    """The events of actions, one a second."""
    return [e for t, a in enumerate(actions, 1) for e in day.read(Observation(a, ()), after + t)]


def told(events, *types):
    return [(e.type, e.data["goal"], e.data.get("outcome")) for e in events if e.type in types]


def rows(day):
    return [(row["goal"], row["outcome"]) for row in day.rows]


def test_when_all_of_a_goal_was_seen_its_episode_is_finished_and_the_next_action_begins_another():
    day = course()
    seen(day, "slice", "grill", "eat", "fetch", "open")
    assert rows(day) == [("toast", "finished"), ("mail", "finished")]


def test_an_episode_says_whose_it_is_from_when_to_when_and_how_much_was_seen():
    day = course()
    *_, last = seen(day, "slice", "eat")
    assert (last.type, last.t) == ("episode", 2.0)
    assert last.data == {
        "agent": "ann", "goal": "toast", "outcome": "finished", "from": 1.0, "to": 2.0, "observed": 2, "missed": 1,
    }  # fmt: skip


def test_what_fits_no_more_and_begins_another_goal_means_that_the_first_was_given_up():
    day = course()
    events = seen(day, "slice", "fetch", "open")
    assert told(events, "episode") == [("episode", "toast", "abandoned"), ("episode", "mail", "finished")]
    assert [row["to"] for row in day.rows] == [1.0, 3.0]  # it ended when it was last touched


def test_what_was_announced_for_a_goal_that_is_given_up_is_withdrawn_with_the_reason_before_anything_else():
    events = seen(course(), "boil", "slice")
    at = [e.type for e in events].index("withdrawn")
    assert [e.type for e in events][at:] == ["withdrawn", "episode", "reading"]
    withdrawn = events[at]
    assert (withdrawn.data["agent"], withdrawn.data["partner"], withdrawn.data["goal"]) == ("bot", "ann", "tea")
    assert withdrawn.data["because"] == "ann went over to slice: tea has no slice"


def test_a_goal_that_another_was_given_up_for_is_believed_with_its_second_action():
    predicted = told(seen(course(), "boil", "slice", "grill"), "prediction")
    assert predicted == [("prediction", "tea", None), ("prediction", "toast", None)]
    assert told(seen(course(), "boil", "slice"), "prediction") == [("prediction", "tea", None)]


def test_two_actions_that_fit_nothing_and_that_a_goal_has_begin_it_though_its_first_was_not_seen():
    day = course()
    events = seen(day, "boil", "grill", "eat")
    assert [e.data["message"] for e in events if e.type == "warning"] != []
    assert told(events, "episode") == [("episode", "tea", "abandoned"), ("episode", "toast", "finished")]


def test_what_fitted_nothing_and_an_action_that_fits_are_another_goal_where_that_explains_more():
    text = """
    goal(tea). tea --> boil, pour, tidy.
    goal(toast). toast --> slice, eat, tidy, sleep.
    """
    day = course(text, can=())
    seen(day, "boil", "eat", "tidy")
    assert rows(day) == [("tea", "abandoned")]
    assert [str(o) for o in day.current.reading.observations] == ["eat", "tidy"]
    whole = course(text, can=())
    seen(whole, "boil", "pour", "eat", "tidy")
    assert rows(whole) == [("tea", "finished")]


def test_a_goal_that_was_taken_to_be_given_up_was_not_where_what_it_needs_was_done_unseen():
    day = course(can=())
    seen(day, "boil", "pour", "fetch")
    assert rows(day) == [("tea", "abandoned")]
    events = list(day.inferred(Observation("rinse", ()), 9.0))
    assert told(events, "prediction", "plan") == []
    assert rows(day) == [] and [str(o) for o in day.helped[0].reading.observations] == ["boil", "pour", "rinse"]
    assert list(day.inferred(Observation("slice", ()), 9.0)) == []


def test_nothing_is_withdrawn_where_the_robot_could_do_nothing():
    assert not told(seen(course(can=()), "boil", "slice"), "withdrawn")


def test_an_episode_of_which_only_the_robots_part_is_left_stays_open_until_the_robot_has_done_it():
    day = course()
    events = seen(day, "boil", "pour", "drink", "slice")
    assert not told(events, "episode", "withdrawn")
    (end,) = day.did(Compound(("rinse",)), 9.0)
    assert (end.data["goal"], end.data["outcome"], end.data["to"]) == ("tea", "finished", 9.0)
    seen(day, "grill", "eat", after=10.0)
    assert rows(day) == [("tea", "finished"), ("toast", "finished")]


def test_the_partner_may_do_what_they_had_left_to_the_robot():
    day = course()
    events = seen(day, "boil", "pour", "drink", "slice", "rinse", "grill", "eat")
    assert told(events, "episode") == [("episode", "tea", "finished"), ("episode", "toast", "finished")]


def test_a_part_that_the_robot_fails_in_is_left_to_the_partner():
    day = course()
    seen(day, "boil", "pour", "drink")
    day.failed(Compound(("rinse",)))
    assert not day.current.supervisor.ready
    assert told(seen(day, "rinse"), "episode") == [("episode", "tea", "finished")]


def test_what_the_robot_failed_in_and_nobody_did_is_unclear():
    day = course()
    seen(day, "boil", "pour", "drink")
    day.failed(Compound(("rinse",)))
    assert told(seen(day, "slice"), "episode") == [("episode", "tea", "unclear")]


def test_what_was_not_done_after_all_is_taken_back_and_the_goal_that_it_seemed_to_end_goes_on():
    day = course()
    seen(day, "boil", "slice")
    events = list(day.refuted(Observation("slice", ()), 3.0, "the bread was put elsewhere"))
    assert told(events, "episode") == [("episode", "toast", "abandoned")]
    assert [row[0] for row in rows(day)] == ["toast"] and day.current.goal == "tea"
    assert told(seen(day, "pour", "drink", "rinse", after=5.0), "episode") == [("episode", "tea", "finished")]


def test_of_several_actions_only_the_last_one_is_taken_back():
    day = course()
    seen(day, "boil", "pour")
    list(day.refuted(Observation("pour", ()), 3.0, "the water was put elsewhere"))
    assert [str(o) for o in day.current.reading.observations] == ["boil"]
    assert list(day.refuted(Observation("slice", ()), 4.0, "nobody did that")) == []


def test_steps_of_a_goal_that_is_come_back_to_may_have_gone_unseen():
    day = course()
    seen(day, "boil", "slice", "drink")
    assert rows(day) == [] and day.helped[0].explanation.missed == 1


def test_a_step_of_a_goal_that_is_over_takes_up_none_that_was_given_up():
    day = course("goal(g). g --> a, b, wipe. goal(h). h --> c, wipe.", can=())
    assert told(seen(day, "a", "c", "wipe"), "episode") == [("episode", "g", "abandoned"), ("episode", "h", "finished")]
    assert [e.type for e in seen(day, "wipe", after=9.0)] == ["warning"]


def test_who_comes_back_to_a_goal_never_gave_it_up():
    day = course()
    assert told(seen(day, "boil", "slice"), "episode") == [("episode", "tea", "abandoned")]
    seen(day, "pour")
    assert rows(day) == []
    assert told(seen(day, "grill", "drink", "rinse", "eat"), "episode") == [("episode", "tea", "finished"), ("episode", "toast", "finished")]


def test_what_the_robot_did_for_nobody_changes_nothing():
    day = course()
    seen(day, "boil")
    assert list(day.did(Compound(("sweep",)), 5.0)) == []


def test_an_action_that_has_to_be_done_twice_is_not_done_with_once():
    day = course("goal(g). g --> a, wipe, wipe. goal(h). h --> b.", can=("wipe",))
    seen(day, "a")
    assert list(day.did(Compound(("wipe",)), 2.0)) == []
    assert told(day.did(Compound(("wipe",)), 3.0), "episode") == [("episode", "g", "finished")]


def test_an_action_that_fits_nothing_is_left_out_and_the_episode_goes_on():
    day = course()
    events = seen(day, "slice", "pour", "grill", "eat")
    assert [e.data["message"].split(" (")[0] for e in events if e.type == "warning"] == ["pour fits no plan any more and is left out"]
    assert rows(day) == [("toast", "finished")]


def test_where_it_stops_an_action_that_fits_nothing_is_refused():
    day = course(stops=True)
    seen(day, "slice")
    with pytest.raises(CasperError, match="pour fits no plan any more"):
        seen(day, "pour")


def test_a_step_seen_once_more_after_its_goal_was_finished_begins_nothing():
    day = course()
    events = seen(day, "slice", "grill", "eat", "eat")
    assert events[-1].data["message"] == "eat is left out: toast, which has it, is over"
    assert rows(day) == [("toast", "finished")]


def test_the_same_goal_may_be_pursued_again():
    day = course()
    seen(day, *["slice", "grill", "eat"] * 3)
    assert rows(day) == [("toast", "finished")] * 3


def test_a_goal_whose_first_step_went_unseen_is_read_too():
    day = course()
    seen(day, "slice", "grill", "eat", "pour", "drink")
    assert day.current.goal == "tea"
    assert day.current.explanation.missed == 1


def test_an_episode_is_not_closed_while_another_goal_may_still_be_meant():
    day = course("goal(g). g --> a. goal(h). h --> a, b.")
    assert not told(seen(day, "a"), "episode")
    assert told(seen(day, "b"), "episode") == [("episode", "h", "finished")]
    day = course("goal(g). g --> a. goal(h). h --> a, b.")
    assert told(seen(day, "a", "a"), "episode") == [("episode", "g", "finished")]


def test_an_optional_end_is_waited_for_and_not_demanded():
    text = "goal(g). g --> a, optional(b). goal(h). h --> c."
    assert rows_of(text, "a", "b") == [("g", "finished")]
    assert rows_of(text, "a", "c") == [("g", "finished"), ("h", "finished")]


def rows_of(text, *actions):
    day = course(text)
    seen(day, *actions)
    return rows(day)


def test_an_episode_without_a_goal_ends_unclear():
    assert rows_of("goal(g). g --> a, b. goal(h). h --> a, c. goal(i). i --> d.", "a", "d") == [(None, "unclear"), ("i", "finished")]


def test_at_the_end_what_is_open_is_unclear():
    day = course()
    seen(day, "boil", "pour", "drink", "slice")
    assert told(day.end(9.0), "episode") == [("episode", "tea", "unclear"), ("episode", "toast", "unclear")]
    assert list(day.end(9.0)) == []


def test_where_needless_actions_have_a_price_one_that_begins_a_goal_begins_it():
    day = course(noise=0.1)
    events = seen(day, "slice", "pour", "grill", "fetch", "open")
    assert not told(events, "warning")
    assert rows(day) == [("toast", "abandoned"), ("mail", "finished")]
    assert day.rows[0]["observed"] == 2


def test_a_second_goal_beside_the_first_is_one_episode_with_it():
    day = course(goals=2)
    seen(day, "slice", "fetch", "grill", "open", "eat")
    assert [row["outcome"] for row in day.rows][-1] == "finished"
    assert not any(row["outcome"] == "abandoned" for row in day.rows)


def test_of_many_parts_that_the_robot_never_does_the_oldest_are_given_up_as_unclear():
    day = course()
    for n in range(MOST_HELPED + 3):
        seen(day, "boil", "pour", "drink", after=10.0 * n)
    assert len(day.helped) == MOST_HELPED
    assert rows(day) == [("tea", "unclear")] * 2


def test_the_reading_of_a_new_episode_knows_what_was_done_before(tmp_path):
    (tmp_path / "ontology.pl").write_text(
        "human(ann). pot(pot). boil(A, P) :- human(A), pot(P). pour(A, P) :- human(A), pot(P). oil(A, P) :- human(A), pot(P).\n"
        'never("a pot that was oiled boils no water") :- claim(boil(_, P)), did(oil(_, P), _).\n'
    )
    (tmp_path / "plans.pl").write_text("goal(tea(P)) :- pot(P). tea(P) --> boil(P), pour(P).\n")
    domain = Domain.load(tmp_path)
    before = domain.reading()
    before.observe("boil(pot)")
    after = domain.reading(earlier=[Compound(("oil", "ann", "pot"))])
    after.observe("boil(pot)")
    assert (before.count, after.count) == (1, 0)
    assert after.rejected["tea"] == ("a pot that was oiled boils no water",)
