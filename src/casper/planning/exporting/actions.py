"""Rules and effects of actions as actions of a problem."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterable, Sequence
from typing import Any

from unified_planning.model import InstantaneousAction

from casper.kb.terms.clauses import Clause
from casper.kb.terms.terms import Compound, Term, Variable, predication
from casper.planning.exporting.expressions import Scope
from casper.planning.exporting.target import Target, Unplanned, body_terms, shown
from casper.planning.importing.names import inward, parameter_name

EFFECTS = frozenset({("initiates", 3), ("terminates", 3), ("assigns", 4)})


def make_action(target: Target, clauses: Sequence[Clause], effects: Iterable[Clause]) -> Any:
    """An action of its rules (alternatives) and the clauses that say what it changes.

    Raises:
        Unplanned: something of it has no place in a problem.
    """
    name = inward(clauses[0].head.functor)
    parameters = typed(target, _arguments(target, clauses[0].head), clauses[0])
    action = InstantaneousAction(name, _parameters=parameters, _env=target.problem.environment)
    for condition in any_of(target, [_preconditions(target, action, clause) for clause in clauses]):
        action.add_precondition(condition)
    for effect in _effects(target, action, effects):
        _add(action, *effect)
    return action


def any_of(target: Target, rows: Sequence[list[Any]]) -> list[Any]:
    """The conditions of one clause, or of several as one condition."""
    if len(rows) == 1:
        return rows[0]
    return [target.manager.Or([target.manager.And(row) for row in rows])]


def typed(target: Target, variables: Sequence[Term], clause: Clause) -> OrderedDict[str, Any]:
    """The variables of a clause as names of parameters, each with the type that the first conditions give it."""
    found: OrderedDict[str, Any] = OrderedDict()
    body = [predication(term) for term in body_terms(clause)]
    for variable in variables:
        of = [t[0] for t in body if t.arity == 1 and t[1] == variable and inward(t[0]) in target.types]
        if not isinstance(variable, Variable) or not of:
            raise Unplanned(f"{shown(variable)} has no type in {shown(clause.head)}; state one", clause.place)
        name = parameter_name(variable.name)
        if name in found:
            raise Unplanned(f"two parameters of {shown(clause.head)} are {variable}", clause.place)
        found[name] = target.types[inward(of[0])]
    return found


def rest(variables: Sequence[Term], clause: Clause) -> list[Term]:
    """The conditions of a clause behind the types of its variables."""
    left, open_ = [], list(variables)
    for term in body_terms(clause):
        said = predication(term)
        if said.arity == 1 and said[1] in open_ and said.functor != "\\+":
            open_.remove(said[1])
        else:
            left.append(term)
    return left


def _arguments(target: Target, statement: Compound) -> tuple[Term, ...]:
    name = inward(statement.functor)
    return target.ordered(name, statement[1], statement[2:])


def _preconditions(target: Target, action: Any, clause: Clause) -> list[Any]:
    arguments = _arguments(target, clause.head)
    known = {a: target.manager.ParameterExp(p) for a, p in zip(arguments, action.parameters)}
    conditions = [t for t in rest(arguments, clause) if predication(t)[:1] != ("actor",)]
    return Scope(target, known, clause.place).conditions(conditions)


def _effects(target: Target, action: Any, clauses: Iterable[Clause]) -> list[tuple[Any, Any, Any, tuple[Any, ...]]]:
    """Fluent, value, condition and variables of every effect; equal ones of several clauses are one."""
    found: dict[tuple[Any, ...], list[Any]] = {}
    for clause in clauses:
        fluent, value, condition, variables = _effect(target, action, clause)
        numeric = not fluent.type.is_bool_type()
        key = (fluent, value, variables) if numeric else (fluent, value, variables, condition)
        found.setdefault(key, []).append(condition)
    told = []
    for key, conditions in found.items():
        condition = conditions[0] if len(conditions) == 1 else target.manager.Or(conditions)
        told.append((key[0], key[1], condition, key[2]))
    return told


def _effect(target: Target, action: Any, clause: Clause) -> tuple[Any, Any, Any, tuple[Any, ...]]:
    relation, statement, changed, *results = clause.head[:-1]
    known: dict[Variable, Any] = {}
    same: list[Any] = []
    scope = Scope(target, known, clause.place)
    for argument, parameter in zip(_arguments(target, predication(statement)), action.parameters):
        expression = target.manager.ParameterExp(parameter)
        if isinstance(argument, Variable) and argument not in scope.known:
            scope.known[argument] = expression
        else:
            same.append(target.manager.Equals(expression, scope.value(argument)))
    body = body_terms(clause)
    conditions = [term for term in body if predication(term).functor != "is"]
    free = _variables_of(changed, scope, conditions)
    held = same + scope.conditions(conditions, free)
    fluent = scope.fluent(changed)
    if relation != "assigns":
        value = target.manager.TRUE() if relation == "initiates" else target.manager.FALSE()
    else:
        sums = {said[1]: said[2] for said in map(predication, body) if said.functor == "is"}
        value = scope.value(sums.get(results[0], results[0]))
    return fluent, value, target.manager.And(held), tuple(free)


def _variables_of(changed: Term, scope: Scope, conditions: list[Term]) -> list[Any]:
    """The variables of the body that the fluent has: the effect is on every such fluent."""
    trial = scope.within()
    trial.conditions(conditions)
    expressions = [trial.known.get(v) for v in predication(changed).args if isinstance(v, Variable)]
    own = [e.variable() for e in expressions if e is not None and e.is_variable_exp()]
    return [variable for variable in trial.bound if variable in own]


def _add(action: Any, fluent: Any, value: Any, condition: Any, variables: tuple[Any, ...]) -> None:
    if value.is_plus() and value.args[0] == fluent and len(value.args) == 2:
        action.add_increase_effect(fluent, value.args[1], condition, variables)
    elif value.is_minus() and value.args[0] == fluent:
        action.add_decrease_effect(fluent, value.args[1], condition, variables)
    else:
        action.add_effect(fluent, value, condition, variables)
