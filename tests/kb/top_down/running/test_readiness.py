"""What cannot be decided yet waits for what comes later: the order in which conditions are written decides nothing."""

from itertools import permutations

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.errors import ProgramError, Undefined
from casper.kb.text.reader import read_query, read_text
from casper.kb.top_down.search import Search

PROGRAM: dict = {}
for clause in read_text("n(1). n(2). n(3). q(2). q(3). r(1, 2). r(2, 3).", "<test>"):
    PROGRAM.setdefault(clause.head.indicator, []).append(clause)

# goals about X and Z, and the X of their answers where X is 1, 2 or 3
GOALS = {
    "q(X)": [2, 3], "\\+ q(X)": [1], "not(q(X))": [1], "X > 1": [2, 3], "X = 2": [2], "X =\\= 2": [1, 3], "true": [1, 2, 3],
    "fail": [], "(q(X), X > 2)": [3], "(q(X) ; X = 1)": [1, 2, 3], "Z is X + 1": [1, 2, 3], "length([X], Z)": [1, 2, 3],
    "between(2, 3, X)": [2, 3], "between(1, X, 2)": [2, 3], "call(q, X)": [2, 3],
    "call(\\+ q(X))": [1], "not(X > 1)": [1], "\\+ X > 1": [1], "maplist(q, [X])": [2, 3], "call(r, X, Z)": [1, 2],
    "call(=, X, 2)": [2], "call(>, X, 1)": [2, 3], "call(call, X > 1)": [2, 3], "call(\\=, X, 1)": [2, 3],
    "call(\\+, q(X))": [1], "X == 1": [1], "X \\== 1": [2, 3],
}  # fmt: skip


def values(query):
    """The different values of X, in order."""
    (body,) = read_query(query)
    x = next(v for literal in body for v in literal.variables() if v.name == "X")
    return sorted({solution[x] for solution in Search({}, PROGRAM).solve(body)})


@pytest.mark.parametrize("goal", GOALS)
@pytest.mark.parametrize(
    "query",
    [
        "n(X), G = {}, call(G)",
        "n(X), call(G), G = {}",
        "call(G), n(X), G = {}",
        "X > 0, call(G), n(X), G = {}",
        "X > 0, n(X), call(G), G = {}",
    ],
)
def test_a_goal_that_is_not_known_yet_waits(query, goal):
    assert values(query.format(f"({goal})")) == GOALS[goal]


@pytest.mark.parametrize("goal", [g for g in GOALS if "," not in g.partition("(")[0] and ";" not in g and g != "(q(X), X > 2)"])
@pytest.mark.parametrize("query", ["G = {}, X > 0, call(G), n(X)", "X > 0, G = {}, call(G), n(X)"])
def test_while_something_waits_a_goal_is_not_called_before_what_it_is_about_is_known(query, goal):
    assert values(query.format(f"({goal})")) == GOALS[goal]


@pytest.mark.parametrize("goal", ["7", "1.5", "X"])
@pytest.mark.parametrize("query", ["n(X), G = {}, call(G)", "call(G), n(X), G = {}", "G = {}, X > 0, call(G), n(X)"])
def test_a_number_as_a_goal_is_undefined_wherever_it_stands(query, goal):
    with pytest.raises(Undefined, match="call/1 needs a goal, not"):
        values(query.format(f"({goal})"))


@pytest.mark.parametrize("conditions", list(permutations(["not(q(X))", "n(X)", "X < 9"])))
def test_not_waits_as_its_sign_does(conditions):
    base = KnowledgeBase.from_text("n(1). n(2). n(3). q(2). q(3).")
    assert list(base.query(", ".join(conditions))) == [{"X": 1}]


CONDITIONS = {
    "\\+ q(X)": [1], "X > 1": [2, 3], "X =\\= Z, Z = 3": [1, 2], "Z is X * 2, Z > 3": [2, 3],
    "X \\= Z, Z = 1": [2, 3], "\\+ r(X, Z), Z = 2": [2, 3], "\\+ r(X, _)": [3], "call(q, X)": [2, 3],
    "\\+ X = 1": [2, 3], "true": [1, 2, 3], "atom_length(Z, X), Z = ab": [2], "\\+ \\+ q(X)": [2, 3],
}  # fmt: skip


@pytest.mark.parametrize("conditions", CONDITIONS)
def test_conditions_in_any_order_give_the_same(conditions):
    (body,) = read_query(f"n(X), {conditions}, X < 9")
    x = body[0].atom[1]
    for order in permutations(body):
        assert sorted({solution[x] for solution in Search({}, PROGRAM).solve(list(order))}) == CONDITIONS[conditions]


@pytest.mark.parametrize(
    ("query", "named"),
    [
        ("X > 1", "X > 1"),
        ("n(Y), \\+ r(Y, X)", "\\+ r(1, X)"),
        ("Y = X, Z is Y + 1", "Z is Y + 1"),
        ("\\+ X = f(Y)", "\\+ X = f(Y)"),
        ("n(Y), f(X, Y) > 2", "f(X, 1) > 2"),
    ],
)
def test_what_nothing_binds_is_named_as_its_author_wrote_it(query, named):
    with pytest.raises(ProgramError) as caught:
        values(query)
    assert f"{named}" in caught.value.sentence and "cannot be decided: bind its variables" in caught.value.sentence
