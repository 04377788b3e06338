"""The top-down solver: SLD resolution over stored relations and clauses, in the author's order.

It answers queries, checks constraints, and rebuilds proofs. Comparisons and negations wait until they are ground.
A solution that rests on something undefined (a row, an evaluation that failed, the negation of such) carries the mark
``DOUBT`` in its substitution: it is no answer, but nothing may be concluded from its absence either.
Every resolution step is counted; a search that outlives its budget raises instead of saying no.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Self, TypeAlias

from casper.kb.errors import BudgetExceeded, ProgramError, Undefined
from casper.kb.relations.relation import Relation
from casper.kb.terms.clauses import Clause, Indicator, Literal
from casper.kb.terms.comparison import compare, is_ready
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, as_term
from casper.kb.terms.unification import Bindings, is_ground, renamed, substitute, unify, variables_of
from casper.kb.terms.unknown import DOUBT, opened
from casper.kb.terms.values.aggregates import aggregate
from casper.kb.terms.values.arithmetic import EvaluationFailed
from casper.kb.top_down.compiled.cells import serials as fresh_numbers
from casper.kb.top_down.compiled.cells import variant

Computed: TypeAlias = Callable[[Compound], Iterator[Compound]]
BETWEEN_LOOKS = 64  # steps between two looks at the clock
DEFAULT_BUDGET = 200_000
DEFAULT_DEPTH = 150  # Python's own stack bounds a chain of rules; deeper is "unknown"


@dataclass
class Solver:
    """One search over what holds now: stored relations, clauses for the rest, and computed predicates such as valid/1.

    ``relations`` may hold the situation (claim/1, did/2) laid over the knowledge base.
    """

    relations: Mapping[Indicator, Relation]
    clauses: Mapping[Indicator, Sequence[Clause]]
    computed: Mapping[Indicator, Computed] = field(default_factory=dict)
    budget: int = DEFAULT_BUDGET
    steps: int = 0
    floundering_fails: bool = False  # in constraints: what some value could still satisfy is not broken
    doubts_hold: bool = False  # whether `accepts` takes doubtful solutions for answers
    deadline: float | None = None  # of time.monotonic()
    cancelled: Callable[[], bool] | None = None  # asked now and then; true stops the search

    def solve(self, body: Sequence[Literal], bindings: Bindings | None = None, depth: int = 0) -> Iterator[Bindings]:
        """Every extension of the bindings under which the whole body holds, lazily.

        Raises:
            BudgetExceeded: the search took more than ``budget`` steps or went too deep.
            ProgramError: a condition was reached whose variables nothing binds.
        """
        return (found for found in self.possible(body, bindings, depth) if DOUBT not in found)

    def accepts(self, found: Bindings) -> bool:
        """Whether a solution counts: not a doubtful one, unless ``doubts_hold``."""
        return self.doubts_hold or DOUBT not in found

    def accepted(self, body: Sequence[Literal], bindings: Bindings) -> Iterator[Bindings]:
        """The solutions that count."""
        return filter(self.accepts, self.possible(body, bindings))

    def possible(self, body: Sequence[Literal], bindings: Bindings | None = None, depth: int = 0) -> Iterator[Bindings]:
        """As `solve`, with the doubtful solutions among the others: those that have a value for ``DOUBT``."""
        try:
            yield from self._solve(body, {} if bindings is None else bindings, depth)
        except RecursionError:
            raise _too_deep(body[0]) from None

    def _solve(self, body: Sequence[Literal], bindings: Bindings, depth: int) -> Iterator[Bindings]:
        if not body:
            yield bindings
            return
        at = self.next_of(body, bindings)
        if at is None:
            if DOUBT in bindings:  # what stands open may be anything, because an evaluation failed
                yield bindings
                return
            if self.floundering_fails:
                return
            raise _floundering(body[0], bindings)
        literal, rest = body[at], [*body[:at], *body[at + 1 :]]
        for extended in self.answers(literal, bindings, depth):
            yield from self._solve(rest, extended, depth)

    def next_of(self, body: Sequence[Literal], bindings: Bindings) -> int | None:
        """Which condition is decided next; None when every one has to wait."""
        return next_ready(body, bindings)

    def plain(self) -> Solver:
        """The same search by resolution alone."""
        return self

    def over(self, relations: Mapping[Indicator, Relation], *, floundering_fails: bool = False) -> Self:
        """The same search over other relations."""
        return replace(self, relations=relations, steps=0, floundering_fails=floundering_fails, doubts_hold=False)

    def answers(self, literal: Literal, bindings: Bindings, depth: int = 0) -> Iterator[Bindings]:
        """Every extension of the bindings under which one ready condition holds, the doubtful among them."""
        self._count(literal, depth)
        if literal.is_comparison:
            try:
                extended = compare(literal, bindings)
            except EvaluationFailed as failure:
                extended = {**bindings, DOUBT: failure.sentence}
            if extended is not None:
                yield extended
        elif literal.is_aggregate:
            yield from self._aggregate(literal, bindings, depth)
        elif literal.negated:
            yield from self._negated(literal, bindings, depth)
        else:
            yield from self._positive(literal, bindings, depth)

    def _negated(self, literal: Literal, bindings: Bindings, depth: int) -> Iterator[Bindings]:
        doubt = bindings.get(DOUBT)
        clean = {v: value for v, value in bindings.items() if v is not DOUBT} if doubt else bindings
        for found in self.answers(Literal(literal.atom), clean, depth + 1):
            if DOUBT not in found:
                return
            doubt = found[DOUBT]
        yield {**bindings, DOUBT: doubt} if doubt else bindings

    def _aggregate(self, literal: Literal, bindings: Bindings, depth: int) -> Iterator[Bindings]:
        what, atom, result = literal.atom.args
        clean = {v: value for v, value in bindings.items() if v is not DOUBT}
        answers: dict[Hashable, Bindings] = {}
        doubts: dict[Hashable, str] = {}
        for found in self.answers(Literal(atom), clean, depth + 1):
            instance = variant(substitute(atom, found).args)
            if DOUBT in found:
                doubts.setdefault(instance, found[DOUBT])
            else:
                answers.setdefault(instance, found)
        doubt = next((reason for instance, reason in doubts.items() if instance not in answers), None)
        try:
            value = aggregate(what, list(answers.values()))
        except EvaluationFailed as failure:
            doubt = doubt or failure.sentence
        if doubt:
            yield {**bindings, DOUBT: bindings.get(DOUBT, doubt)}
        elif value is not None and (extended := unify(result, value, bindings)) is not None:
            yield extended

    def _positive(self, literal: Literal, bindings: Bindings, depth: int) -> Iterator[Bindings]:
        indicator = literal.atom.indicator
        relation = self.relations.get(indicator)
        if relation is not None:
            yield from _lookup(relation, literal.atom, bindings)
            if relation.undefined is not None:
                yield from _doubtful(relation.undefined, literal.atom, bindings)
        elif indicator in self.computed:
            try:
                for answer in self.computed[indicator](substitute(literal.atom, bindings)):
                    extended = unify(answer, literal.atom, bindings)
                    if extended is not None:
                        yield extended
            except Undefined as doubt:
                yield {**bindings, DOUBT: doubt.sentence}
        else:
            for clause in self.clauses.get(indicator, ()):
                head, body = self.fresh(clause)
                extended = unify(head, literal.atom, bindings)  # this way round answers keep the asker's variables
                if extended is not None:
                    yield from self._solve(body, extended, depth + 1)

    def fresh(self, clause: Clause) -> tuple[Compound, list[Literal]]:
        """The clause with variables of its own."""
        number = next(fresh_numbers)
        head, *atoms = renamed([clause.head, *(x.atom for x in clause.body)], number)
        return head, [Literal(atom, x.negated, x.place, _shown(x, number)) for atom, x in zip(atoms, clause.body)]

    def _count(self, literal: Literal, depth: int) -> None:
        self.steps += 1
        if self.steps % BETWEEN_LOOKS == 0:
            self._look_up()
        if self.steps > self.budget or depth > DEFAULT_DEPTH:
            name, arity = literal.atom.indicator
            limit = f"{self.budget} steps" if self.steps > self.budget else f"{DEFAULT_DEPTH} levels of rules"
            raise BudgetExceeded(f"the search for {name}/{arity} stopped after {limit}: the answer is unknown")


    def _look_up(self) -> None:
        """Whether time has run out, or somebody wants the search to stop."""
        if self.deadline is not None and time.monotonic() > self.deadline:
            raise BudgetExceeded("the search stopped when its time was up: the answer is unknown")
        if self.cancelled is not None and self.cancelled():
            raise BudgetExceeded("the search was cancelled: the answer is unknown")


def _shown(literal: Literal, number: int) -> Term | None:
    return None if literal.shown is None else renamed([literal.shown], number)[0]


def next_ready(body: Sequence[Literal], bindings: Bindings) -> int | None:
    """The first condition, in the author's order, that can be decided now; None when every one has to wait."""
    for at, literal in enumerate(body):
        if literal.is_comparison:
            if is_ready(literal, bindings):
                return at
        elif not literal.is_strict or _is_closed(literal, bindings):
            return at
    return None


def _lookup(relation: Relation, atom: Compound, bindings: Bindings) -> Iterator[Bindings]:
    """The rows of a stored relation that the atom can be, through the index of its bound columns."""
    args = [substitute(arg, bindings) for arg in atom.args]
    columns = tuple(at for at, arg in enumerate(args) if is_ground(arg))
    pattern = tuple(args)
    for row in relation.matching(columns, tuple(args[c] for c in columns)):
        extended = unify(Compound(pattern), Compound(row), bindings)
        if extended is not None:
            yield extended


def _doubtful(relation: Relation, atom: Compound, bindings: Bindings) -> Iterator[Bindings]:
    """The undefined rows that the atom can be."""
    args = [substitute(arg, bindings) for arg in atom.args]
    columns = tuple(at for at, arg in enumerate(args) if is_ground(arg))
    for row in relation.matching(columns, tuple(args[c] for c in columns)):
        extended = unify(Compound(args), Compound([opened(value, fresh_numbers) for value in row]), bindings)
        if extended is not None:
            sentence = f"{term_text(as_term(Compound((atom.functor, *row))))} is undefined"
            yield {**extended, DOUBT: sentence}


def _is_closed(literal: Literal, bindings: Bindings) -> bool:
    """Whether only anonymous variables are left open: ``\\+ p(X, _)`` asks that no row begins with X."""
    for variable in variables_of(literal.atom[2]) if literal.is_aggregate else literal.variables():
        value = substitute(variable, bindings)
        # Only the clause's own ``_`` may stay open: an unknown that came from outside may still become known.
        if not (is_ground(value) or (value is variable and variable.is_anonymous)):
            return False
    return True


def _too_deep(literal: Literal) -> BudgetExceeded:
    name, arity = literal.atom.indicator
    return BudgetExceeded(f"the search for {name}/{arity} went too deep: the answer is unknown")


def _floundering(literal: Literal, bindings: Bindings) -> ProgramError:
    from casper.kb.text.writer import literal_text

    instance = literal.instance(bindings)
    [atom] = renamed([instance.atom], 0)  # by the names their author gave the variables
    shown = literal_text(replace(instance, atom=atom))
    place = literal.place if literal.place.line else None
    return ProgramError(f"{shown} cannot be decided: bind its variables by a condition before it", place)
