"""Shortest paths as a recursive minimum: ``:- table path(_, _, min).``

Three questions of one weighted graph: the distances from a node that the rule names, those from a node that the
question names, and those between all nodes.
"""

from collections.abc import Iterator
from functools import partial
from heapq import heappop, heappush
from random import Random
from typing import Any

from casper.kb.base import KnowledgeBase

from ..bounds import Bound, against
from ..figures import OURS, Amounts, Found, Rows, Sizes, Skipped, attempt, fingerprint, timed
from ..peers import prolog
from ..peers.engines import grounded_rows, stated
from ..peers.fresh import fresh

TITLE = "Shortest paths"
TIMED = (
    "Weighted edges and rules are loaded; timed is deriving the minima and reading them, in a fresh process that is "
    "stopped after three quarters of a minute. SWI-Prolog has the same text. clingo has no recursive minimum: it "
    "derives every distance up to a largest one that counts, which it is told, and then takes `#min`."
)
NAMED = ":- table dist(_, min).\ndist(0, 0).\ndist(Y, D) :- dist(X, E), edge(X, Y, W), D is E + W.\n"
PATHS = (
    ":- table path(_, _, min).\npath(X, Y, D) :- edge(X, Y, D).\n"
    "path(X, Y, D) :- path(X, Z, E), edge(Z, Y, W), D is E + W.\n"
)
IN_CLINGO = (
    "{start} at(Y, D) :- at(X, E), edge(X, Y, W), D = E + W, D <= {largest}.\n"
    "dist(Y, D) :- at(Y, _), D = #min {{ E : at(Y, E) }}.\n"
)
HEAVIEST = 10  # weight
STARTS = {"dist(Y, D)": "at(0, 0).", "path(0, Y, D)": "at(Y, W) :- edge(0, Y, W)."}  # in clingo, by goal
ONE, ASKED, ALL = "from one node", "from the node that is asked for", "between all nodes"


def tasks(sizes: Sizes) -> dict[str, str]:
    """The name of each task."""
    nodes, edges = sizes.weighted
    return {kind: f"shortest paths {kind}, {nodes:,} nodes, {edges:,} edges" for kind in (ONE, ASKED, ALL)}


def graph(sizes: Sizes) -> Rows:
    """Edges between random nodes, with weights from 1 on."""
    random, (nodes, edges) = Random(4), sizes.weighted
    found: dict[tuple[int, int], int] = {}
    while len(found) < edges:
        found[random.randrange(nodes), random.randrange(nodes)] = random.randrange(1, HEAVIEST + 1)
    return [(x, y, weight) for (x, y), weight in found.items()]


def measure(sizes: Sizes) -> Found:
    """Every question by every engine that can."""
    edges, names = graph(sizes), tasks(sizes)
    given = "".join(f"edge({x},{y},{w}).\n" for x, y, w in edges)
    for kind, text, goal in (
        (ONE, NAMED, "dist(Y, D)"),
        (ASKED, PATHS, "path(0, Y, D)"),
        (ALL, PATHS, "path(X, Y, D)"),
    ):
        row = [name for name in "XYD" if name in goal.partition("(")[2]]
        yield attempt(names[kind], OURS, partial(fresh, ours, edges, text, goal, limit=sizes.limit))
        yield attempt(names[kind], "swipl", partial(prolog.enumerated, given + text, goal, row, sizes, repeats=1))
        if kind == ALL:
            yield Skipped(names[kind], "clingo", "it would derive every distance of every pair, not the least alone")
        else:
            way = IN_CLINGO.format(start=STARTS[goal], largest=max(distances(edges).values()) + HEAVIEST)
            yield attempt(names[kind], "clingo", partial(grounded_rows, given + way, "dist", 2))


def ours(edges: Rows, text: str, goal: str) -> tuple[float, tuple[int, int]]:
    """Runs in a fresh process."""
    kb = stated({"edge": edges}, text)
    seconds, found = timed(lambda: _answers(kb, goal))
    return seconds, fingerprint(found)


def _answers(kb: KnowledgeBase, goal: str) -> list[Any]:
    kb.compile()
    return [tuple(answer.values()) for answer in kb.query(goal, budget=10**9)]


def distances(edges: Rows) -> dict[int, int]:
    """Dijkstra's algorithm from node 0: what the engines should find."""
    out: dict[int, list[tuple[int, int]]] = {}
    for x, y, weight in edges:
        out.setdefault(int(x), []).append((int(y), int(weight)))
    found: dict[int, int] = {}
    queue = [(0, 0)]
    while queue:
        distance, node = heappop(queue)
        if node not in found:
            found[node] = distance
            for other, weight in out.get(node, ()):
                heappush(queue, (distance + weight, other))
    return found


def promises(amounts: Amounts, sizes: Sizes) -> Iterator[Bound]:
    """A recursive minimum is faster than clingo's way round it."""
    yield from (against(amounts, tasks(sizes)[kind], "clingo") for kind in (ONE, ASKED))
