"""Verification queries over the kitchen's ontology: one ground statement, eat in every mode, valid(S)."""

import importlib.util
from collections.abc import Callable, Iterator
from functools import partial
from itertools import product
from typing import Any, TypeAlias

from kanren import Relation, conde, eq, facts, run, var
from kanren.constraints import neq

from casper.kb.base import KnowledgeBase
from casper.kb.terms.clauses import Clause
from casper.kb.terms.terms import Variable
from casper.kb.text.writer import program_text

from ..bounds import Bound, quotient, ratio, within
from ..figures import CONTROL, OURS, Amounts, Figure, Sizes, Skipped, per_call
from ..peers import prolog
from .kitchen import STATEMENTS, kitchen

TITLE = "Kitchen verification"
TIMED = (
    "One query, warm, all its answers. casper's `ask` takes a tuple and looks it up in the set of what holds, made "
    "when the base is first asked; the goal runs inside kanren's `run`; `query` takes text whose reading is "
    "remembered. Plain kanren has the same rules, as `Relation` and `conde`. SWI-Prolog runs compiled goals in its "
    "own loop, the loop subtracted; clingo's figure is a lookup in its grounding, without making the symbol. The "
    "control is kanren's `run(1, True, eq(1, 1))`."
)
Statement: TypeAlias = tuple[Any, ...]
GOAL, QUERY, KANREN = f"{OURS} goal in run", f"{OURS} query", "kanren"
GROUND = {
    "eat, ground, yes": ("human", "biscuits", "plate"),
    "eat, ground, no": ("tiago", "meal", "plate"),
}
EVERY = "ground, mean of every statement that holds"
MODES = "eat({mode})"
VALID = "valid(S)"
VALID_IN_PROLOG = f"""
claim(S) :- nb_current(claim, S).
valid(S) :- member(S, [{", ".join(f"{name}(_, _, _)" for name in STATEMENTS)}]),
    call(S), b_setval(claim, S), \\+ never(_).
"""


def in_plain_kanren(kb: KnowledgeBase) -> Callable[..., Any]:
    """The kitchen's rules as plain kanren: a `Relation` for the facts of each predicate, a `conde` for its rules."""
    tables: dict[tuple[str, int], Relation] = {}
    for clause in kb.clauses:
        if not clause.body:
            table = tables.setdefault(clause.head.indicator, Relation(clause.head.functor))
            facts(table, clause.head.args)

    def goal(name: str, *args: Any) -> Any:
        indicator = (name, len(args))
        ways = [[tables[indicator](*args)]] if indicator in tables else []
        return conde(*ways, *(body(rule, args) for rule in kb.clauses_of(indicator) if rule.body))

    def body(rule: Clause, args: tuple[Any, ...]) -> list[Any]:
        variables: dict[Any, Any] = dict(zip(rule.head.args, args))
        conditions = []
        for literal in rule.body:
            args = literal.atom.args
            terms = [variables.setdefault(arg, var()) if isinstance(arg, Variable) else arg for arg in args]
            conditions.append(neq(*terms) if literal.is_comparison else goal(literal.atom.functor, *terms))
        return conditions

    return goal


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
    plain = in_plain_kanren(kb)
    for task, args in GROUND.items():
        statement: Statement = ("eat", *args)
        seconds, found = per_call(kb.ask, statement, sizes=sizes)
        yield Figure(task, OURS, seconds, int(found))
        for engine, goal in ((GOAL, kb.eat), (KANREN, partial(plain, "eat"))):
            seconds, answers = per_call(lambda g=goal, a=args: run(1, True, g(*a)), sizes=sizes)
            yield Figure(task, engine, seconds, len(answers))


def _every(kb: KnowledgeBase, sizes: Sizes) -> Iterator[Figure]:
    """Every statement of the kitchen that holds, one after the other."""
    statements = [tuple(instance) for name in STATEMENTS for instance in kb.instances(f"{name}(_, _, _)")]
    plain, ask = in_plain_kanren(kb), kb.ask
    ways: dict[str, Callable[[], list[Any]]] = {
        OURS: lambda: [ask(s) for s in statements],
        GOAL: lambda: [run(1, True, kb.predicate(s[0])(*s[1:])) for s in statements],
        KANREN: lambda: [run(1, True, plain(*s)) for s in statements],
    }
    for engine, way in ways.items():
        seconds, found = per_call(way, sizes=sizes)
        yield Figure(EVERY, engine, seconds / len(statements), sum(map(bool, found)))


def _modes(kb: KnowledgeBase, sizes: Sizes) -> Iterator[Figure]:
    plain = partial(in_plain_kanren(kb), "eat")
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


def promises(amounts: Amounts, sizes: Sizes) -> Iterator[Bound]:
    """Verification against plain kanren and SWI-Prolog, goals against kanren's own cost, and valid(S)."""
    value = quotient(amounts, (EVERY, KANREN), (EVERY, OURS))
    yield Bound(f"{EVERY}: `ask` faster than plain kanren by", value, 1000, "×", at_least=True)
    for task in GROUND:
        yield ratio(amounts, f"{task}: `ask`, against SWI-Prolog", (task, OURS), (task, "swipl"), 1)
        yield ratio(amounts, f"{task}: goal in `run`, against the control", (task, GOAL), (CONTROL, KANREN), 2)
    yield within(amounts, VALID, 0.4, engine=QUERY)
