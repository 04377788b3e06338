"""A rule body compiled to nested index lookups: closures over slots of one environment list.

A `Join` is compiled once and run on any relations that have its predicates. The order of conditions is the
optimiser's (bound columns first); reasons never come from here.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Set

from casper.kb.bottom_up.steps import (
    CONTEXT,
    Binder,
    Emit,
    Environment,
    Failed,
    Slots,
    Step,
    aggregate_step,
    comparison_step,
    row_builder,
)
from casper.kb.relations.relation import Relation, Row
from casper.kb.relations.undefined import Possible
from casper.kb.terms.clauses import Clause, Indicator, Literal
from casper.kb.terms.comparison import is_ready
from casper.kb.terms.terms import Term, Variable
from casper.kb.terms.unification import Bindings, substitute, variables_of

NOBODY: frozenset[Variable] = frozenset()


class Join:
    """A compiled rule.

    Args:
        clause: the rule.
        delta_at: the number of the condition that ranges over given rows instead of its relation; a negated one is
            then also tested, since that a row came or went does not settle what a wildcard asks.
        bound_head: whether the head's variables are known from the start (`derives`).
        negations: False leaves every negated condition out (an over-approximation).
    """

    def __init__(
        self, clause: Clause, delta_at: int | None = None, *, bound_head: bool = False, negations: bool = True
    ) -> None:
        self.clause = clause
        self._slots: Slots = {variable: slot for slot, variable in enumerate(clause.variables(), CONTEXT)}
        known = set(variables_of(clause.head)) if bound_head else set()
        body = [
            (x, at, at == delta_at)
            for x, at in ordered_body(clause.body, delta_at, known)
            if negations or not x.is_strict or at == delta_at
        ]
        tested = [_apart(x) for x, _, is_delta in body if is_delta and x.negated and negations]
        for variable in (v for x in tested for v in x.variables()):
            self._slots.setdefault(variable, CONTEXT + len(self._slots))
        head = clause.head.args if bound_head else ()
        self._head = Binder(list(enumerate(head)), NOBODY, self._slots)
        self._step = self._compiled([*body, *((x, -1, False) for x in tested)], known)

    def _compiled(self, body: list[tuple[Literal, int, bool]], known: set[Variable]) -> Step:
        bound = [set(known)]
        for literal, _, is_delta in body[:-1]:
            bound.append(bound[-1] | (set(variables_of(literal.atom)) if is_delta else literal.binds()))
        step = self._emit_step()
        for (literal, _, is_delta), before in zip(reversed(body), reversed(bound)):
            step = self._condition(literal, before, is_delta, step)
        return step

    def run(
        self,
        relations: Mapping[Indicator, Relation],
        rows: Iterable[Row],
        emit: Emit,
        absent: Mapping[Indicator, Relation] | None = None,
        failed: Failed | None = None,
    ) -> None:
        """Emit every head row that the rule derives; the delta condition ranges over ``rows``.

        Args:
            relations: where conditions are looked up.
            absent: where negated ones are; the same when it is None.
            failed: called with what is known of the rule's variables where an evaluation fails.
        """
        absent = relations if absent is None else absent
        self._step([relations, rows, emit, absent, failed, *[None] * len(self._slots)])

    def first(
        self, relations: Mapping[Indicator, Relation], failed: Failed | None = None
    ) -> dict[Variable, Term] | None:
        """One solution of the body, or None when there is none; negations see undefined rows as possible."""
        context = relations, (), _stop, Possible(relations), failed
        environment: Environment = [*context, *[None] * len(self._slots)]
        try:
            self._step(environment)
        except _Found:
            inner = {v for x in self.clause.body if x.is_strict for v in x.variables() if v.is_anonymous}
            return {v: environment[slot] for v, slot in self._slots.items() if v not in inner}
        return None

    def derives(self, relations: Mapping[Indicator, Relation], row: Row, failed: Failed | None = None) -> bool:
        """Whether the rule derives this head row (the join was compiled with ``bound_head``)."""
        environment: Environment = [relations, (), _stop, relations, failed, *[None] * len(self._slots)]
        if not self._head(row, environment):
            return False
        try:
            self._step(environment)
        except _Found:
            return True
        return False

    def _emit_step(self) -> Step:
        build = row_builder(list(self.clause.head.args), self._slots)

        def emit(environment: Environment) -> None:
            environment[2](build(environment))

        return emit

    def _condition(self, literal: Literal, known: Set[Variable], is_delta: bool, then: Step) -> Step:
        if literal.is_comparison:
            return comparison_step(literal, known, self._slots, then)
        if literal.is_aggregate:
            return aggregate_step(literal, known, self._slots, then)
        indicator, args = literal.atom.indicator, literal.atom.args
        columns = tuple([c for c, arg in enumerate(args) if _is_known(arg, known)])
        key = row_builder([args[c] for c in columns], self._slots)
        bind = Binder([(c, arg) for c, arg in enumerate(args) if c not in columns], known, self._slots)

        def lookup(environment: Environment) -> None:
            for row in environment[0][indicator].matching(columns, key(environment)):
                if bind(row, environment):
                    then(environment)

        def scan(environment: Environment) -> None:
            wanted = key(environment)
            for row in environment[1]:
                if tuple([row[c] for c in columns]) == wanted and bind(row, environment):
                    then(environment)

        def absent(environment: Environment) -> None:
            if not any(bind(row, environment) for row in environment[3][indicator].matching(columns, key(environment))):
                then(environment)

        return scan if is_delta else absent if literal.negated else lookup


def _is_known(term: Term, known: Set[Variable]) -> bool:
    """Whether a term has no variables but known ones."""
    return term in known if type(term) is Variable else all(v in known for v in variables_of(term))


def _apart(literal: Literal) -> Literal:
    """A negated condition with its wildcards open again, for the row that came or went has bound them."""
    fresh: Bindings = {v: Variable(f"{v.name}again") for v in literal.variables() if v.is_anonymous}
    return Literal(substitute(literal.atom, fresh), True, literal.place)


class _Found(Exception):
    """Raised to leave a join as soon as one solution is found."""


def _stop(row: Row) -> None:
    raise _Found


def ordered_body(
    body: tuple[Literal, ...], delta_at: int | None, known: Set[Variable] = NOBODY
) -> list[tuple[Literal, int]]:
    """Conditions with their positions: the delta first, tests as soon as they are bound, then the most bound."""
    if len(body) == 1:
        return [(body[0], 0)]
    waiting = list(enumerate(body))
    ordered: list[tuple[Literal, int]] = []
    bound = set(known)
    while waiting:
        at, literal = min(waiting, key=lambda item: _cost(item, bound, delta_at))
        waiting.remove((at, literal))
        ordered.append((literal, at))
        bound |= set(variables_of(literal.atom)) if at == delta_at else literal.binds()
    return ordered


def _cost(item: tuple[int, Literal], known: set[Variable], delta_at: int | None) -> tuple[int, int, int]:
    at, literal = item
    if at == delta_at:
        return (-2, 0, at)
    if literal.is_comparison:
        bindings = {v: 0 for v in known}
        return (-1 if is_ready(literal, bindings) and _decides(literal, known) else 3, 0, at)
    if literal.is_strict:
        return (-1 if known.issuperset(literal.strict_variables()) else 3, 0, at)
    return (1, -sum(1 for arg in literal.atom.args if set(variables_of(arg)) <= known), at)


def _decides(literal: Literal, known: set[Variable]) -> bool:
    """Whether an ``=`` has at least one side known: before that it would only tie two unknowns together."""
    left, right = set(variables_of(literal.atom[1])), set(variables_of(literal.atom[2]))
    return left <= known or right <= known
