"""Lookups and joins over 10² … 10⁵ rows in every mode, as goals inside kanren's `run` and as queries."""

from collections.abc import Callable, Iterator
from functools import cache
from itertools import product
from random import Random
from typing import Any

from kanren import Relation, facts, lall, run, var

from casper.kb.goals.streams import lall as flat

from ..bounds import Bound
from ..figures import OURS, Amounts, Figure, Rows, Sizes, Skipped, per_call
from ..peers import prolog
from ..peers.engines import Program, loaded

TITLE = "Lookups and joins"
TIMED = (
    "All answers of one query, warm, every index built. Two relations of n rows; each constant stands in "
    "about two rows. A join is `lall` of two goals in the written order, each engine its own `lall`, both "
    "inside kanren's `run`; `query` takes text whose reading is remembered; SWI-Prolog runs compiled "
    "goals in its own loop."
)
GOAL, QUERY, KANREN = f"{OURS} goal in run", f"{OURS} query", "kanren"
LOOKUPS = {
    "r(b, b), yes": "r({x}, {y})",
    "r(b, b), no": "r({x}, nowhere)",
    "r(b, b), unknown constants": "r(nobody, nowhere)",
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
    """Every mode at every number of rows; plain kanren is left out, with a line, where it grew too slow."""
    before: dict[tuple[str, str], list[float]] = {}
    for size in sizes.rows:
        rows = tables(size)
        ways = _ways(rows)
        goals = queries(rows)
        for (task, text), (engine, way) in product(goals.items(), ways.items()):
            label, times = f"{task}, {size:,} rows", before.setdefault((task, engine), [])
            expected = times[-1] * times[-1] / times[-2] if len(times) > 1 else 0.0
            if engine == KANREN and expected > sizes.patience:
                yield Skipped(label, engine, f"it would take about {expected:.0f} s")
                continue
            seconds, found = per_call(way, text, sizes=sizes)
            times.append(seconds)
            yield Figure(label, engine, seconds, len(found))
        yield from _prolog(rows, goals, size, sizes)


def _ways(rows: dict[str, Rows]) -> dict[str, Callable[[str], Any]]:
    """How each engine answers a query that is given as text."""
    kb = loaded(Program(rows, (), ()))
    kb.compile()
    plain = {name: Relation(name) for name in rows}
    for name, relation in plain.items():
        facts(relation, *rows[name])
    return {
        GOAL: lambda text: _answers(text, kb.predicate, flat),
        QUERY: lambda text: list(kb.query(text)),
        KANREN: lambda text: _answers(text, plain.__getitem__, lall),
    }


def _answers(text: str, relation: Callable[[str], Any], conjunction: Callable[..., Any]) -> Any:
    """The answers to a conjunction of kanren goals."""
    wanted, atoms = _conjunction(text)
    goals = [relation(name)(*args) for name, args in atoms]
    return run(0, wanted, goals[0] if len(goals) == 1 else conjunction(*goals))


@cache
def _conjunction(text: str) -> tuple[Any, list[tuple[str, list[Any]]]]:
    """The variables of a query (True where there are none), and its atoms with kanren variables in them."""
    variables = {name: var(name) for name in "XYZ"}
    wanted = tuple(v for name, v in variables.items() if name in text) or True
    atoms = [_parts(atom) for atom in text.removesuffix(")").split("), ")]
    return wanted, [(name, [variables.get(arg, arg) for arg in args]) for name, args in atoms]


def _parts(atom: str) -> tuple[str, list[Any]]:
    name, _, args = atom.partition("(")
    return name, args.split(", ")


def _prolog(
    rows: dict[str, Rows], goals: dict[str, str], size: int, sizes: Sizes
) -> Iterator[Figure | Skipped]:
    if not prolog.is_installed():
        yield Skipped(f"{size:,} rows", "swipl", "swipl is not on the PATH")
        return
    for task, (seconds, count) in prolog.calls(Program(rows, (), ()).text(), goals, sizes).items():
        yield Figure(f"{task}, {size:,} rows", "swipl", seconds, count)


def promises(amounts: Amounts, sizes: Sizes) -> Iterator[Bound]:
    """None: these figures are there to be known."""
    yield from ()
