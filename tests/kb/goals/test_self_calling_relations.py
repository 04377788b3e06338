"""Relations that call themselves, and goals from iterators: none recurses to death, none is asked for more than is wanted."""

from __future__ import annotations

from collections import Counter
from itertools import count, islice

from equations import X, Y, Z

from casper.kb.goals import minikanren as mk
from casper.kb.goals.minikanren import Zzz, appendo, conde, defrel, eq, lall, lany, membero, run, var

LONG = 1_500


@defrel
def append(front, back, whole):
    """As every textbook writes it."""
    head, tail, rest = var(), var(), var()
    return conde(
        [eq(front, ()), eq(back, whole)],
        [eq(front, (head, tail)), eq(whole, (head, rest)), append(tail, back, rest)],
    )


def nested(length):
    found = ()
    for at in reversed(range(length)):
        found = (at, found)
    return found


def test_a_thousand_ways_to_append():
    assert len(run(1000, Y, append(X, Y, Z))) == 1000
    assert len(run(1000, Y, appendo(X, Y, Z))) == 1000
    assert run(100, X, append(X, Y, Z))[-1][1][1][0] is not None


def test_long_lists_are_appended_and_taken_apart():
    found = run(1, X, append(nested(500), (), X))
    depth, rest = 0, found[0]
    while rest:
        depth, rest = depth + 1, rest[1]
    assert depth == 500
    whole = list(range(400))
    assert run(1, X, appendo(whole[:350], X, whole)) == (whole[350:],)
    assert run(0, X, membero(X, whole)) == tuple(whole)


def edges(length):
    edge = mk.Relation("edge")
    mk.facts(edge, *[(at, at + 1) for at in range(length)])
    return edge


def test_a_relation_that_calls_itself_needs_no_delay():
    edge = edges(LONG)

    @defrel
    def path(a, b):
        between = var()
        return conde([edge(a, b)], [edge(a, between), path(between, b)])

    assert set(run(0, X, path(0, X))) == set(range(1, LONG + 1))


def test_a_relation_that_calls_itself_first_still_answers():
    edge = edges(5)

    @defrel
    def path(a, b):
        between = var()
        return conde([path(a, between), edge(between, b)], [edge(a, b)])

    assert set(run(5, X, path(0, X))) == {1, 2, 3, 4, 5}


def test_a_goal_that_takes_the_state_and_returns_a_stream_may_call_itself():
    edge = edges(LONG)

    def path(a, b):
        def goal(state):
            between = var()
            return conde([edge(a, b)], [edge(a, between), path(between, b)])(state)

        return goal

    assert len(run(0, X, path(0, X))) == LONG


def test_a_generator_that_hands_on_a_stream_may_call_itself():
    edge = edges(LONG)

    def path(a, b):
        def goal(state):
            between = var()
            yield from conde([edge(a, b)], [edge(a, between), path(between, b)])(state)

        return goal

    assert len(run(0, X, path(0, X))) == LONG


def test_a_generator_that_looks_at_what_it_hands_on_is_heeded():
    def first(goal_):
        def goal(state):
            yield from islice(goal_(state), 1)

        return goal

    def last_word(goal_):
        def goal(state):
            yield from goal_(state)
            yield {**state, X: "end"}

        return goal

    choice = lany(eq(X, 1), eq(X, 2))
    assert run(0, X, first(choice)) == (1,)
    assert Counter(run(0, X, last_word(choice))) == Counter([1, 2, "end"])


def test_clauses_may_come_from_an_iterator_without_end():
    assert run(3, X, conde([eq(X, n)] for n in count())) == (0, 1, 2)
    assert run(3, X, lany(eq(X, n) for n in count())) == (0, 1, 2)
    assert "other" in run(9, X, lany(lany(eq(X, n) for n in count()), eq(X, "other")))


def test_goals_of_an_iterator_hold_again_and_again():
    goal = lall(eq(X, n) for n in (1, 1))
    assert run(0, X, goal) == run(0, X, goal) == (1,)
    either = lany(eq(X, n) for n in (1, 2))
    assert run(0, X, either) == run(0, X, either) == (1, 2)


def test_zzz_is_known():
    def ones(x):
        return lany(eq(x, 1), Zzz(ones, x=x))

    assert run(3, X, ones(X)) == (1, 1, 1)


def test_a_filter_sees_the_answers():
    assert run(0, X, membero(X, [1, 2, 1]), results_filter=lambda found: iter(dict.fromkeys(found))) == (1, 2)
