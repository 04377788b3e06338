"""Plan trees with the paper's marks, one below the other."""

from __future__ import annotations

from typing import Any

from casper.engine.explanation.pictures import draw_tree, positions
from casper.experiments.experiment import Data
from casper.experiments.figures.style import canvas

WIDTH, HEIGHT = 1.9, 1.05  # inches a leaf and a row take


def trees_figure(data: Data) -> Any:
    """Every tree of the data."""
    import networkx as nx

    trees = []
    for told in data.facts["trees"]:
        tree: nx.DiGraph = nx.DiGraph()
        for node in told["nodes"]:
            tree.add_node(node["node"], **{key: value for key, value in node.items() if key != "node"})
        tree.add_edges_from(map(tuple, told["edges"]))
        trees.append((told["title"], tree, positions(tree)))
    rows = [1 - min(y for _, y in places.values()) for _, _, places in trees]
    widest = max(max(x for x, _ in places.values()) for _, _, places in trees) + 1
    figure = canvas(widest * WIDTH, sum(rows) * HEIGHT + 0.3 * len(rows))
    axes = figure.subplots(len(trees), 1, squeeze=False, gridspec_kw={"height_ratios": rows})[:, 0]
    for axis, (title, tree, places) in zip(axes, trees):
        axis.set_title(title, fontsize=9, loc="left")
        axis.set_xlim(-0.6, widest - 0.4)
        axis.set_ylim(min(y for _, y in places.values()) - 0.5, 0.5)
        axis.axis("off")
        draw_tree(axis, tree, places)
    return figure
