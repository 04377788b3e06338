"""Productions as methods and as the initial task network."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from unified_planning.model import Parameter
from unified_planning.model.htn import Method, Subtask, Task

from casper.kb.errors import Place
from casper.kb.terms.clauses import Clause, Production
from casper.kb.terms.terms import NIL, Compound, Term, Variable, predication
from casper.planning.exporting.actions import any_of, rest, typed
from casper.planning.exporting.expressions import Scope
from casper.planning.exporting.target import Target, Unplanned, shown
from casper.planning.importing.names import GOAL_STATE, NETWORK, inward, parameter_name
from casper.plans.grammar.shapes import partial_order

Conditions = Mapping[str, Sequence[Clause]]
"""The clauses of method/1 by the name of the method."""


def make_task(target: Target, clause: Clause, productions: Sequence[Production]) -> Task:
    """A task of its signature; its parameters are called as in the first production that does it."""
    name, *types = predication(clause.head[1])
    heads = [p.head for p in productions if inward(p.head.functor) == name and p.head.arity == len(types)]
    names = [parameter_name(a.name) if isinstance(a, Variable) else "" for a in (heads[0].args if heads else ())]
    good = len(set(names)) == len(types) and all(names) and not any(n.startswith("_") for n in names)
    wanted = names if good else [f"x{number}" for number, _ in enumerate(types, 1)]
    environment = target.problem.environment
    parameters = [Parameter(n, target.type_named(t, clause.place), environment) for n, t in zip(wanted, types)]
    return Task(name, parameters, _env=environment)


def is_impossible(production: Production) -> bool:
    """Whether the production only says that nobody does the task."""
    return bool(production.body == Compound(("{}", "fail")))


def make_method(target: Target, production: Production, conditions: Conditions) -> Method:
    """A method of its production and its condition.

    Raises:
        Unplanned: something of it has no place in a problem.
    """
    items = _items(production)
    told = _named(items, production)
    clauses = conditions.get(told.functor, ())
    if not clauses:
        raise Unplanned(f"no clause of method({shown(told)}) says when it may be chosen", production.place)
    variables = list(told.args)
    method = Method(inward(told.functor), typed(target, clauses[0].head[1][1:] if told.args else (), clauses[0]))
    known = {v: target.manager.ParameterExp(p) for v, p in zip(variables, method.parameters)}
    for condition in any_of(target, [_preconditions(target, method, clause) for clause in clauses]):
        method.add_precondition(condition)
    achieved = target.tasks.get(inward(production.head.functor))
    if achieved is None:
        raise Unplanned(f"{production.head.functor} has no compound_task(…), which says its types", production.place)
    odd = [argument for argument in production.head.args if argument not in known]
    if odd:
        raise Unplanned(f"{shown(odd[0])} of the task is no parameter of the method", production.place)
    method.set_task(achieved, *(known[argument].parameter() for argument in production.head.args))
    fill(target, method, known, items[1:], production.place)
    return method


def make_network(target: Target, production: Production, conditions: Conditions) -> None:
    """The initial task network, which the problem has already, filled."""
    network = target.problem.task_network
    items = _items(production)
    told = _named(items, production)
    parameters = typed(target, told.args, _renamed(conditions, told)) if told.args else {}
    known = {}
    for variable, (name, kind) in zip(told.args, parameters.items()):
        known[variable] = target.manager.ParameterExp(network.add_variable(name, kind))
    wanted = Compound(("{}", GOAL_STATE))
    fill(target, network, known, [item for item in items[1:] if item != wanted], production.place)


def _renamed(conditions: Conditions, told: Compound) -> Clause:
    clause = conditions[NETWORK][0]
    if clause.head[1] != told:
        raise Unplanned("the variables of the network and of its condition have other names", clause.place)
    return clause


def fill(target: Target, network: Any, known: dict[Variable, Any], items: Sequence[Term], place: Place) -> None:
    """Add constraints, subtasks and their order to a method or network."""
    scope = Scope(target, known, place)
    steps = [item for item in items if not _is_condition(item)]
    if any(_is_condition(item) for item in items[len(items) - len(steps) :]) and steps:
        raise Unplanned("a condition behind a step has no place in a method; put it into the next step", place)
    for item in items:
        if _is_condition(item):
            network.add_constraint(scope.condition(predication(item)[1]))
    shape, order = _shaped(steps, place)
    made = [_subtask(target, scope, item, number) for number, item in enumerate(shape, 1)]
    for subtask in made:
        network.add_subtask(subtask)
    for before, after in order:
        network.set_strictly_before(made[before], made[after])


def _shaped(steps: list[Term], place: Place) -> tuple[list[Term], list[tuple[int, int]]]:
    """The steps, and which come before which."""
    if len(steps) == 1 and isinstance(steps[0], Compound) and steps[0].functor in ("unordered", "steps"):
        items, pairs = partial_order(steps[0], place)
        return list(items), sorted(pairs)
    return steps, [(number, number + 1) for number in range(len(steps) - 1)]


def _subtask(target: Target, scope: Scope, item: Term, number: int) -> Subtask:
    said = predication(item)
    if said.indicator == ("by", 2):
        done = predication(said[2])
        name, arguments = inward(done.functor), target.ordered(inward(done.functor), said[1], done.args)
    else:
        name, arguments = inward(said.functor), said.args
    task = target.tasks.get(name) or target.actions.get(name)
    if task is None or len(task.parameters) != len(arguments):
        raise Unplanned(f"{shown(item)} is no task and no action of the problem", scope.place)
    return Subtask(task, *map(scope.value, arguments), ident=f"t{number}")


def _items(production: Production) -> list[Term]:
    body = production.body
    if isinstance(body, Compound) and body.functor == ",":
        return list(body.args)
    return [] if body == NIL else [body]


def _is_condition(item: Term) -> bool:
    return isinstance(item, Compound) and item.indicator == ("{}", 1)


def _named(items: Sequence[Term], production: Production) -> Compound:
    """What stands in ``{method(…)}`` at the beginning."""
    for item in items[:1]:
        if isinstance(item, Compound) and _is_condition(item):
            said = predication(item[1])
            if said.indicator == ("method", 1):
                return predication(said[1])
    raise Unplanned(f"the production of {production.head.functor} begins with no {{method(name(…))}}", production.place)


def _preconditions(target: Target, method: Any, clause: Clause) -> list[Any]:
    variables = predication(clause.head[1]).args
    known = {v: target.manager.ParameterExp(p) for v, p in zip(variables, method.parameters)}
    return Scope(target, known, clause.place).conditions(rest(variables, clause))


def by_name(clauses: Sequence[Clause]) -> Iterator[tuple[str, list[Clause]]]:
    """Clauses of method/1 by the name of the method."""
    found: dict[str, list[Clause]] = {}
    for clause in clauses:
        found.setdefault(predication(clause.head[1]).functor, []).append(clause)
    yield from found.items()
