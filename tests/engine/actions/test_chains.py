"""The chains of actions as facts tell them, and what is refused of them."""

import random

import pytest
from low_level_kitchen import rows_of

from casper.engine.actions.fsm import likeliest_chain, movements_of, read_fsms, sampled_chain
from casper.kb.errors import DomainError

ROUND = [("use", "pick", "place", 0.75), ("use", "pick", "walk", 0.25), ("use", "place", "pick", 1), ("use", "walk", "pick", 1)]


def chains(transitions, **more):
    return read_fsms(rows_of({("transition", 4): transitions, **{(n, 1 if n == "loop" else 3): rows for n, rows in more.items()}}))


def test_a_transition_that_never_happens_is_none():
    (fsm,) = chains([("use", "pick", "place", 1), ("use", "pick", "walk", 0), ("use", "place", "pick", 1.0), ("use", "walk", "pick", 1)])
    assert fsm.rows == {"pick": {"place": 1.0}, "place": {"pick": 1.0}, "walk": {"pick": 1.0}}
    assert fsm.cycle == () and fsm.start is None and fsm.loop is False


def test_cycle_start_and_loop_are_the_actions_own():
    first, second = chains(
        [*ROUND, ("eat", "pick", "pick", 1)],
        cycle=[("use", 2, "place"), ("use", 1, "pick")],
        start=[("use", "walk", 0.4), ("use", "pick", 0.6)],
        loop=[("eat",)],
    )
    assert (first.action, first.cycle, first.start, first.loop) == ("use", ("pick", "place"), {"walk": 0.4, "pick": 0.6}, False)
    assert (second.action, second.cycle, second.start, second.loop) == ("eat", (), None, True)
    assert movements_of((first, second)) == ("pick", "place", "walk")


def test_the_likeliest_chain_goes_on_with_the_likeliest_movement():
    (fsm,) = chains(ROUND)
    assert likeliest_chain(fsm, "pick", 4) == ("pick", "place", "pick", "place")
    assert likeliest_chain(fsm, "sleep", 4) == ("sleep",)
    assert likeliest_chain(fsm, "pick", 1) == ("pick",)


def test_a_drawn_chain_draws_each_movement_as_often_as_its_probability_says():
    (fsm,) = chains(ROUND)
    chain = sampled_chain(fsm, "pick", 4001, random.Random(5))
    assert len(chain) == 4001
    assert 0.7 < chain.count("place") / 2000 < 0.8
    assert sampled_chain(fsm, "sleep", 3, random.Random(5)) == ("sleep",)


def test_rows_need_not_add_up_more_exactly_than_three_decimals_can():
    assert chains([("use", "pick", "pick", 0.985)])
    with pytest.raises(DomainError, match=r"transition\(use, pick, …\) adds up to 0.97, not 1"):
        chains([("use", "pick", "pick", 0.97)])
    with pytest.raises(DomainError, match=r"start\(use, …\) adds up to 0.5, not 1"):
        chains(ROUND, start=[("use", "pick", 0.5)])


@pytest.mark.parametrize("p", [-0.1, 1.1])
def test_a_probability_lies_between_zero_and_one(p):
    with pytest.raises(DomainError, match="a probability lies between 0 and 1"):
        chains([("use", "pick", "pick", p)])


@pytest.mark.parametrize(
    ("facts", "sentence"),
    [
        ({"cycle": [("use", 1, "sleep")]}, "is about no transition"),
        ({"cycle": [("cook", 1, "pick")]}, "is about no transition"),
        ({"cycle": [("use", 1, "pick"), ("use", 1, "walk")]}, r"cycle\(use, 1, …\) is there twice"),
        ({"start": [("use", "sleep", 1)]}, "is about no transition"),
    ],
)
def test_facts_about_movements_that_are_not_there_are_refused(facts, sentence):
    with pytest.raises(DomainError, match=sentence):
        chains(ROUND, **facts)


@pytest.mark.parametrize(
    ("transitions", "sentence"),
    [
        ([*ROUND, ("use", "pick", "walk", 0.25)], "is there twice"),
        ([("use", "pick", "gone", 1)], "leads to gone, which nothing leads from"),
    ],
)
def test_transitions_that_make_no_chain_are_refused(transitions, sentence):
    with pytest.raises(DomainError, match=sentence):
        chains(transitions)
