"""The plans, and the example of the score, as drawn trees."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from casper.engine.domain.domain import Domain
from casper.engine.explanation.explanation import Explanation
from casper.experiments.experiment import Asked, Data, Experiment, Ran, Row, table
from casper.experiments.figures.trees import trees_figure
from casper.experiments.printed import SCORE
from casper.plans.trees.tree import plan_tree

EXAMPLE = "g1 --> a, b, c. g2 --> b, a, c."
"""Two plans of three actions, of which a is the first of one and the second of the other. The paper's own trees are not
known; among small plans these come nearest to its numbers."""


def _tree(tree: Any) -> dict[str, Any]:
    """A marked tree as data (`casper.plans.trees.tree`)."""
    nodes = [{"node": number, **data} for number, data in tree.nodes(data=True)]
    return {"nodes": nodes, "edges": [list(edge) for edge in tree.edges]}


def work_plans(asked: Asked, ran: Ran) -> Data:
    """Every plan of the library, unmarked."""
    plans = list(asked.domain.library.ways)
    trees = [{"title": plan.label, **_tree(plan_tree(plan))} for plan in plans]
    rows = [_node_row(tree["title"], node) for tree in trees for node in tree["nodes"]]
    summary: list[Row] = [
        {"goal": plan.label, "actions": len(plan.leaves), "plan": ", ".join(leaf.functor for leaf in plan.leaves)}
        for plan in plans
    ]
    return Data("plans", {"domain": asked.domain.name}, summary, rows, {"trees": trees})


def _node_row(title: str, node: dict[str, Any]) -> Row:
    return {"plan": title, **{key: node[key] for key in ("node", "term", "kind", "status")}}


def says_plans(data: Data) -> Iterator[str]:
    """The leaves in order."""
    yield (
        "The same three trees; parameters (food, beverage) are ours, and decide where names alone leave goals open."
    )
    yield table(("goal", "actions in order"), ((row["goal"], row["plan"]) for row in data.summary))


def work_score(asked: Asked, ran: Ran) -> Data:
    """The example: one observation, two goals."""
    reading = Domain.from_text(plans=EXAMPLE).reading()
    reading.observe("a")
    found = [e for e in reading.explanations() if isinstance(e, Explanation)]
    told = [{"goal": e.goal, "score": e.score, "share": e.share, "missed": e.missed} for e in found]
    summary = [{**row, "printed share": printed} for row, printed in zip(told, SCORE)]
    trees = [
        {"title": f"{row['goal']}: score {row['score']:.3f}, share {row['share']:.2f}", **_tree(e.tree())}
        for row, e in zip(told, found)
    ]
    rows = [_node_row(tree["title"], node) for tree in trees for node in tree["nodes"]]
    return Data("score", {"plans": EXAMPLE, "observation": "a"}, summary, rows, {"trees": trees})


def says_score(data: Data) -> Iterator[str]:
    """Both shares."""
    yield table(
        ("goal", "missed", "printed share", "ours"),
        ((row["goal"], row["missed"], row["printed share"], f"{row['share']:.2f}") for row in data.summary),
    )
    yield (
        f"The printed shares add up to {sum(SCORE):.2f}, so one of them is a slip, and no two plans reproduce both. "
        f"Drawn are `{data.about['plans']}` after one observation: the score is (observed / leaves) · (1 − missed / "
        "leaves), a share is a score's part of the sum."
    )


PLANS = Experiment(
    "plans", "the plan library as trees", 'figure "goals"', work_plans, says_plans, {"plans": trees_figure}
)
SCORE_EXAMPLE = Experiment(
    "score", "the example of the score as trees", 'figure "score"', work_score, says_score, {"score": trees_figure}
)
