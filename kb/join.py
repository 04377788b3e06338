"""A rule body compiled to nested index lookups: closures over slots of one environment list.

The order of conditions is the optimiser's (bound columns first); reasons never come from here.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TypeAlias

from casper.kb.clauses import Clause, Literal
from casper.kb.comparison import compare, is_ready
from casper.kb.program import Indicator
from casper.kb.relation import Relation, Row
from casper.kb.terms import Compound, Term, Variable, is_ground, variables_of

Environment: TypeAlias = list[Term]
Step: TypeAlias = Callable[[Environment], None]
Slots: TypeAlias = dict[Variable, int]


def compile_join(
    clause: Clause, relations: Mapping[Indicator, Relation], delta_at: int | None, emit: Callable[[Row], None]
) -> Callable[[Iterable[Row]], None]:
    """A function that emits every head row the clause derives.

    With ``delta_at``, that literal ranges over the rows handed to the function instead of its relation; else the
    rows handed over are ignored.
    """
    slots: Slots = {variable: at for at, variable in enumerate(clause.variables())}
    delta: list[Iterable[Row]] = [()]
    ordered = _order(clause.body, delta_at)
    bound: list[set[Variable]] = [set()]
    for literal, _ in ordered:
        bound.append(bound[-1] | _binds(literal, bound[-1]))
    step = _emit_step(clause.head, slots, emit)
    for (literal, at), known in zip(reversed(ordered), reversed(bound[:-1])):
        step = _compile(literal, known, slots, relations, delta if at == delta_at else None, step)

    def evaluate(rows: Iterable[Row]) -> None:
        delta[0] = rows
        step([None] * len(slots))

    return evaluate


def _order(body: tuple[Literal, ...], delta_at: int | None) -> list[tuple[Literal, int]]:
    """Conditions with their positions: the delta first, tests as soon as they are bound, then the most bound."""
    waiting = list(enumerate(body))
    ordered: list[tuple[Literal, int]] = []
    known: set[Variable] = set()
    while waiting:
        at, literal = min(waiting, key=lambda item: _cost(item, known, delta_at))
        waiting.remove((at, literal))
        ordered.append((literal, at))
        known |= _binds(literal, known)
    return ordered


def _cost(item: tuple[int, Literal], known: set[Variable], delta_at: int | None) -> tuple[int, int, int]:
    at, literal = item
    if at == delta_at:
        return (-2, 0, at)
    variables = set(variables_of(literal.atom))
    if literal.is_comparison:
        bindings = {v: 0 for v in known}
        return (-1 if is_ready(literal, bindings) and _decides(literal, known) else 3, 0, at)
    if literal.negated:
        return (-1 if all(v in known or v.is_anonymous for v in variables) else 3, 0, at)
    return (1, -sum(1 for arg in literal.atom.args if set(variables_of(arg)) <= known), at)


def _decides(literal: Literal, known: set[Variable]) -> bool:
    """Whether an ``=`` has at least one side known: before that it would only tie two unknowns together."""
    left, right = set(variables_of(literal.atom[1])), set(variables_of(literal.atom[2]))
    return left <= known or right <= known


def _binds(literal: Literal, known: set[Variable]) -> set[Variable]:
    if literal.negated or (literal.is_comparison and literal.atom[0] not in ("=", "is")):
        return set()
    return set(variables_of(literal.atom))


def _compile(
    literal: Literal,
    known: set[Variable],
    slots: Slots,
    relations: Mapping[Indicator, Relation],
    delta: list[Iterable[Row]] | None,
    then: Step,
) -> Step:
    if literal.is_comparison:
        return _comparison_step(literal, known, slots, then)
    relation = relations[literal.atom.indicator]
    args = literal.atom.args
    columns = tuple(c for c, arg in enumerate(args) if set(variables_of(arg)) <= known)
    key = _row_builder([args[c] for c in columns], slots)
    rest = [(c, arg) for c, arg in enumerate(args) if c not in columns]
    bind = _binder(rest, known, slots)
    if literal.negated:
        return _absence_step(relation, columns, key, bind, then)
    if delta is not None:
        return _delta_step(delta, columns, key, bind, then)

    def lookup(environment: Environment) -> None:
        for row in relation.matching(columns, key(environment)):
            if bind(row, environment):
                then(environment)

    return lookup


def _delta_step(
    delta: list[Iterable[Row]], columns: tuple[int, ...], key: Callable[[Environment], Row], bind: _Bind, then: Step
) -> Step:
    def scan(environment: Environment) -> None:
        wanted = key(environment)
        for row in delta[0]:
            if tuple([row[c] for c in columns]) == wanted and bind(row, environment):
                then(environment)

    return scan


def _absence_step(
    relation: Relation, columns: tuple[int, ...], key: Callable[[Environment], Row], bind: _Bind, then: Step
) -> Step:
    def absent(environment: Environment) -> None:
        if not any(bind(row, environment) for row in relation.matching(columns, key(environment))):
            then(environment)

    return absent


def _comparison_step(literal: Literal, known: set[Variable], slots: Slots, then: Step) -> Step:
    before = [(v, slots[v]) for v in literal.variables() if v in known]
    after = [(v, slots[v]) for v in literal.variables() if v not in known]

    def test(environment: Environment) -> None:
        extended = compare(literal, {v: environment[slot] for v, slot in before})
        if extended is not None:
            for variable, slot in after:
                environment[slot] = extended.get(variable)
            then(environment)

    return test


def _emit_step(head: Compound, slots: Slots, emit: Callable[[Row], None]) -> Step:
    build = _row_builder(list(head.args), slots)
    return lambda environment: emit(build(environment))


def _row_builder(terms: list[Term], slots: Slots) -> Callable[[Environment], Row]:
    """A function from the environment to the row of the terms' values."""
    if all(isinstance(term, Variable) for term in terms):
        at = [slots[term] for term in terms]
        return lambda environment: tuple([environment[slot] for slot in at])
    return lambda environment: tuple([_value(term, environment, slots) for term in terms])


def _value(term: Term, environment: Environment, slots: Slots) -> Term:
    if isinstance(term, Variable):
        return environment[slots[term]]
    if isinstance(term, Compound) and not is_ground(term):
        return Compound([_value(part, environment, slots) for part in term])
    return term


_Bind: TypeAlias = Callable[[Row, Environment], bool]


def _binder(rest: list[tuple[int, Term]], known: set[Variable], slots: Slots) -> _Bind:
    """A function that stores a row's open columns in the environment; False where a repeated variable disagrees."""
    variables = [term for _, term in rest]
    if all(isinstance(term, Variable) for term in variables) and len(set(variables)) == len(variables):
        pairs = [(column, slots[term]) for column, term in rest]

        def store(row: Row, environment: Environment) -> bool:
            for column, slot in pairs:
                environment[slot] = row[column]
            return True

        return store

    def match_all(row: Row, environment: Environment) -> bool:
        assigned = set(known)
        return all(_match(term, row[column], environment, slots, assigned) for column, term in rest)

    return match_all


def _match(term: Term, value: Term, environment: Environment, slots: Slots, assigned: set[Variable]) -> bool:
    """One-way unification of a pattern with a ground value."""
    if isinstance(term, Variable):
        if term in assigned:
            return bool(environment[slots[term]] == value)
        assigned.add(term)
        environment[slots[term]] = value
        return True
    if isinstance(term, Compound):
        same_shape = isinstance(value, Compound) and len(value) == len(term)
        return same_shape and all(_match(t, v, environment, slots, assigned) for t, v in zip(term, value))
    return bool(term == value)
