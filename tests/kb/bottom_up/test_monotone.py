"""Which rules of a recursive minimum make better rows of better premises, whatever the order: the others are refused."""

from __future__ import annotations

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.bottom_up.circles.monotone import check_monotone
from casper.kb.errors import NotOnColumns

STATED = "far(X, W) :- edge(X, X, W). near(X, W) :- edge(X, X, W)."
MODES = {"min": ":- table([far(_, min), near(_, max)]).", "max": ":- table([far(_, max), near(_, min)])."}
RISING = [
    *("D is C + W", "D is W + C", "D is C - W", "D is min(C, W)", "D is max(W, C)", "D is max(C + W, min(3, C)) - 1"),
    *("D is E - W, E is C + W", "E is C + W, D is E - W", "D is C, E is W * W", "D is C + W, W =\\= 1, X \\= Y"),
    *("D is C + W, \\+ shut(Y)", "D is C + W, shut(Y)", "D is C + (W * W - abs(W))"),
]
FALLING = [
    *("D is W - C", "D is C * W", "D is -C", "D is abs(C)", "D is C + W * C", "D is max(W, 3 - C)"),
    *("D is C - (W + C)", "D is C, E is W - D"),
]
OTHERWISE_USED = [
    *("C = D", "C =:= 2, D = 1", "C =\\= 2, D is C + W", "C == 2, D is C", "D is C + W, edge(X, _, C)"),
    *("D is C, \\+ shut(C)", "D is C + W, D is C - W", "D is C, C is 3", "3 is C + W, D = W", "D is C + W, \\+ C < 4"),
    *("D is C + W, \\+ D is C", "D is C + W, C < D", "D is C + W, D > C"),
    "D is C + W, aggregate_all(count, edge(C, _, _), _)",
]
KEPT_BY_LESS = ["C < 4", "C =< W", "4 > C", "W >= C", "D =< 6", "C - W < 4"]
KEPT_BY_MORE = ["C > 4", "C >= W", "4 < C", "W =< C", "D >= 6", "min(C, 8) > 4"]


def check(body, mode="min", head="far(Y, D)", condition="far(X, C)"):
    """Check the rule of ``far`` with the body, whose first condition is the recursive one."""
    base = KnowledgeBase.from_text(f":- dynamic([edge/3, shut/1]). {MODES[mode]} {STATED}")
    base.rule(f"{head} :- {condition}, edge(X, Y, W), {body}." if body else f"{head} :- {condition}, edge(X, Y, W).")
    program = base._model.program
    rule = program.rules["far", 2][-1]
    needed = rule.body[0].atom.indicator
    check_monotone(rule, 0, (program.least[needed], program.least["far", 2]))


def refused(*rule, **more):
    with pytest.raises(NotOnColumns, match="better premises need not make better rows in far"):
        check(*rule, **more)
    return True


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("body", RISING)
def test_sums_differences_and_bounds_of_a_better_value_are_better(body, mode):
    check(body, mode)


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("body", FALLING)
def test_what_falls_where_the_value_rises_is_refused(body, mode):
    assert refused(body, mode)


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("body", OTHERWISE_USED)
def test_a_value_that_is_looked_at_in_any_other_way_is_refused(body, mode):
    assert refused(body, mode)


@pytest.mark.parametrize(("kept", "mode"), [(KEPT_BY_LESS, "min"), (KEPT_BY_MORE, "max")], ids=["less", "more"])
def test_a_better_value_keeps_a_bound_on_its_own_side_only(kept, mode):
    for bound in kept:
        check(f"D is C + W, {bound}", mode)
        assert refused(f"D is C + W, {bound}", "max" if mode == "min" else "min")


def test_the_value_may_be_the_head_s_as_it_is():
    check("", head="far(Y, C)")


@pytest.mark.parametrize(
    ("head", "condition"), [("far(C, D)", "far(X, C)"), ("far(D, D)", "far(X, C)"), ("far(Y, D)", "far(C, C)")]
)
def test_a_value_that_is_a_key_too_is_refused(head, condition):
    assert refused("D is C + W", head=head, condition=condition)


def test_a_condition_on_one_value_alone_is_refused():
    assert refused("D is W + 2", condition="far(X, 2)")


def test_the_best_of_what_is_kept_the_other_way_round_is_refused():
    assert refused("D is C + W", condition="near(X, C)")
