"""Laws of domains whose plans name somebody else, and whose constraints look at times."""

from hypothesis import find, given, settings

from casper.engine.domain.domain import Domain
from casper.testing.laws.rules import constraints_can_fire
from casper.testing.strategies import observations

ONTOLOGY = """
human(ann). robot(rob). agent(X) :- human(X). agent(X) :- robot(X).
eat(A, bread) :- human(A).   measure(A, pulse) :- human(A).   take(A, pills) :- human(A).   tidy(A, pills) :- agent(A).
never("no pills long after measuring") :-
    claim(take(A, _)), did(measure(A, _), M), did(eat(A, _), E), E - M > 600.
"""
DOMAIN = Domain.from_text(
    ontology=ONTOLOGY, plans="dose --> measure(pulse), eat(bread), take(pills), by(robot, tidy(pills))."
)


def test_a_constraint_between_two_times_can_fire():
    constraints_can_fire(DOMAIN)


@settings(max_examples=10)
@given(observations(DOMAIN, drop=0.5))
def test_what_the_plan_leaves_to_the_robot_is_not_seen_of_the_partner(pursuit):
    assert pursuit.steps[pursuit.others[0]] == "tidy(pills)"
    assert "tidy(pills)" not in pursuit.actions and pursuit.actions
    assert pursuit.own == ("measure(pulse)", "eat(bread)", "take(pills)")


def test_the_whole_pursuit_is_what_it_shrinks_to():
    pursuit = find(observations(DOMAIN), lambda found: True)
    assert pursuit.actions == pursuit.own
