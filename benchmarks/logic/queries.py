"""Verification queries over the kitchen's ontology: one ground statement, eat in every mode, valid(S)."""

import importlib.util
from collections.abc import Callable, Iterator
from itertools import product
from typing import Any

from casper.kb.base import KnowledgeBase
from casper.kb.writer import program_text
from kanren import Relation, conde, eq, facts, lall, run, var

from . import prolog
from .figures import CONTROL, OURS, Figure, Sizes, Skipped, per_call
from .kitchen import STATEMENTS, kitchen

TITLE = "Kitchen verification"
TIMED = (
    "One query, warm, all its answers. casper `ask` takes a tuple, the goal runs inside kanren's `run`, `query` takes "
    "text. SWI-Prolog runs compiled goals in its own loop, the loop subtracted; clingo's figure is a lookup in its "
    "grounding, without making the symbol. The control is kanren's `run(1, True, eq(1, 1))`."
)
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
    yield Figure(CONTROL, KANREN, per_call(lambda: run(1, True, eq(1, 1)), sizes=sizes))
    yield from _ground(kb, sizes)
    yield from _lookup(kb, sizes)
    yield from _every(kb, sizes)
    yield from _modes(kb, sizes)
    found = {x["S"] for x in kb.query(VALID)}
    yield Figure(VALID, QUERY, per_call(lambda: list(kb.query(VALID)), sizes=sizes), len(found))
    yield from _prolog(kb, sizes)


def _ground(kb: KnowledgeBase, sizes: Sizes) -> Iterator[Figure]:
    eat, plain = kb.eat, plain_eat(kb)
    for task, args in GROUND.items():
        statement = ("eat", *args)
        yield Figure(task, OURS, per_call(kb.ask, statement, sizes=sizes), int(kb.ask(statement)))
        for engine, goal in ((GOAL, eat), (KANREN, plain)):
            answers = len(run(0, True, goal(*args)))
            yield Figure(task, engine, per_call(lambda g=goal, a=args: run(1, True, g(*a)), sizes=sizes), answers)


def _every(kb: KnowledgeBase, sizes: Sizes) -> Iterator[Figure]:
    """All statements about eat that can be made of agents and objects, one after the other."""
    agents, objects = [x for (x,) in kb.rows("agent", 1)], [x for (x,) in kb.rows("object", 1)]
    statements = [("eat", *args) for args in product(agents, objects, objects)]
    plain, ask, eat = plain_eat(kb), kb.ask, kb.eat
    ways: dict[str, Callable[[tuple[Any, ...]], Any]] = {
        OURS: ask,
        GOAL: lambda s: run(1, True, eat(*s[1:])),
        KANREN: lambda s: run(1, True, plain(*s[1:])),
    }
    for engine, way in ways.items():
        seconds = per_call(lambda way=way: [way(s) for s in statements], sizes=sizes)
        yield Figure(EVERY, engine, seconds / len(statements), sum(bool(way(s)) for s in statements))


def _modes(kb: KnowledgeBase, sizes: Sizes) -> Iterator[Figure]:
    plain = plain_eat(kb)
    for task, args in modes().items():
        variables = {text: var(text) for text in args if text.isupper()}
        terms = [variables.get(text, text) for text in args]
        wanted = tuple(variables.values()) or True
        text = f"eat({', '.join(args)})"
        for engine, goal in ((GOAL, kb.eat), (KANREN, plain)):
            seconds = per_call(lambda g=goal, t=terms, w=wanted: run(0, w, g(*t)), sizes=sizes)
            yield Figure(task, engine, seconds, len(set(run(0, wanted, goal(*terms)))))
        seconds = per_call(lambda text=text: list(kb.query(text)), sizes=sizes)
        yield Figure(task, QUERY, seconds, len(list(kb.query(text))))


def modes() -> dict[str, tuple[str, str, str]]:
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
        yield Figure(task, "clingo", per_call(atoms.__getitem__, symbol, sizes=sizes), int(atoms[symbol] is not None))


def _prolog(kb: KnowledgeBase, sizes: Sizes) -> Iterator[Figure | Skipped]:
    if not prolog.is_installed():
        yield Skipped(TITLE, "swipl", "swipl is not on the PATH")
        return
    goals = {task: f"eat({', '.join(args)})" for task, args in (*GROUND.items(), *modes().items())}
    goals[VALID] = "valid(_)"
    for task, (seconds, count) in prolog.calls(kb.to_text() + VALID_IN_PROLOG, goals, sizes).items():
        yield Figure(task, "swipl", seconds, count)
