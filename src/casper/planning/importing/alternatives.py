"""Conditions of problems as alternatives of rows of tests: what the bodies of clauses can say.

Negations go inwards, alternatives outwards; *there is* becomes variables of the body, *for all* stays.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import count, product
from typing import Any, TypeAlias

from unified_planning.model import FNode, OperatorKind, Variable

from casper.kb.errors import CasperError

MOST = 1000  # alternatives of one condition
APART = "\0"  # between the name of a variable and what tells it from others of that name
_numbers = count()


class Unsaid(CasperError):
    """Something of a problem that the language cannot say."""


@dataclass(frozen=True)
class Test:
    """An expression without connectives, that holds or does not."""

    expression: FNode
    positive: bool = True


@dataclass(frozen=True)
class Every:
    """Whatever the variables are, one of the alternatives holds."""

    variables: tuple[Variable, ...]
    alternatives: tuple[Row, ...]


@dataclass(frozen=True)
class Row:
    """Tests that hold together, for some values of the variables."""

    variables: tuple[Variable, ...] = ()
    tests: tuple[Test | Every, ...] = ()


Rows: TypeAlias = tuple[Row, ...]
_Case: TypeAlias = Callable[[FNode, bool], Rows]


def rows_of(condition: FNode, positive: bool = True) -> Rows:
    """The alternatives that a condition (or its negation) has; none: it never holds.

    Raises:
        Unsaid: there are too many of them, or it speaks of times and paths.
    """
    return tuple(_canonical(row) for row in _rows(condition, positive))


def all_of(conditions: list[FNode]) -> Rows:
    """The alternatives of conditions that hold together."""
    return tuple(_canonical(row) for row in _joined([_rows(each, True) for each in conditions]))


def _rows(condition: FNode, positive: bool) -> Rows:
    case = _CASES.get(condition.node_type)
    if case is not None:
        return case(condition, positive)
    if condition.is_bool_constant():
        return (Row(),) if condition.bool_constant_value() is positive else ()
    return (Row(tests=(Test(condition, positive),)),)


def _both(condition: FNode, positive: bool) -> Rows:
    parts = [_rows(each, positive) for each in condition.args]
    return _joined(parts) if condition.is_and() is positive else _bounded([row for part in parts for row in part])


def _implication(condition: FNode, positive: bool) -> Rows:
    first, then = condition.args
    if positive:
        return _bounded([*_rows(first, False), *_rows(then, True)])
    return _joined([_rows(first, True), _rows(then, False)])


def _equivalence(condition: FNode, positive: bool) -> Rows:
    one, other = condition.args
    same = _joined([_rows(one, True), _rows(other, positive)])
    return _bounded([*same, *_joined([_rows(one, False), _rows(other, not positive)])])


def _quantified(condition: FNode, positive: bool) -> Rows:
    variables, body = _apart(condition)
    inner = _rows(body, positive)
    if condition.is_exists() is positive:
        return tuple(Row((*variables, *row.variables), row.tests) for row in inner)
    if Row() in inner:
        return (Row(),)
    return (Row(tests=(Every(variables, tuple(_canonical(row) for row in inner)),)),)


def _apart(condition: FNode) -> tuple[tuple[Variable, ...], FNode]:
    """The variables of a quantifier under names of their own: two quantifiers may use the same ones."""
    manager = condition.environment.expression_manager
    own = {v: Variable(f"{v.name}{APART}{next(_numbers)}", v.type, v.environment) for v in condition.variables()}
    renaming = {manager.VariableExp(old): manager.VariableExp(new) for old, new in own.items()}
    return tuple(own.values()), condition.arg(0).substitute(renaming)


def _refused(condition: FNode, positive: bool) -> Rows:
    raise Unsaid(f"{condition} is about a course of states; conditions here are about one moment")


def _joined(parts: list[Rows]) -> Rows:
    found = []
    for chosen in product(*parts):
        variables = tuple(variable for row in chosen for variable in row.variables)
        found.append(Row(variables, tuple(dict.fromkeys(test for row in chosen for test in row.tests))))
        _bounded(found)
    return tuple(found)


def _bounded(rows: list[Row]) -> Rows:
    if len(rows) > MOST:
        raise Unsaid(f"a condition has more than {MOST} alternatives; name parts of it with predicates of their own")
    return tuple(rows)


def _canonical(row: Row) -> Row:
    """Tests that share variables stand together, at the first of them; the variables in the same order."""
    own = set(row.variables)
    groups: list[tuple[set[Variable], list[Test | Every]]] = []
    for test in row.tests:
        free = _free(test) & own
        joined = [group for group in groups if free & group[0]]
        if not joined:
            groups.append((free, [test]))
            continue
        first = joined[0]
        for other in joined[1:]:
            first[0].update(other[0])
            first[1].extend(other[1])
            groups.remove(other)
        first[0].update(free)
        first[1].append(test)
    told = [v for names, _ in groups for v in dict.fromkeys(row.variables) if v in names]
    idle = [v for v in dict.fromkeys(row.variables) if v not in told]
    return Row((*idle, *told), tuple(test for _, tests in groups for test in tests))


def _free(test: Test | Every) -> set[Variable]:
    if isinstance(test, Every):
        inner = {v for row in test.alternatives for each in row.tests for v in _free(each) - set(row.variables)}
        return inner - set(test.variables)
    return set(_variables(test.expression))


def _variables(expression: FNode) -> Iterator[Any]:
    if expression.is_variable_exp():
        yield expression.variable()
    for each in expression.args:
        yield from _variables(each)


_CASES: dict[OperatorKind, _Case] = {
    OperatorKind.AND: _both,
    OperatorKind.OR: _both,
    OperatorKind.NOT: lambda condition, positive: _rows(condition.arg(0), not positive),
    OperatorKind.IMPLIES: _implication,
    OperatorKind.IFF: _equivalence,
    OperatorKind.EXISTS: _quantified,
    OperatorKind.FORALL: _quantified,
    OperatorKind.ALWAYS: _refused,
    OperatorKind.SOMETIME: _refused,
    OperatorKind.AT_MOST_ONCE: _refused,
    OperatorKind.SOMETIME_BEFORE: _refused,
    OperatorKind.SOMETIME_AFTER: _refused,
}
