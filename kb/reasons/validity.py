"""Validity: a statement is valid when it is provable and breaks no constraint when it is claimed (paper III-F).

Unknown parts of a statement are logic variables: it is acceptable when some value makes it valid, and a part for
which only one value does is filled in (what the paper's SWRL rules were for).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TypeAlias

from casper.kb.bottom_up.join import Join
from casper.kb.errors import BudgetExceeded, Undefined
from casper.kb.program.listing import is_range_restricted
from casper.kb.program.program import Program
from casper.kb.reasons.printing import verdict_lines
from casper.kb.reasons.says import SILENT, Words
from casper.kb.reasons.why_not import Refusal, Violation
from casper.kb.relations.relation import Relation
from casper.kb.terms.clauses import SITUATION, SYSTEM, Clause, Indicator, Literal
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, as_term, predication
from casper.kb.terms.unification import Bindings, is_ground, substitute
from casper.kb.terms.unknown import DOUBT
from casper.kb.terms.values.moments import Moment
from casper.kb.text.lines import Line, Shown, one_line, text_of
from casper.kb.top_down.compiled.cells import rigid
from casper.kb.top_down.solve import Solver

History: TypeAlias = Sequence[tuple[Term, float | Moment]]  # what happened earlier: (statement, seconds, if known)
_FILL_LIMIT = 1000  # instances looked at before a part is given up as open
_CLAIM: Indicator = ("claim", 1)


@dataclass(frozen=True, slots=True)
class Verdict(Shown):
    """The outcome of a verification.

    ``valid`` is None when it is undefined or the search ran out of its budget (``remark`` says which). ``completed`` is
    the statement with every part filled in for which only one value is valid; ``refusal`` says why not.
    """

    statement: Compound
    valid: bool | None
    completed: Compound
    refusal: Refusal | None = None
    remark: str = ""
    words: Words = field(default=SILENT, compare=False, repr=False)  # in which it is told

    @property
    def reasons(self) -> tuple[str, ...]:
        """Why the statement is not valid, one sentence each; empty when it is."""
        if self.refusal is not None:
            return self.refusal.reasons
        return (self.remark,) if self.remark else ()

    def lines(self) -> Iterator[Line]:
        """What a person is shown."""
        return verdict_lines(self.statement, self.valid, self.completed, self.reasons, self.words)

    def __str__(self) -> str:
        return text_of(self.lines())

    def __repr__(self) -> str:
        word = "unknown" if self.valid is None else "valid" if self.valid else "not valid"
        return one_line(f"Verdict: {term_text(as_term(self.statement))} is {word}")


@dataclass(frozen=True, slots=True)
class Constraints:
    """The constraints of a program: those the facts alone decide are decided once."""

    always: tuple[Violation, ...]  # those with a doubt may be broken
    by_claim: tuple[tuple[Clause, Join | None], ...] = field(default=())  # compiled, where the rows of all it needs are

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
        candidates = [(clause, join) for clause, join in self.by_claim if _may_concern(clause, claim)]
        if not candidates:
            return
        relations = _Overlay(solver.relations, {_CLAIM: Relation(*_CLAIM, [(rigid(as_term(claim)),)])})
        is_open = not is_ground(claim)
        for clause, join in candidates:
            if join is not None and not is_open and _is_settled(clause, relations):
                failures: list[Bindings] = []
                solution = join.first(relations, failures.append)
                if solution is not None:
                    yield _told(clause, clause.body, solution)
                if solution is not None or not failures:
                    continue
            search = solver.over(relations, floundering_fails=True)
            violation = _violation(clause, search)
            if violation is not None:
                yield violation


def _is_settled(clause: Clause, relations: Mapping[Indicator, Relation]) -> bool:
    """Whether nothing that the constraint needs is undefined."""
    return all(relations[x.needed].undefined is None for x in clause.body if x.needed is not None)


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


def constraints_of(program: Program, solver: Solver) -> Constraints:
    """Sort the constraints: those that need the situation wait for a claim, the others are decided now."""
    by_claim = tuple((c, _compiled(c, program)) for c in program.constraints if _is_situational(c, program))
    static = (c for c in program.constraints if not _is_situational(c, program))
    always = (_violation(clause, solver) for clause in static)
    return Constraints(tuple(v for v in always if v is not None), by_claim)


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


def valid_instances(statement: Compound, solver: Solver, constraints: Constraints) -> Iterator[Compound]:
    """Every valid instance of the statement, lazily.

    Raises:
        Undefined: at the end, when it is undefined of some other instance whether it is valid.
    """
    seen: set[Compound] = set()
    doubts: dict[Compound, str] = {}
    for solution in solver.possible([Literal(statement)]):
        instance: Compound = substitute(statement, solution)
        if instance in seen:
            continue
        if DOUBT not in solution:
            seen.add(instance)
        try:
            broken = next(constraints.broken_by(instance, solver), None) is not None
        except Undefined as doubt:
            doubts.setdefault(instance, doubt.sentence)
            continue
        if DOUBT in solution and not broken:
            doubts.setdefault(instance, str(solution[DOUBT]))
        elif not broken:
            doubts.pop(instance, None)
            yield instance
        else:
            doubts.pop(instance, None)
    if doubts:
        raise Undefined(next(iter(doubts.values())))


def verify(statement: Compound, solver: Solver, constraints: Constraints) -> Verdict:
    """Judge one statement; an invalid one comes back without its refusal, which `KnowledgeBase.verify` adds.

    Unknown is not no: a search that outlives its budget before it finds a valid instance gives ``valid=None``, and so
    does a statement that is undefined.
    """
    completed: Compound | None = None
    try:
        for number, instance in enumerate(valid_instances(statement, solver, constraints)):
            completed = instance if completed is None else _agreement(statement, completed, instance)
            if completed == statement or number >= _FILL_LIMIT:
                completed = statement
                break
    except (BudgetExceeded, Undefined) as mistake:
        if completed is not None:  # one value does; whether another would too is what the search did not tell
            return Verdict(statement, True, statement)
        return Verdict(statement, None, statement, None, mistake.sentence)
    if completed is None:
        return Verdict(statement, False, statement)
    return Verdict(statement, True, completed)


def _agreement(statement: Term, left: Term, right: Term) -> Term:
    """What two instances agree on, with the statement's own unknown parts where they do not."""
    if left == right:
        return left
    if isinstance(statement, Compound) and isinstance(left, Compound) and isinstance(right, Compound):
        return Compound([_agreement(s, a, b) for s, a, b in zip(statement, left, right)])
    return statement
