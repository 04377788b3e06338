"""Lookups and joins over 10² … 10⁵ rows in every mode, as goals inside kanren's `run` and as queries."""

from collections.abc import Callable, Iterator
from random import Random
from typing import Any

from casper.kb.base import KnowledgeBase
from kanren import Relation, facts, lall, run, var

from . import prolog
from .figures import OURS, Figure, Rows, Sizes, Skipped, per_call
from .peers import Program, loaded

TITLE = "Lookups and joins"
TIMED = (
    "All answers of one query, warm, every index built. Two relations of n rows; each constant stands in about two "
    "rows. Joins are a conjunction in the written order; casper and kanren inside kanren's `run`, SWI-Prolog in its "
    "own loop."
)
GOAL, QUERY, KANREN = f"{OURS} goal in run", f"{OURS} query", "kanren"
LOOKUPS = {
    "r(b, b), yes": "r({x}, {y})",
    "r(b, b), no": "r({x}, nowhere)",
    "r(b, f)": "r({x}, Y)",
    "r(f, b)": "r(X, {y})",
    "r(f, f)": "r(X, Y)",
}
JOINS = {
    "r(b, Y), s(Y, f)": "r({x}, Y), s(Y, Z)",
    "r(f, Y), s(Y, b)": "r(X, Y), s(Y, {z})",
    "r(b, Y), s(Y, b)": "r({x}, Y), s(Y, {z})",
    "r(f, Y), s(Y, f)": "r(X, Y), s(Y, Z)",
}


def tables(size: int) -> dict[str, Rows]:
    """Two relations of so many rows, r over x and y, s over y and z."""
    random, half = Random(size), max(2, size // 2)

    def drawn(left: str, right: str) -> Rows:
        pairs: dict[tuple[str | int, ...], None] = {}
        while len(pairs) < size:
            pairs[f"{left}{random.randrange(half)}", f"{right}{random.randrange(half)}"] = None
        return list(pairs)

    return {"r": drawn("x", "y"), "s": drawn("y", "z")}


def queries(rows: dict[str, Rows]) -> dict[str, str]:
    """The text of every query, by task."""
    x, y = rows["r"][0]
    z = next((right for left, right in rows["s"] if left == y), rows["s"][0][1])
    return {task: text.format(x=x, y=y, z=z) for task, text in (LOOKUPS | JOINS).items()}


def measure(sizes: Sizes) -> Iterator[Figure | Skipped]:
    """Every mode at every number of rows; a peer that grew too slow is not asked for more."""
    slow: set[str] = set()
    for size in sizes.rows:
        rows = tables(size)
        kb = loaded(Program(rows, (), ()))
        kb.compile()
        plain = {name: Relation(name) for name in rows}
        for name, relation in plain.items():
            facts(relation, *rows[name])
        goals = queries(rows)
        for task, text in goals.items():
            label = f"{task}, {size:,} rows"
            yield from _ours(label, kb, text, sizes)
            if task in slow:
                yield Skipped(label, KANREN, f"it took over {sizes.patience} s on the next smaller table")
                continue
            figure = _goal_figure(label, KANREN, plain.__getitem__, text, sizes)
            if figure.seconds > sizes.patience:
                slow.add(task)
            yield figure
        yield from _prolog(rows, goals, size, sizes)


def _ours(label: str, kb: KnowledgeBase, text: str, sizes: Sizes) -> Iterator[Figure]:
    yield _goal_figure(label, GOAL, kb.predicate, text, sizes)
    seconds = per_call(lambda: list(kb.query(text)), sizes=sizes)
    yield Figure(label, QUERY, seconds, len(list(kb.query(text))))


def _goal_figure(label: str, engine: str, relation: Callable[[str], Any], text: str, sizes: Sizes) -> Figure:
    """The conjunction as kanren goals: the same source for kanren's relations and for ours."""
    variables = {name: var(name) for name in "XYZ"}
    wanted = tuple(v for name, v in variables.items() if name in text) or True
    atoms = [_parts(atom) for atom in text.removesuffix(")").split("), ")]
    atoms = [(name, [variables.get(arg, arg) for arg in args]) for name, args in atoms]

    def found() -> Any:
        return run(0, wanted, lall(*(relation(name)(*args) for name, args in atoms)))

    return Figure(label, engine, per_call(found, sizes=sizes), len(set(found())))


def _parts(atom: str) -> tuple[str, list[Any]]:
    name, _, args = atom.partition("(")
    return name, args.split(", ")


def _prolog(rows: dict[str, Rows], goals: dict[str, str], size: int, sizes: Sizes) -> Iterator[Figure | Skipped]:
    if not prolog.is_installed():
        yield Skipped(f"{size:,} rows", "swipl", "swipl is not on the PATH")
        return
    for task, (seconds, count) in prolog.calls(Program(rows, (), ()).text(), goals, sizes).items():
        yield Figure(f"{task}, {size:,} rows", "swipl", seconds, count)
