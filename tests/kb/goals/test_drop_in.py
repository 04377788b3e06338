"""kanren's names, with kanren's answers: what hangs or recurses to death there does neither here."""

from __future__ import annotations

from collections import Counter

import kanren
from equations import X, Y, Z, terms, theirs
from hypothesis import given
from hypothesis import strategies as st
from unification import isvar
from unification.core import _unify, stream_eval

from casper.kb.goals import minikanren as mk
from casper.kb.goals.minikanren import (
    conso,
    heado,
    itero,
    nullo,
    permuteo,
    rembero,
    run,
    tailo,
)
from casper.kb.goals.occurs import _Circular, _Guard

items = st.lists(st.sampled_from("abc"), max_size=4)
sequences = st.one_of(items, items.map(tuple))


def hashable(answer):
    return tuple(map(hashable, answer)) if isinstance(answer, (list, tuple)) else "_" if isvar(answer) else answer


def agree(answers, name, *args):
    """Ours and kanren's own goal of that name, asked for the same, with types and numbers of answers."""
    found = run(0, answers, getattr(mk, name)(*args))
    wanted = kanren.run(0, answers, getattr(kanren, name)(*args))
    assert Counter(map(hashable, found)) == Counter(map(hashable, wanted))
    assert Counter(type(x) for x in found) == Counter(type(x) for x in wanted)


@given(sequences, sequences, st.sampled_from("abc"))
def test_goals_about_ground_sequences_answer_as_kanrens(left, right, item):
    whole = type(left)([*left, *right]) if type(left) is type(right) else left
    agree(X, "membero", X, left)
    agree(X, "membero", item, left)
    agree(X, "appendo", left, right, X)
    agree(X, "appendo", left, X, whole)
    agree((X, Y), "appendo", X, Y, whole)
    agree(X, "appendo", left, right, whole)
    agree(X, "rembero", item, left, X)
    agree(X, "itero", left)
    agree(X, "nullo", left, X)
    agree(X, "permuteo", left, X)
    agree(X, "permuteo", left, right)
    agree(X, "permuteo", left, type(left)(reversed(left)))
    agree(X, "heado", X, left)
    agree(X, "tailo", X, left)
    agree(X, "conso", item, left, X)


goals = st.recursive(
    st.tuples(st.just("eq"), terms, terms),
    lambda inner: st.tuples(st.sampled_from(["lall", "conde"]), st.lists(inner, min_size=1, max_size=3)),
    max_leaves=5,
)


def built(goal, names):
    if goal[0] == "eq":
        return names.eq(theirs(goal[1]), theirs(goal[2]))
    parts = [built(part, names) for part in goal[1]]
    return names.lall(*parts) if goal[0] == "lall" else names.conde(*[[part] for part in parts])


def ends(goal):
    """Whether kanren comes to an end: no equation, in any choice, leads to an endless term."""
    if goal[0] == "eq":
        return [[goal[1:]]]
    parts = [ends(part) for part in goal[1]]
    if goal[0] == "conde":
        return [choice for part in parts for choice in part]
    choices = [[]]
    for part in parts:
        choices = [[*before, *choice] for before in choices for choice in part]
    return choices


def circular(pairs):
    """Whether the equations, taken in order, come to a variable that would be bound to a term that contains it."""
    state = {}
    for left, right in pairs:
        try:
            state = stream_eval(_unify(theirs(left), theirs(right), state), _Guard(state))
        except _Circular:
            return True
        if state is False:
            return False
    return False


@given(goals)
def test_goals_of_any_shape_answer_as_kanrens_where_those_end(goal):
    if not any(circular(choice) for choice in ends(goal)):
        found = run(0, (X, Y, Z), built(goal, mk))
        assert Counter(map(hashable, found)) == Counter(map(hashable, kanren.run(0, (X, Y, Z), built(goal, kanren))))


def test_every_name_of_kanrens_is_here():
    wanted = {name for name in vars(kanren) if not name.startswith("_")} - {"core", "facts", "goals", "term", "version"}
    wanted -= {"constraints", "util", "cons", "arguments", "operator", "unifiable_with_term", "graph", "assoccomm"}
    assert wanted <= set(dir(mk)), wanted - set(dir(mk))
    assert {heado, tailo, conso, nullo, itero, rembero, permuteo} <= {getattr(mk, name) for name in mk.__all__}
