"""Episodes of relations: runs with their times, states in between, and how intervals lie to each other."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from traces import traces

from casper import qsr
from casper.kb.errors import TraceError
from casper.qsr.plain.between import between


def walked(xs, missing=(), t=None):
    """One who goes along a line towards and past a cup at 10 m."""
    there = [[at not in missing, True] for at in range(len(xs))]
    places = [[(x, 0.0), (10.0, 0.0)] for x in xs]
    return qsr.Trace.of(range(len(xs)) if t is None else t, ("ann", "cup"), places, present=there)


def column(name, *args, **kwargs):
    return qsr.relations(walked(*args, **kwargs), name, observer="ann")[name]


def told(episodes):
    return [(e.relation[0], e.begins, e.ends) for e in episodes]


def test_equal_labels_in_a_row_are_an_episode_with_its_times():
    episodes = qsr.collapse(column("qdc", (0, 1, 7.5, 8, 8.5), t=(0, 0.5, 2, 3, 9)))
    assert told(episodes) == [("ignore", 0.0, 0.5), ("medium", 2.0, 2.0), ("near", 3.0, 9.0)]
    assert [e.steps for e in episodes] == [2, 1, 2]


def test_missing_steps_end_an_episode_and_another_begins_after_them():
    assert told(qsr.collapse(column("qdc", (9, 9, 9, 9), missing=(1,)))) == [("near", 0.0, 0.0), ("near", 2.0, 3.0)]


def test_several_calculi_are_collapsed_together_where_none_changes():
    found = qsr.relations(walked((7.0, 7.5, 7.8, 8.5, 9.25)), "qdc", "qtc_b11", observer="ann")
    episodes = qsr.collapse(found["qdc"], found["qtc_b11"])
    assert [e.relation for e in episodes] == [("medium", "-"), ("near", "-")]


@settings(max_examples=20)
@given(traces(least=2))
def test_episodes_say_what_the_labels_say(trace):
    found = qsr.relations(trace, "qdc")["qdc"]
    again = np.full(found.codes.shape, None)
    for episode in qsr.collapse(found):
        again[found.of.index(episode.of), episode.first : episode.last + 1] = episode.relation[0]
        assert (episode.begins, episode.ends) == (trace.t[episode.first], trace.t[episode.last])
    assert again.tolist() == found.labelled().tolist()


def test_between_coming_and_going_there_is_a_moment_of_neither():
    episodes = qsr.validate(qsr.collapse(column("qtc_b11", (0, 1, 2, 1, 0))))
    assert told(episodes) == [("-", 1.0, 2.0), ("0", 2.5, 2.5), ("+", 3.0, 4.0)]
    assert [(e.inserted, e.steps) for e in episodes] == [(False, 2), (True, 0), (False, 2)]


def test_nothing_is_put_in_between_where_steps_are_missing():
    assert [e.inserted for e in qsr.validate(qsr.collapse(column("qtc_b11", (0, 1, 1, 0, -1), missing=(2,))))] == [
        False,
        False,
    ]


@pytest.mark.parametrize(
    ("earlier", "later", "state"),
    [
        ("-", "+", "0"),
        ("-", "0", None),
        ("-0", "0-", "00"),
        ("--", "00", None),
        ("00", "+-", None),
        ("-+", "++", "0+"),
        ("-0", "+-", "00"),
    ],
)
def test_a_state_lies_between_two_that_cannot_follow_each_other(earlier, later, state):
    assert between(earlier, later) == state


@settings(max_examples=20)
@given(traces(least=3))
def test_after_validation_neighbours_follow_neighbours(trace):
    near = qsr.algebra("qtc_c")
    episodes = qsr.validate(qsr.collapse(qsr.relations(trace, qsr.QtcC(qsr.Distance(0.2)))["qtc_c"]))
    for one, other in itertools.pairwise(episodes):
        if one.of == other.of and one.last + 1 == other.first:
            assert other.relation[0] in near.neighbours(one.relation[0]) and one.ends <= other.begins


def test_intervals_of_time_are_related_by_allen():
    assert qsr.allen(([0, 0, 3], [1, 2, 4]), ([2], [5])).tolist() == [["before"], ["meets"], ["during"]]
    assert qsr.allen(([0], [1.9]), ([2], [5]), tolerance=0.2).tolist() == [["meets"]]
    near, mid = (qsr.collapse(column("qdc", xs)) for xs in ((9, 9, 9, 0, 0), (0, 9, 9, 9, 0)))
    assert qsr.allen(near[:1], mid[1:2]).tolist() == [["overlaps"]]


@pytest.mark.parametrize(
    ("one", "sentence"),
    [
        (([0, 2], [1, 2]), "an interval ends after it starts, and number 1 goes from 2 to 2"),
        (([0], [float("inf")]), "number 0 goes from 0 to inf"),
        (([0, 1], [1]), "there are 2 starts and 1 ends"),
        (([0],), "intervals are two arrays, starts and ends, or episodes"),
    ],
)
def test_intervals_that_are_none_are_refused_in_a_sentence(one, sentence):
    with pytest.raises(TraceError, match=sentence):
        qsr.allen(one, ([0], [1]))


def test_columns_of_other_tuples_are_not_collapsed_together():
    found = qsr.relations(walked((0, 1)), "mos", "qdc", observer="ann")
    with pytest.raises(TraceError, match="only columns of the same tuples"):
        qsr.collapse(found["mos"], found["qdc"])
    with pytest.raises(TraceError, match="nothing to collapse"):
        qsr.collapse()
