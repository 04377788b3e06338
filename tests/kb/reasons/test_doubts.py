"""Why something is undefined: the way to what has no value, or round a circle of negations; told and in JSON."""

from __future__ import annotations

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.reasons import doubt

WITHOUT_VALUE = "w(0). p(X) :- w(Y), X is 6 / Y. q :- \\+ p(1)."
LINE = "n0 :- \\+ n12.\n" + "\n".join(f"n{at + 1} :- n{at}." for at in range(12))


def why(text, statement):
    return KnowledgeBase.from_text(text).why(statement)


def test_a_circle_beside_the_first_ways_is_found_all_the_same():
    found = why("s :- a.\ns :- b.\na :- b.\nb :- \\+ a.", "s")
    assert str(found).splitlines() == [
        "s   [undefined]   [<text>:2]",
        "└─ b   [undefined]   [<text>:4]",
        "   └─ \\+ a   [undefined]   [<text>:3]",
        "      └─ b   [undefined: back to b]",
    ]


def test_the_way_to_it_is_part_of_the_reason_and_the_circle_goes_home_the_whole_way():
    found = why("s :- a.\ns :- b.\na :- c.\nc :- d.\nd :- b.\nb :- \\+ a.\nd :- e.\ne :- \\+ d, b.", "s")
    facts = [str(step.fact.functor) for step in found.steps]
    assert found.back is not None and any(step.literal.negated for step in found.steps[found.back :])
    assert [step.needs.functor for step in found.steps] == [*facts[1:], facts[found.back]]


def test_what_has_no_value_ends_the_way_with_its_reason():
    found = why(WITHOUT_VALUE, "q")
    assert str(found).splitlines() == [
        "q   [undefined]   [<text>:1]",
        "└─ \\+ p(1)   [undefined]   [<text>:1]",
        "   └─ 1 is 6 / 0   [6 / 0 has no value: division by zero]",
    ]
    assert found.back is None and [step.fact.functor for step in found.premises_first()] == ["p", "q"]


def test_in_json_each_step_says_what_it_needs_and_where_it_failed():
    failure = "6 / 0 has no value: division by zero"
    steps = [
        {"fact": "q", "place": "<text>:1", "body": ["\\+ p(1)"], "needs": "\\+ p(1)", "failure": None},
        {"fact": "p(1)", "place": "<text>:1", "body": ["w(0)", "1 is 6 / 0"], "needs": "1 is 6 / 0", "failure": failure},
    ]
    reason = f"q is undefined: it needs \\+ p(1), which needs 1 is 6 / 0, and {failure} (in p(1) :- w(0), 1 is 6 / 0 at <text>:1)"
    shown = why(WITHOUT_VALUE, "q").to_json()
    assert shown == {"fact": "q", "by": "undefined", "reason": reason, "steps": steps, "back": None}
    assert why("a :- b. b :- \\+ a.", "a").to_json()["back"] == 0


def test_a_goal_inside_a_clause_stands_for_itself():
    found = why("r(X) :- e(X), \\+ (f(X), \\+ r(X)). e(1). f(1).", "r(1)")
    assert [step["fact"] for step in found.to_json()["steps"]] == ["r(1)", "f(1), \\+ r(1)"]


def test_a_long_way_is_told_by_its_ends():
    sentence = why(LINE, "n12").sentence
    assert "needs n8, which needs … 5 more …, which needs n2," in sentence and sentence.endswith("that is a circle")
    assert len(str(why(LINE, "n12")).splitlines()) == 14  # and shown in full
    shorter = why(LINE.replace("n12", "n8"), "n8").sentence  # n9 to n12 follow from it
    assert "more" not in shorter and shorter.count("which needs") == 8


@pytest.mark.parametrize(("limit", "most"), [("MOST_ATOMS", 5), ("MOST_WAYS", 0)])
def test_where_the_reason_is_too_far_to_look_for_it_is_still_undefined(monkeypatch, limit, most):
    monkeypatch.setattr(doubt, limit, most)
    found = why(LINE, "n12")
    assert (found.steps, found.sentence) == ((), "n12 is undefined")


def test_the_farthest_atom_that_is_looked_at_can_give_the_reason(monkeypatch):
    monkeypatch.setattr(doubt, "MOST_ATOMS", 13)
    assert why(LINE, "n12").back == 0
    monkeypatch.setattr(doubt, "MOST_ATOMS", 12)
    assert why(LINE, "n12").back is None


def test_one_instance_of_a_rule_is_enough_where_it_is_undefined(monkeypatch):
    monkeypatch.setattr(doubt, "MOST_WAYS", 1)
    assert why(WITHOUT_VALUE, "p(1)").steps[-1].failure
