"""After whatever changes every row has a proof, of the least height there is."""

from __future__ import annotations

from changing import apply, atoms, changes
from hypothesis import given
from programs import programs

from casper.kb.base import KnowledgeBase
from casper.kb.store import model
from casper.kb.terms.unification import substitute
from casper.kb.top_down.solve import Solver


@given(programs(circles=True), changes())
def test_every_row_has_a_proof_after_changes(text, sequence):
    base = KnowledgeBase.from_text(text)
    for change in sequence:
        apply(base, change)
    for fact in atoms(base):
        assert base.why(fact) is not None


@given(programs(circles=True), changes())
def test_every_row_of_a_large_base_has_a_proof_after_changes(text, sequence):
    before, model.MOST_EXACT = model.MOST_EXACT, 0  # rounds are then what the changes left
    try:
        base = KnowledgeBase.from_text(text)
        for change in sequence:
            apply(base, change)
        for fact in atoms(base):
            assert base.why(fact).height >= 0
    finally:
        model.MOST_EXACT = before


def least_heights(base: KnowledgeBase) -> dict:
    """By brute force: every instance of every clause, again and again."""
    relations = base._model.relations
    steps = []
    for clause in base.clauses:
        for solution in Solver(relations, {}).solve(clause.body):
            premises = [substitute(x.atom, solution) for x in clause.body if not (x.negated or x.is_comparison)]
            steps.append((substitute(clause.head, solution), premises, 1 if clause.body else 0))
    heights: dict = {}
    while True:
        before = dict(heights)
        for head, premises, cost in steps:
            if all(p in heights for p in premises):
                height = cost + max((heights[p] for p in premises), default=0)
                heights[head] = min(height, heights.get(head, height))
        if heights == before:
            return heights


@given(programs(circles=True), changes())
def test_a_proof_has_the_least_height_there_is_also_after_changes(text, sequence):
    base = KnowledgeBase.from_text(text)
    for change in sequence:
        apply(base, change)
    heights = least_heights(base)
    for fact in atoms(base):
        assert base.why(fact).height == heights[fact]


def test_a_proof_is_a_graph_and_json_however_deep_it_is():
    rules = " ".join(f"p{i} :- p{i - 1}, p{i - 1}." for i in range(1, 1500))
    proof = KnowledgeBase.from_text(f"p0. {rules}").why("p1499")
    graph = proof.to_networkx()
    assert (len(graph), graph.nodes[0]["text"], graph.nodes[0]["by"]) == (1500, "p1499", "rule")
    assert proof.to_json()["because"][1]["fact"] == "p1498"
