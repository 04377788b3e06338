"""The constraints of a program: what the facts alone break is decided once, the rest waits for a claim.

A constraint is compiled to a join where the rows of all it needs are there, once for a program however often its facts
change; else it is searched for.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeAlias

from casper.kb.bottom_up.join import Join
from casper.kb.errors import Undefined
from casper.kb.program.listing import is_range_restricted
from casper.kb.program.program import Program
from casper.kb.reasons.why_not import Violation
from casper.kb.relations.relation import Relation
from casper.kb.terms.clauses import SITUATION, SYSTEM, Clause, Indicator, Literal
from casper.kb.terms.terms import Compound, Term, as_term, predication
from casper.kb.terms.unification import Bindings, is_ground
from casper.kb.terms.unknown import DOUBT
from casper.kb.terms.values.moments import Moment
from casper.kb.top_down.compiled.cells import rigid
from casper.kb.top_down.solve import Solver

History: TypeAlias = Sequence[tuple[Term, float | Moment]]  # what happened earlier: (statement, seconds, if known)
_CLAIM: Indicator = ("claim", 1)


@dataclass(frozen=True, slots=True)
class Constraints:
    """The constraints of a program: those the facts alone decide are decided once."""

    always: tuple[Violation, ...]  # those with a doubt may be broken
    by_claim: Sequence[CompiledConstraint] = ()

    def broken_by(self, claim: Compound, solver: Solver) -> Iterator[Violation]:
        """Every constraint that is broken when the statement is claimed; the solver knows what was done before.

        Raises:
            Undefined: at the end, when it is undefined of some constraint whether it is broken.
        """
        doubt = ""
        for violation in self.judged(claim, solver):
            if violation.doubt:
                doubt = doubt or str(violation)
            else:
                yield violation
        if doubt:
            raise Undefined(doubt)

    def judged(self, claim: Compound, solver: Solver) -> Iterator[Violation]:
        """The constraints that are broken, and (with a ``doubt``) those that may be."""
        yield from self.always
        candidates = [each for each in self.by_claim if _may_concern(each.clause, claim)]
        if not candidates:
            return
        relations = _Overlay(solver.relations, {_CLAIM: Relation(*_CLAIM, [(rigid(as_term(claim)),)])})
        is_open = not is_ground(claim)
        for each in candidates:
            solution = None if is_open else each.first(relations)
            if isinstance(solution, dict):
                yield _told(each.clause, each.clause.body, solution)
            elif is_open or solution is None:
                violation = _violation(each.clause, solver.over(relations, floundering_fails=True))
                if violation is not None:
                    yield violation


def with_history(relations: Mapping[Indicator, Relation], history: History) -> Mapping[Indicator, Relation]:
    """The relations with did/2 laid over them: rules and constraints see what happened earlier."""
    if not history:
        return relations
    rows = [(as_term(predication(statement)), seconds) for statement, seconds in history]
    return _Overlay(relations, {("did", 2): Relation("did", 2, rows)})


class _Overlay(dict[Indicator, Relation]):
    """A few relations laid over the stored ones, which are not copied."""

    def __init__(self, below: Mapping[Indicator, Relation], above: Mapping[Indicator, Relation]) -> None:
        super().__init__(above)
        self.below = below

    def get(self, key: Indicator, default: object = None) -> Relation | None:  # type: ignore[override]
        found = super().get(key)
        return self.below.get(key) if found is None else found

    def __missing__(self, key: Indicator) -> Relation:
        found = self.below.get(key)
        return _NOTHING_DONE if found is None else found


_NOTHING_DONE = Relation("did", 2)


class CompiledConstraint:
    """A constraint, and its join where the rows of all it needs are there."""

    __slots__ = ("clause", "join", "needed")

    def __init__(self, clause: Clause, program: Program) -> None:
        self.clause, self.join = clause, _compiled(clause, program)
        self.needed = tuple({x.needed: None for x in clause.body if x.needed is not None})

    def first(self, relations: Mapping[Indicator, Relation]) -> Bindings | bool | None:
        """The first way it is broken, False when there is none; None: only a search can tell."""
        if self.join is None or any(relations[needed].undefined is not None for needed in self.needed):
            return None
        failures: list[Bindings] = []
        solution = self.join.first(relations, failures.append)
        return solution if solution is not None else None if failures else False


class ConstraintCode:
    """The constraints of a program, sorted and compiled once, however often the facts change.

    Those that need the situation wait for a claim, the others are decided by the facts.
    """

    def __init__(self, program: Program) -> None:
        self.program = program

    @cached_property
    def by_claim(self) -> tuple[CompiledConstraint, ...]:
        """The constraints on claims."""
        return self._those(True)

    @cached_property
    def static(self) -> tuple[CompiledConstraint, ...]:
        """The constraints on facts."""
        return self._those(False)

    def _those(self, situational: bool) -> tuple[CompiledConstraint, ...]:
        chosen = (c for c in self.program.constraints if _is_situational(c, self.program) is situational)
        return tuple(CompiledConstraint(clause, self.program) for clause in chosen)

    def decided(self, solver: Solver) -> Constraints:
        """With those on facts decided as the facts are now.

        Where a join finds nothing there is nothing; what breaks a constraint is told as the search finds it.
        """
        broken = (c.clause for c in self.static if c.first(solver.relations) is not False)
        always = (_violation(clause, solver) for clause in broken)
        return Constraints(tuple(v for v in always if v is not None), self.by_claim)


def _is_situational(clause: Clause, program: Program) -> bool:
    needed = {x.needed for x in clause.body}
    return not needed.isdisjoint(program.situational | set(SYSTEM))


def _compiled(clause: Clause, program: Program) -> Join | None:
    """The constraint as a join, where every predicate it needs is stored or the situation itself."""
    listed = {*SITUATION, *(indicator for stratum in program.strata for indicator in stratum)}
    needed = {x.needed for x in clause.body if x.needed is not None}
    return Join(clause) if needed <= listed and is_range_restricted(clause) else None


def _may_concern(clause: Clause, claim: Compound) -> bool:
    """A quick look: a constraint on a claim of another name or arity cannot be broken by this one."""
    for literal in clause.body:
        pattern = literal.atom[1] if literal.atom.indicator == _CLAIM and not literal.negated else None
        if isinstance(pattern, (str, Compound)) and predication(pattern).indicator != claim.indicator:
            return False
    return True


def _violation(clause: Clause, solver: Solver) -> Violation | None:
    """The first way the constraint is broken for every value of the claim's open parts, or may be; or None."""
    _, body = solver.fresh(clause)
    doubtful: Violation | None = None
    for solution in solver.possible(body):
        if DOUBT not in solution:
            return _told(clause, body, solution)
        doubtful = doubtful or replace(_told(clause, body, solution), doubt=str(solution[DOUBT]))
    return doubtful


def _told(clause: Clause, body: Sequence[Literal], solution: Bindings) -> Violation:
    """A violation with the instance of the constraint's body that clashes."""
    return Violation(str(clause.head[1]), clause, tuple(x.instance(solution) for x in body))
