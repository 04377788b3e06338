"""The transitive closure of three graphs, all pairs: the same edges and the same rules for every engine.

Each peer is tried with the left- and the right-recursive rule and its better figure counts; casper's figure
is the left-recursive rule's, the other stands beside it.
"""

from collections.abc import Iterator
from random import Random

from ..bounds import Bound, against
from ..figures import OURS, Amounts, Figure, Rows, Sizes, Skipped, timed
from ..peers.engines import Program, casper, derivations, loaded

TITLE = "Closures, all pairs"
TIMED = (
    "Edges and rules are loaded; timed is deriving all pairs (casper: `compile` and a first `ask`; "
    "clingo: grounding; SWI-Prolog: one tabled query for all answers), for peers the best of their "
    "settings and of left and right recursion. Plain kanren has no tabling and does not end here."
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
    """Every graph by every engine, and the first reason that is asked for."""
    for task, edges in graphs(sizes).items():
        shapes = [program(edges, shape) for shape in SHAPES]
        yield from derivations(task, shapes, sizes)
        other = casper(shapes[1:], sizes)
        yield Figure(task, f"{OURS}, right recursion", other.seconds, other.answers)
        yield _first_reason(f"{task}: deriving, and a first why", edges)


def _first_reason(task: str, edges: Rows) -> Figure:
    """Deriving all pairs, and one proof: of a pair a few edges apart, or of an edge."""
    kb = loaded(program(edges, "left"))
    start = edges[0][0]

    def reason() -> object:
        kb.compile()
        return kb.why(("path", start, edges[5][1])) or kb.why(("path", *edges[0]))

    seconds, proof = timed(reason)
    return Figure(task, OURS, seconds, proof is not None)


def promises(amounts: Amounts, sizes: Sizes) -> Iterator[Bound]:
    """Every graph faster than clingo."""
    yield from (against(amounts, task, "clingo") for task in graphs(sizes))
