"""A recursive minimum that a question names the beginning of is worked out from there, and is what listing it gives."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from casper.kb.base import KnowledgeBase
from casper.kb.errors import BudgetExceeded, Undefined
from casper.kb.store import on_demand

RULES = "path(X, Y, D) :- edge(X, Y, D). path(X, Y, D) :- path(X, Z, E), edge(Z, Y, W), D is E + W."
FROM = f":- table path(_, _, min). {RULES}"
MORE = "near(X, Y) :- path(X, Y, D), D < 4. away(X, Y) :- node(X), node(Y), \\+ path(X, Y, _). many(X, N) :- node(X), aggregate_all(count, path(X, _, _), N)."


def base_of(edges, text=FROM, up_to=-1):
    """A base that lists nothing before it is asked, or everything."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(on_demand, "LISTED_UP_TO", up_to)
        base = KnowledgeBase.from_text(f":- dynamic(edge/3). :- dynamic(path/3). node(1). node(2). node(3). {text}")
        base.facts("edge", edges)
        base.compile()
    return base


def rows(base, goal):
    return sorted(tuple(map(str, answer.values())) for answer in base.query(goal))


RING = [(at, (at + 1) % 200, 1) for at in range(200)]


def test_a_question_that_names_the_node_lists_no_other():
    base = base_of(RING)
    assert len(rows(base, "path(0, Y, D)")) == 200
    assert rows(base, "path(0, 7, D)") == [("7",)]
    assert base.ask("path(7, 9, 2)") and not base.ask("path(7, 9, 3)") and not base.ask("path(7, 900, 3)")
    assert base._model.listed is None and len(base._model.best) == 2


def test_a_question_that_names_none_lists_all():
    base = base_of(RING)
    assert len(rows(base, "path(X, 3, D)")) == 200
    assert base._model.listed is not None


def test_what_changes_shows_at_once():
    base = base_of(RING)
    assert rows(base, "path(0, 7, D)") == [("7",)]
    base.assert_("edge(0, 7, 2)")
    base.assert_("path(0, 9, 3)")
    assert rows(base, "path(0, 7, D)") == [("2",)] and rows(base, "path(0, 10, D)") == [("4",)]
    assert not base.ask("path(0, 9, 4)") and base.ask("path(0, 9, 3)")
    base.retract("edge(0, 7, 2)")
    assert rows(base, "path(0, 7, D)") == [("7",)] and base.assume("edge(0, 7, 1)").ask("path(0, 7, 1)")
    assert base._model.listed is None


def test_the_plan_of_such_a_question_says_so_and_a_reason_is_given():
    base = base_of(RING[:5])
    assert "best rows of path/3" in str(base.plan("path(0, Y, D)"))
    assert base.why("path(0, 2, 2)") is not None


def test_a_given_row_that_is_not_the_best_is_no_answer():
    base = base_of([(0, 1, 5)], f"{FROM} path(0, 1, 9).")
    assert not base.ask("path(0, 1, 9)") and base.ask("path(0, 1, 5)")


def test_what_has_no_value_is_undefined_where_it_can_be_reached():
    base = base_of([(0, 1, 5), (1, 2, "far"), (3, 4, 1)])
    assert base.truth("path(0, 2, 5)") == "undefined" and base.truth("path(0, 1, 5)") == "true"
    assert base.truth("path(0, 4, 5)") == "false" and base.truth("path(3, 4, 1)") == "true"
    with pytest.raises(Undefined, match=r"path\(0, 2, "):
        rows(base, "path(0, Y, D)")


def test_what_improves_without_end_is_unknown_from_there_alone():
    base = base_of([(0, 1, -1), (1, 0, -1), (3, 4, 1)])
    assert rows(base, "path(3, Y, D)") == [("4", "1")]
    with pytest.raises(BudgetExceeded):
        rows(base, "path(0, Y, D)")


nodes = st.integers(1, 4)
edges = st.lists(st.tuples(nodes, nodes, st.sampled_from([1, 2, 3, 0.5, "x"])), max_size=8)
GOALS = [
    "path(1, Y, D)",
    "path(X, 2, D)",
    "path(1, 2, D)",
    "path(X, X, D)",
    "near(1, Y)",
    "away(1, Y)",
    "many(2, N)",
    "path(1, Y, D), path(2, Y, E)",
]
TURNED = RULES.replace("path(X, Z, E), edge(Z, Y, W)", "edge(X, Z, W), path(Z, Y, E)")
GREATEST = FROM.replace("min", "max").replace("E + W", "min(E, W)")


@settings(max_examples=40)
@given(edges, st.sampled_from([FROM, f":- table path(_, _, min). {TURNED}", GREATEST]), st.sampled_from(GOALS))
def test_what_is_asked_for_is_what_listing_gives(edges, text, goal):
    def told(base):
        found = []
        try:
            found.extend(sorted(str(a) for a in base.query(goal)))
        except Undefined:
            found.append("something is undefined")
        return found

    assert told(base_of(edges, f"{text} {MORE}")) == told(base_of(edges, f"{text} {MORE}", up_to=10_000))
