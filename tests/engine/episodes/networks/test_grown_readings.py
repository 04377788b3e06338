"""Readings of domains whose plans are not listed: what a reading says, from lazily grown states."""

import pickle

import pytest
from grown import networks
from hypothesis import given
from hypothesis import strategies as st

from casper.engine.domain.check import check_domain
from casper.engine.domain.domain import Domain
from casper.engine.episodes.networks.reading import GrownReading
from casper.engine.reading.policy import strict
from casper.engine.reading.reading import Reading, nobody_can
from casper.engine.recognition.options import PAPER
from casper.engine.verification.matching import ParameterMatcher
from casper.kb.errors import CasperError
from casper.plans.library import PlanLibrary

ONTOLOGY = """human(ann). robot(rob). agent(X) :- human(X). agent(X) :- robot(X).
vessel(plate). vessel(cup). food(jam). at(plate, sink).
pick(A, V) :- agent(A), vessel(V). wash(A, V) :- agent(A), vessel(V). eat(A, F) :- human(A), food(F).
"""
PLANS = """goal(tidy(_)). goal(dine).
tidy(V) --> {vessel(V), \\+ at(V, sink)}, pick(V), wash(V), more.
more --> []. more --> tidy(_).
dine --> eat(jam), dine. dine --> by(robot, wash(cup)).
"""


@pytest.fixture
def reading(tmp_path):
    (tmp_path / "ontology.pl").write_text(ONTOLOGY)
    (tmp_path / "plans.pl").write_text(PLANS)
    return Domain.load(tmp_path).reading()


def test_such_a_domain_is_read(reading):
    reading.observe("pick(cup)")
    assert (reading.outcome, reading.count, reading.posterior) == ("tidy", 1, {"tidy": 1.0, "dine": 0.0})
    assert [str(action) for action in reading.frontier] == ["wash(cup)"]
    assert reading.rejected == {"dine": ("dine has no pick",)}
    assert str(reading.plan_for("rob")) == "rob's turn: wash(cup)"
    assert reading.next_actions == {"wash(cup)": 1.0}


def test_what_no_way_takes_is_told_with_the_reason_of_the_base(reading):
    reading.observe("pick(plate)")
    assert reading.count == 0 and reading.rejected["tidy"] == ("at(plate, sink) holds",)
    reading.undo()
    assert reading.rejected == {}


def test_rounds_may_go_on_for_ever(reading):
    for _ in range(20):
        reading.observe("pick(cup)")
        reading.observe("wash(cup)")
    assert (reading.count, reading.is_exact, reading.first.missed) == (1, True, 0)


def test_a_fork_goes_its_own_way_and_a_reading_is_sent_as_what_was_observed(reading):
    reading.observe("pick(cup)")
    what_if = reading.fork()
    what_if.observe("wash(cup)")
    assert (len(reading.observations), len(what_if.observations)) == (1, 2)
    assert pickle.loads(pickle.dumps(what_if)).to_json() == what_if.to_json()


def test_a_missed_leaf_is_something_unseen(reading):
    reading.observe("wash(cup)")
    assert reading.first.missed == 1 and "✗ \"something unseen\"" in str(reading.first)


TWO_GOALS = """goal(tea). goal(soup).
tea --> boil, more, sip. soup --> boil, more, eat.
more --> []. more --> stir, more.
"""


def test_what_tells_goals_apart_is_asked():
    reading = Domain.from_text(plans=TWO_GOALS).reading()
    reading.observe("boil")
    asked = {str(question): round(question.gain, 6) for question in reading.questions()}
    assert asked["is the goal tea?"] == asked["will sip still be done?"] == 1.0
    assert asked["is stir next?"] == 0.0


def test_nothing_is_asked_that_some_explanation_does_not_know():
    reading = Domain.from_text(plans=TWO_GOALS.replace("soup --> boil, more, eat", "soup --> boil, more, optional(sip)")).reading()
    reading.observe("boil")
    assert "will sip still be done?" not in map(str, reading.questions())


def test_several_goals_at_once_are_refused(tmp_path):
    (tmp_path / "plans.pl").write_text("goal(g). g --> a, g. g --> b.")
    with pytest.raises(CasperError, match="one goal at a time"):
        Domain.load(tmp_path).reading(goals=2)


def test_needless_actions_have_their_price(tmp_path):
    (tmp_path / "plans.pl").write_text("goal(g). g --> a, g. g --> b.")
    reading = Domain.load(tmp_path).reading(noise=0.1)
    reading.observe("b")
    reading.observe("a")
    assert reading.first.needless == (1,) and reading.first.score == pytest.approx(0.1)


def test_a_domain_that_is_not_listed_has_no_errors_for_it(tmp_path):
    (tmp_path / "ontology.pl").write_text(ONTOLOGY)
    (tmp_path / "plans.pl").write_text(PLANS)
    assert [str(f.severity) for f in check_domain(tmp_path)] == ["note"]


ROWS = st.lists(st.sampled_from(["a(X)", "b(X)", "c(cup)", "optional(d(X))", "(a(X) ; d(cup))"]), min_size=1, max_size=4)


@given(st.tuples(ROWS, ROWS), st.lists(st.sampled_from(["a(cup)", "b(cup)", "c(cup)", "d(cup)"]), min_size=1, max_size=3))
def test_rows_without_equal_siblings_weigh_what_listed_ones_do(rows, seen):
    bodies = [[item for item in dict.fromkeys(row)] for row in rows]
    text = " ".join(f"goal(g{n}). g{n} --> {', '.join(body)}, e(X)." for n, body in enumerate(bodies))
    text += " goal(all). all --> a(cup), b(cup), c(cup), d(cup), e(cup)."
    library = PlanLibrary.from_text(text)
    listed = Reading(library, ParameterMatcher(library.ways))
    free = GrownReading(library, networks(text, most_missed=30), strict, nobody_can, PAPER)
    for action in seen:
        listed.observe(action)
        free.observe(action)
    assert free.posterior == pytest.approx(dict(listed.posterior))
    assert free.count == listed.count
