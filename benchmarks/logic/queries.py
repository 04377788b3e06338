"""Verification queries over the kitchen's ontology: one ground statement, eat in every mode, valid(S)."""

import importlib.util
from collections.abc import Callable, Iterator
from itertools import product
from statistics import median
from time import perf_counter
from typing import Any, TypeAlias

from kanren import Relation, conde, eq, facts, lall, run, var

from casper.kb.base import KnowledgeBase
from casper.kb.writer import program_text

from . import prolog
from .figures import CONTROL, OURS, Figure, Sizes, Skipped, per_call
from .kitchen import STATEMENTS, kitchen

TITLE = "Kitchen verification"
TIMED = (
    "One query, warm, all its answers. casper's `ask` takes a tuple; its first column is of statements "
    "that were not asked before, since the base remembers answers: asking again is the second one. The "
    "goal runs inside kanren's `run`; `query` takes text whose reading is remembered. SWI-Prolog runs "
    "compiled goals in its own loop, the loop subtracted; clingo's figure is a lookup in its grounding, "
    "without making the symbol. The control is kanren's `run(1, True, eq(1, 1))`."
)
AGAIN = f"{OURS}, asked again"
COPIES = 10  # bases for each loop, to ask a statement for the first time
Statement: TypeAlias = tuple[Any, ...]
GOAL, QUERY, KANREN = f"{OURS} goal in run", f"{OURS} query", "kanren"
GROUND = {
    "eat, ground, yes": ("human", "biscuits", "plate"),
    "eat, ground, no": ("tiago", "meal", "plate"),
}
EVERY = "eat, ground, mean of all statements"
MODES = "eat({mode})"
VALID = "valid(S)"
VALID_IN_PROLOG = f"""
claim(S) :- nb_current(claim, S).
valid(S) :- member(S, [{", ".join(f"{name}(_, _, _)" for name in STATEMENTS)}]),
    call(S), b_setval(claim, S), \\+ never(_).
"""


def plain_eat(kb: KnowledgeBase) -> Callable[[Any, Any, Any], Any]:
    """The kitchen's rule for eat, as one writes it in plain kanren."""
    tables = {}
    for name in ("human", "biscuits", "meal", "water_bottle", "plate", "glass", "eatable"):
        tables[name] = Relation(name)
        facts(tables[name], *kb.rows(name, 1))

    def food(x: Any) -> Any:
        return conde([tables["biscuits"](x)], [tables["meal"](x)], [tables["water_bottle"](x)])

    def vessel(x: Any) -> Any:
        return conde([tables["plate"](x)], [tables["glass"](x)])

    def eat(a: Any, t: Any, d: Any) -> Any:
        return lall(tables["human"](a), food(t), tables["eatable"](t), vessel(d), tables["plate"](d))

    return eat


def measure(sizes: Sizes) -> Iterator[Figure | Skipped]:
    """Ground queries, modes, valid(S)."""
    kb = kitchen()
    yield Figure(CONTROL, KANREN, per_call(lambda: run(1, True, eq(1, 1)), sizes=sizes)[0])
    yield from _ground(kb, sizes)
    yield from _lookup(kb, sizes)
    yield from _every(kb, sizes)
    yield from _modes(kb, sizes)
    seconds, found = per_call(lambda: list(kb.query(VALID)), sizes=sizes)
    yield Figure(VALID, QUERY, seconds, len(found))
    yield from _prolog(kb, sizes)


def _ground(kb: KnowledgeBase, sizes: Sizes) -> Iterator[Figure]:
    plain, every = plain_eat(kb), _statements(kb)
    for task, args in GROUND.items():
        statement: Statement = ("eat", *args)
        others = [other for other in every if other != statement]
        yield Figure(task, OURS, first_time(kb, [statement], others, sizes), int(kb.ask(statement)))
        seconds, found = per_call(kb.ask, statement, sizes=sizes)
        yield Figure(task, AGAIN, seconds, int(found))
        for engine, goal in ((GOAL, kb.eat), (KANREN, plain)):
            seconds, answers = per_call(lambda g=goal, a=args: run(1, True, g(*a)), sizes=sizes)
            yield Figure(task, engine, seconds, len(answers))


def _every(kb: KnowledgeBase, sizes: Sizes) -> Iterator[Figure]:
    """All statements about eat that can be made of agents and objects, one after the other."""
    statements = _statements(kb)
    plain, ask, eat = plain_eat(kb), kb.ask, kb.eat
    ways: dict[str, Callable[[], list[Any]]] = {
        AGAIN: lambda: [ask(s) for s in statements],
        GOAL: lambda: [run(1, True, eat(*s[1:])) for s in statements],
        KANREN: lambda: [run(1, True, plain(*s[1:])) for s in statements],
    }
    yield Figure(
        EVERY,
        OURS,
        first_time(kb, statements, [("eat", "nobody", "nothing", "nowhere")] * 100, sizes),
        sum(map(ask, statements)),
    )
    for engine, way in ways.items():
        seconds, found = per_call(way, sizes=sizes)
        yield Figure(EVERY, engine, seconds / len(statements), sum(map(bool, found)))


def _statements(kb: KnowledgeBase) -> list[Statement]:
    agents, objects = [x for (x,) in kb.rows("agent", 1)], [x for (x,) in kb.rows("object", 1)]
    return [("eat", *args) for args in product(agents, objects, objects)]


def first_time(kb: KnowledgeBase, asked: list[Statement], before: list[Statement], sizes: Sizes) -> float:
    """Median seconds of asking what a warm base was never asked before: one pass over each of many bases.

    Args:
        kb: the base to copy.
        asked: the statements of the pass.
        before: the statements that warm each copy up; it remembers their answers.
        sizes: how many copies.
    """
    times = []
    for _ in range(COPIES * sizes.loops):
        copy = KnowledgeBase(kb.clauses)
        for statement in before:
            copy.ask(statement)
        ask, began = copy.ask, perf_counter()
        for statement in asked:
            ask(statement)
        times.append((perf_counter() - began) / len(asked))
    return median(times)


def _modes(kb: KnowledgeBase, sizes: Sizes) -> Iterator[Figure]:
    plain = plain_eat(kb)
    for task, args in modes().items():
        variables = {text: var(text) for text in args if text.isupper()}
        terms = [variables.get(text, text) for text in args]
        wanted = tuple(variables.values()) or True
        for engine, goal in ((GOAL, kb.eat), (KANREN, plain)):
            seconds, found = per_call(lambda g=goal, t=terms, w=wanted: run(0, w, g(*t)), sizes=sizes)
            yield Figure(task, engine, seconds, len(set(found)))
        text = f"eat({', '.join(args)})"
        seconds, found = per_call(lambda text=text: list(kb.query(text)), sizes=sizes)
        yield Figure(task, QUERY, seconds, len(found))


def modes() -> dict[str, tuple[str, ...]]:
    """Which arguments of eat are bound (b) and which are free (f), with the arguments."""
    bound = GROUND["eat, ground, yes"]
    found = {}
    for pattern in product("bf", repeat=3):
        args = tuple(b if way == "b" else free for way, b, free in zip(pattern, bound, "XYZ"))
        found[MODES.format(mode=", ".join(pattern))] = args
    return found


def _lookup(kb: KnowledgeBase, sizes: Sizes) -> Iterator[Figure | Skipped]:
    if importlib.util.find_spec("clingo") is None:
        yield Skipped(next(iter(GROUND)), "clingo", "the Python package clingo is not installed")
        return
    from clingo import Control, Function

    rules = program_text([clause for clause in kb.clauses if clause.head.functor != "never"])
    control = Control(["-Wnone"])
    control.add("base", [], rules.replace("\\=", "!=").replace("\\+", "not"))
    control.ground([("base", [])])
    atoms = control.symbolic_atoms
    for task, args in GROUND.items():
        symbol = Function("eat", [Function(arg) for arg in args])
        seconds, found = per_call(atoms.__getitem__, symbol, sizes=sizes)
        yield Figure(task, "clingo", seconds, int(found is not None))


def _prolog(kb: KnowledgeBase, sizes: Sizes) -> Iterator[Figure | Skipped]:
    if not prolog.is_installed():
        yield Skipped(TITLE, "swipl", "swipl is not on the PATH")
        return
    goals = {task: f"eat({', '.join(args)})" for task, args in (*GROUND.items(), *modes().items())}
    goals[VALID] = "valid(_)"
    for task, (seconds, count) in prolog.calls(kb.to_text() + VALID_IN_PROLOG, goals, sizes).items():
        yield Figure(task, "swipl", seconds, count)
