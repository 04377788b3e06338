"""The steps of a compiled rule body that look nothing up, and how rows are built from and bound to an environment."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Set
from typing import Any, TypeAlias

from casper.kb.relations.relation import Row
from casper.kb.terms.clauses import Literal
from casper.kb.terms.comparison import compare, compiled_test
from casper.kb.terms.terms import Compound, Term, Variable
from casper.kb.terms.unification import Bindings, is_ground, substitute, unify, variables_of
from casper.kb.terms.unknown import UNKNOWN, may_equal
from casper.kb.terms.values.aggregates import aggregate, of_values
from casper.kb.terms.values.arithmetic import EvaluationFailed, compiled
from casper.kb.terms.values.sizes import check_large

Environment: TypeAlias = list[Any]  # relations, delta rows, emit, absent, failed; then a value for each slot
CONTEXT = 5  # entries before the first slot: a join keeps nothing of a run, since several threads may run it
Step: TypeAlias = Callable[[Environment], None]
Slots: TypeAlias = dict[Variable, int]
Emit: TypeAlias = Callable[[Row], None]
Failed: TypeAlias = Callable[[Bindings], None]


def comparison_step(literal: Literal, known: Set[Variable], slots: Slots, then: Step) -> Step:
    """A comparison: tested, or a variable bound; where it has no value, whoever wants to know is told."""
    before = [(v, slots[v]) for v in literal.variables() if v in known]
    after = [(v, slots[v]) for v in literal.variables() if v not in known]
    everything = [(v, slots[v]) for v in known if v in slots]

    def fails(environment: Environment) -> None:
        if environment[4] is not None:
            environment[4]({v: environment[slot] for v, slot in everything})

    if literal.atom[0] == "is" and not literal.negated and [v for v, _ in after] == [literal.atom[1]]:
        return _value_step(compiled(literal.atom[2], slots), after[0][1], fails, then)
    holds = compiled_test(literal, slots)
    if holds is not None and not after:
        return _test_step(holds, fails, then)

    def test(environment: Environment) -> None:
        try:
            extended = compare(literal, {v: environment[slot] for v, slot in before})
        except EvaluationFailed:
            fails(environment)
            return
        if extended is not None:
            for variable, slot in after:
                environment[slot] = made = substitute(variable, extended)  # Z = f(X): with X as it is here
                if type(made) is Compound:
                    check_large(made)
            then(environment)

    return test


def _value_step(value: Callable[[Environment], Term], slot: int, fails: Step, then: Step) -> Step:
    """A variable gets the value of an expression."""

    def assign(environment: Environment) -> None:
        try:
            environment[slot] = value(environment)
        except EvaluationFailed:
            fails(environment)
            return
        then(environment)

    return assign


def _test_step(holds: Callable[[Environment], bool], fails: Step, then: Step) -> Step:
    """Two expressions are compared."""

    def test(environment: Environment) -> None:
        try:
            found = holds(environment)
        except EvaluationFailed:
            fails(environment)
            return
        if found:
            then(environment)

    return test


def aggregate_step(literal: Literal, known: Set[Variable], slots: Slots, then: Step) -> Step:
    """An aggregate, worked out of the rows that the known columns leave; undefined ones leave it undefined."""
    what, atom, result = literal.atom.args
    columns = tuple(c for c, arg in enumerate(atom.args) if set(variables_of(arg)) <= known)
    key = row_builder([atom.args[c] for c in columns], slots)
    rest = [(c, arg) for c, arg in enumerate(atom.args) if c not in columns]
    bind = Binder(rest, known, slots)
    own = [(v, slots[v]) for v in variables_of(*(arg for _, arg in rest))]
    given = [(v, slots[v]) for v in literal.variables() if v in known]
    after = [(v, slots[v]) for v in variables_of(result) if v not in known]
    everything = [(v, slots[v]) for v in known if v in slots]
    of_rows = _of_rows(what, rest) if bind.pairs is not None else None

    def answers(rows: Iterable[Row], bindings: Bindings, environment: Environment) -> list[Bindings]:
        return [{**bindings, **{v: environment[slot] for v, slot in own}} for row in rows if bind(row, environment)]

    def work_out(environment: Environment) -> None:
        relation, wanted = environment[0][atom.indicator], key(environment)
        if relation.undefined is not None and relation.undefined.matching(columns, wanted):
            return
        bindings = {v: environment[slot] for v, slot in given}
        rows = relation.matching(columns, wanted)
        try:
            value = of_rows(rows) if of_rows is not None else aggregate(what, answers(rows, bindings, environment))
        except EvaluationFailed:
            if environment[4] is not None:
                environment[4]({v: environment[slot] for v, slot in everything})
            return
        extended = None if value is None else unify(result, value, bindings)
        if extended is not None:
            for variable, slot in after:
                environment[slot] = substitute(variable, extended)
            then(environment)

    return work_out


def _of_rows(what: Term, rest: list[tuple[int, Term]]) -> Callable[[Collection[Row]], Term | None] | None:
    """What rows amount to whose open columns are different variables; None where that is more than one column tells."""
    if what == "count":
        return len
    if not isinstance(what, Compound) or what.arity != 1:
        return None
    way, column = what.functor, next((c for c, variable in rest if variable == what[1]), None)
    return None if column is None else lambda rows: of_values(way, [row[column] for row in rows])


def row_builder(terms: list[Term], slots: Slots) -> Callable[[Environment], Row]:
    """A function from the environment to the row of the terms' values."""
    if all(isinstance(term, Variable) for term in terms):
        at = [slots[term] for term in terms]
        if len(at) == 1:
            only = at[0]
            return lambda environment: (environment[only],)
        if len(at) == 2:
            first, second = at
            return lambda environment: (environment[first], environment[second])
        return lambda environment: tuple([environment[slot] for slot in at])
    made = [at for at, term in enumerate(terms) if isinstance(term, Compound) and not is_ground(term)]

    def build(environment: Environment) -> Row:
        row = tuple([_value(term, environment, slots) for term in terms])
        for at in made:
            check_large(row[at])
        return row

    return build


def _value(term: Term, environment: Environment, slots: Slots) -> Term:
    if isinstance(term, Variable):
        return environment[slots[term]]
    if isinstance(term, Compound) and not is_ground(term):
        return Compound([_value(part, environment, slots) for part in term])
    return term


class Binder:
    """Stores a row's open columns in the environment; False where a constant or a repeated variable disagrees."""

    __slots__ = ("known", "pairs", "rest", "slots")

    def __init__(self, rest: list[tuple[int, Term]], known: Set[Variable], slots: Slots) -> None:
        self.rest, self.known, self.slots = rest, known, slots
        variables = [term for _, term in rest]
        simple = all(isinstance(term, Variable) for term in variables) and len(set(variables)) == len(variables)
        self.pairs = [(column, slots[term]) for column, term in rest] if simple else None

    def __call__(self, row: Row, environment: Environment) -> bool:
        if self.pairs is not None:
            for column, slot in self.pairs:
                environment[slot] = row[column]
            return True
        assigned = set(self.known)
        return all(_match(term, row[column], environment, self.slots, assigned) for column, term in self.rest)


def _match(term: Term, value: Term, environment: Environment, slots: Slots, assigned: set[Variable]) -> bool:
    """One-way unification of a pattern with a ground value."""
    if value is UNKNOWN:
        return True  # only a negation looks at undefined rows here: it must not hold for certain
    if isinstance(term, Variable):
        if term in assigned:
            return bool(environment[slots[term]] == value) or may_equal(environment[slots[term]], value)
        assigned.add(term)
        environment[slots[term]] = value
        return True
    if isinstance(term, Compound):
        same_shape = isinstance(value, Compound) and len(value) == len(term)
        return same_shape and all(_match(t, v, environment, slots, assigned) for t, v in zip(term, value))
    return bool(term == value)
