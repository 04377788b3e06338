"""The transitive closure of three graphs, all pairs: the same edges and the same rules for every engine.

Each peer is tried with the left- and the right-recursive rule and its better figure counts; casper has to take both.
"""

from collections.abc import Iterator
from random import Random

from .figures import OURS, Figure, Rows, Sizes, Skipped
from .peers import PEERS, Program, casper, derivations

TITLE = "Closures, all pairs"
TIMED = (
    "Edges and rules are loaded; timed is deriving all pairs (casper: `compile` and a first `ask`; clingo: grounding; "
    "SWI-Prolog: one tabled query for all answers), for peers the best of their settings and of left and right "
    "recursion. Plain kanren has no tabling and does not end here."
)
BASE = "path(X, Y) :- edge(X, Y)"
SHAPES = {"left": "path(X, Y) :- path(X, Z), edge(Z, Y)", "right": "path(X, Y) :- edge(X, Z), path(Z, Y)"}


def graphs(sizes: Sizes) -> dict[str, Rows]:
    """The edges of each graph, by the task's name."""
    nodes, edges = sizes.random_graph
    random = Random(1)
    pairs: dict[tuple[int, int], None] = {}
    while len(pairs) < edges:
        pairs[random.randrange(nodes), random.randrange(nodes)] = None
    return {
        f"random graph, {nodes:,} nodes, {edges:,} edges": list(pairs),
        f"chain of {sizes.chain:,}": [(at, at + 1) for at in range(sizes.chain)],
        f"cycle of {sizes.cycle:,}": [(at, (at + 1) % sizes.cycle) for at in range(sizes.cycle)],
    }


def program(edges: Rows, shape: str) -> Program:
    """The closure of the edges by a left- or right-recursive rule."""
    return Program({"edge": edges}, (BASE, SHAPES[shape]), (("path", 2),))


def measure(sizes: Sizes) -> Iterator[Figure | Skipped]:
    """Every graph by every engine."""
    for task, edges in graphs(sizes).items():
        for shape in SHAPES:
            outcome = casper(program(edges, shape), sizes)
            yield Figure(task, OURS if shape == "left" else f"{OURS}, {shape} recursion", outcome.seconds, outcome.answers)
        for name in PEERS:
            yield _best([x for shape in SHAPES for x in derivations(task, program(edges, shape), sizes, [name])])


def _best(found: list[Figure | Skipped]) -> Figure | Skipped:
    figures = [x for x in found if isinstance(x, Figure)]
    return min(figures, key=lambda figure: figure.seconds) if figures else found[0]
