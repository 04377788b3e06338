"""What a reading says before anything is seen, after nonsense, and when it is asked for none."""

import pytest
from readings import domain, reading

from casper.engine.reading.priors import priors_of
from casper.engine.reading.questions import Question, entropy
from casper.kb.errors import CasperError, Place


def test_before_anything_is_seen_nothing_is_said():
    fresh = reading()
    assert (fresh.count, fresh.ties, fresh.first, fresh.rejected) == (0, 0, None, {})
    assert fresh.posterior == {"breakfast": 0.0, "drink": 0.0, "lunch": 0.0}
    assert (fresh.next_actions, fresh.frontiers, fresh.plans_for("tiago"), fresh.questions()) == ({}, {}, {}, [])
    assert fresh.plan_for("tiago") is None and fresh.best_of("lunch") is None
    assert list(fresh.explanations()) == []


def test_after_nonsense_nothing_is_said_either():
    seen = reading("pick_and_place(biscuits, sink)")
    assert (seen.count, seen.confidence, seen.outcome, seen.frontier, seen.best(2)) == (0, 0.0, None, (), [])
    assert set(seen.posterior.values()) == {0.0}
    assert seen.to_json()["best"] == [] and seen.to_json()["confidence"] == 0.0


def test_as_many_explanations_come_as_are_asked_for_and_there_are():
    seen = reading("pick_and_place", verification=False)
    assert seen.count > 2
    assert [len(seen.best(asked)) for asked in (-1, 0, 1, 2, 100)] == [0, 0, 1, 2, seen.count]


def test_the_shares_of_all_explanations_are_one_and_the_best_comes_first():
    seen = reading("pick_and_place", "pick_and_place", verification=False)
    shares = [explanation.share for explanation in seen.explanations()]
    assert sum(shares) == pytest.approx(1.0)
    assert shares == sorted(shares, reverse=True)
    assert seen.confidence == shares[0]
    assert seen.ties == sum(share == pytest.approx(shares[0]) for share in shares)


def test_a_fork_goes_its_own_way():
    seen = reading("pick_and_place")
    other = seen.fork()
    other.observe("eat")
    assert [len(r.observations) for r in (seen, other)] == [1, 2]
    assert seen.rejected != other.rejected


def test_json_tells_as_many_explanations_as_are_asked_for():
    seen = reading("pick_and_place", verification=False)
    assert [len(seen.to_json(top)["best"]) for top in (0, 1, 2)] == [0, 1, 2]
    assert seen.to_json(0)["confidence"] == seen.confidence > 0
    assert seen.to_json(0)["frontier"]


def test_where_the_order_is_open_each_next_action_has_its_share(tmp_path):
    seen = domain(tmp_path, "goal(g). g --> a, unordered(b, c), d.").reading()
    seen.observe("a")
    assert seen.next_actions == {"b": 0.5, "c": 0.5}
    assert [str(action) for action in seen.frontier] == ["b", "c", "d"]
    asked = {(q.kind, q.about): q.yes for q in seen.questions()}
    assert asked["next", "b"] == 0.5 and asked["step", "d"] == 1.0 and asked["done", "a"] == 1.0


def test_questions_of_equal_worth_come_by_kind_and_name(tmp_path):
    seen = domain(tmp_path, "goal(g). goal(h). g --> a, b. h --> a, c.").reading()
    seen.observe("a")
    told = [(q.kind, q.about, q.yes, q.gain) for q in seen.questions()]
    half = [("goal", "g"), ("goal", "h"), ("step", "b"), ("step", "c"), ("next", "b"), ("next", "c")]
    assert told == [*((kind, about, 0.5, 1.0) for kind, about in half), ("done", "a", 1.0, 0.0)]


@pytest.mark.parametrize(("shares", "bits"), [([1], 0), ([1, 1], 1), ([2, 2, 2, 2], 2), ([], 0), ([0, 3], 0), ([1, 3], 0.811278)])
def test_entropy_is_counted_in_bits(shares, bits):
    assert entropy(shares) == pytest.approx(bits)


def test_a_question_is_json():
    asked = Question("done", "eat", 0.25, 0.5)
    assert asked.to_json() == {"question": "was eat done?", "kind": "done", "about": "eat", "yes": 0.25, "gain": 0.5}


def test_priors_are_one_where_none_is_stated():
    assert priors_of([], ["g", "h"]) == {"g": 1.0, "h": 1.0}
    assert priors_of([("g", 0.25), ("h", 0.75), ("g", 0.25)], ["g", "h"]) == {"g": 0.25, "h": 0.75}
    assert priors_of([("g", 1)], ["g"]) == {"g": 1.0}


@pytest.mark.parametrize(
    ("rows", "sentence"),
    [
        ([("x", 1)], "prior(x, 1): x is no goal; the goals are g, h"),
        ([("g", 0.5), ("g", 0.4)], "g has two priors, 0.5 and 0.4"),
        ([("g", 0)], "a prior is a number above 0"),
        ([("g", True)], "a prior is a number above 0"),
        ([("g", "much")], "a prior is a number above 0"),
        ([("g", 1.0)], "some goals have a prior, so all need one; it lacks for h"),
        ([("g", 0.5), ("h", 0.4)], "the priors sum to 0.9, not to 1"),
    ],
)
def test_priors_that_are_none_are_refused_with_their_place(rows, sentence):
    with pytest.raises(CasperError) as told:
        priors_of(rows, ["g", "h"], lambda row: Place("p.pl", rows.index(row) + 1))
    assert sentence in told.value.sentence
    assert told.value.place == Place("p.pl", len(rows))
