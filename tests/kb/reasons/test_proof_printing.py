"""Proofs in bounded size: what is shared once, what is left out counted, and nothing that recurses."""

import copy
import json
import pickle

import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper.kb.base import KnowledgeBase
from casper.kb.reasons.proof import Proof
from casper.kb.terms.clauses import Clause, Literal
from casper.kb.terms.terms import Compound

HEIGHT = 10_000


def atom(name):
    return Compound((name,))


def step(name, *premises, remark=""):
    body = tuple(premise.literal for premise in premises)
    return Proof(Literal(atom(name)), Clause(atom(name), body), premises, remark)


def tower(top="end"):
    """A proof as high as a tower: each step rests on the one below it and on a fact of its own."""
    proof = step("p0")
    for at in range(1, HEIGHT):
        proof = step(f"p{at}", proof, step(f"q{at}"))
    return step(top, proof)


@pytest.fixture(scope="module")
def high():
    return tower()


@st.composite
def proofs(draw):
    """Graphs of a few steps that use one another again and again."""
    steps = [step(name) for name in "ab"]
    for at in range(draw(st.integers(0, 7))):
        premises = draw(st.lists(st.sampled_from(steps), max_size=3))
        steps.append(step(f"s{draw(st.integers(0, 2))}" if premises else f"f{at}", *premises))
    return steps[-1]


def plainly_equal(left, right):
    """The same steps in the same places: what equality means, word for word."""
    same = (left.literal, left.clause, left.remark) == (right.literal, right.clause, right.remark)
    return same and len(left.premises) == len(right.premises) and all(map(plainly_equal, left.premises, right.premises))


def spelled_out(proof):
    """The plain JSON of a proof, with every shared part written out again."""
    return [proof.fact[0], [spelled_out(premise) for premise in proof.premises]]


def put_back(shown, parts):
    """The same from what `to_json` shows: a reference stands for what has its number."""
    if "as" in shown:
        return parts[shown["as"]]
    whole = [shown["fact"], [put_back(part, parts) for part in shown["because"]]]
    if "id" in shown:
        parts[shown["id"]] = whole
    return whole


def test_a_tower_prints_in_bounded_size_and_says_what_is_left_out(high):
    lines = str(high).split("\n")
    assert len(lines) == 1_001
    assert max(map(len, lines)) < 120
    assert lines[-1] == "… 19,000 more steps"


def test_a_tower_prints_whole_where_that_is_asked_for(high):
    lines = high.text(most_steps=3 * HEIGHT).split("\n")
    assert len(lines) == 2 * HEIGHT
    assert "more step" not in lines[-1]


def test_a_tower_is_json_that_pythons_writer_can_write(high):
    shown = high.to_json()
    text = json.dumps(shown)
    assert len(text) < 200_000 and '"cut": true' in text
    assert shown["more"] == 2 * HEIGHT - text.count('"fact": ')


def test_a_tower_is_a_graph_of_the_steps_nearest_to_what_is_proved(high):
    graph = high.to_networkx(most_steps=5)
    assert [graph.nodes[at]["text"] for at in range(5)] == ["end", "p9999", "p9998", "q9999", "p9997"]
    assert graph.graph["more"] == 2 * HEIGHT - 5
    assert len(high.to_networkx(most_steps=10**6)) == 2 * HEIGHT


def test_towers_are_compared_hashed_pickled_and_copied(high):
    assert high == tower() and hash(high) == hash(tower())
    assert high != tower("other")
    assert pickle.loads(pickle.dumps(high)) == high
    assert copy.deepcopy(high) == high
    assert repr(high) == "<proof of end: 10000 high, 20000 steps>"


def test_what_is_used_twice_is_printed_once_and_referred_to():
    shared = step("s", step("fact"))
    assert str(step("top", shared, step("t", shared))).split("\n") == [
        "top",
        "├─ s   [1]",
        "│  └─ fact   [given]",
        "└─ t",
        "   └─ s   as above, [1]",
    ]


def test_a_proof_that_doubles_at_every_step_stays_small_everywhere():
    proof = step("p0", step("fact"))
    for at in range(1, 60):
        proof = step(f"p{at}", proof, proof)
    assert len(str(proof).split("\n")) == 61 + 59
    assert len(json.dumps(proof.to_json())) < 20_000
    assert len(proof.to_networkx()) == proof.size == 61
    assert len(pickle.dumps(proof)) < 20_000


def test_what_lies_too_deep_is_cut_and_counted():
    proof = step("a", step("b", step("c", step("d"))), step("e"))
    assert proof.text(deepest=1) == "a\n├─ b   […]\n└─ e   [given]\n… 2 more steps"
    assert proof.to_json(deepest=1)["more"] == 2


def test_what_was_cut_deep_down_is_spelled_out_further_up():
    shared = step("s", step("fact"))
    proof = step("top", step("t", shared), shared)
    assert proof.text(deepest=2).split("\n") == [
        "top",
        "├─ t",
        "│  └─ s   […]",
        "└─ s   [1]",
        "   └─ fact   [given]",
    ]


@given(proofs())
def test_json_with_its_references_put_back_is_the_proof(proof):
    shown = proof.to_json()
    assert "more" not in shown
    assert put_back(shown, {}) == spelled_out(proof)


@given(proofs(), st.integers(1, 12), st.integers(0, 4))
def test_every_step_is_shown_or_counted(proof, most, deepest):
    *lines, last = proof.text(most, deepest).split("\n")
    closed = last.startswith("… ")
    shown = {line.split("─ ")[-1].split("   ")[0] for line in (lines if closed else [*lines, last])}
    assert len(shown) <= most
    left_out = int(last.split()[1]) if closed else 0
    assert left_out <= proof.size - 1
    assert closed or {p.fact[0] for p in proof.premises_first()} == shown


@given(proofs(), proofs())
def test_proofs_are_equal_when_they_say_the_same_step_by_step(left, right):
    assert (left == right) == plainly_equal(left, right)
    assert left == pickle.loads(pickle.dumps(left))
    if left == right:
        assert hash(left) == hash(right)


def test_a_proof_is_no_other_thing():
    assert step("a") != "a"


def test_a_base_proves_as_high_as_that():
    base = KnowledgeBase()
    base.rule("up(X) :- start(X)")
    base.rule("up(Y) :- e(X, Y), up(X)")
    base.fact("start(0)")
    base.facts("e", [(at, at + 1) for at in range(3_000)])
    proof = base.why(("up", 3_000))
    assert proof is not None and proof.height == 3_001
    assert str(proof).endswith("… 5,002 more steps")
