"""Why something holds: a proof rebuilt on demand from the rounds of the fixpoint, no bodies stored."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

from casper.kb.reasons.proof import Proof
from casper.kb.relations.relation import Columns, Relation, Row
from casper.kb.terms.builtins import BUILTINS
from casper.kb.terms.clauses import Clause, Indicator, Literal
from casper.kb.terms.terms import Compound, predication
from casper.kb.terms.unification import substitute, unify
from casper.kb.top_down.search import Search

Given: TypeAlias = Mapping[Indicator, Mapping[Row, Clause | None]]  # base facts, with the clause behind each


@dataclass(frozen=True, slots=True)
class _Earlier:
    """A relation as it stood before a round: premises looked up here can never lean on what they prove."""

    relation: Relation
    round: int

    def matching(self, columns: Columns, key: Row) -> Sequence[Row]:
        round_of, before = self.relation.round_of, self.round
        return [row for row in self.relation.matching(columns, key) if round_of(row) < before]

    def __contains__(self, row: object) -> bool:
        return row in self.relation and self.relation.round_of(row) < self.round  # type: ignore[arg-type]


def prove(
    atom: Compound, relations: Mapping[Indicator, Relation], solver: Search, given: Given
) -> Proof | None:
    """A proof of a ground atom, its rules tried in the author's order; None when there is none.

    Premises of a stored row come from rounds before its own, so the proof is well-founded even through recursion.

    Raises:
        BudgetExceeded: the search outlived the solver's budget.
    """
    relation = relations.get(atom.indicator)
    if relation is not None:
        return _stored_proof(atom, relations, solver, given) if atom.args in relation else None
    if atom.indicator in solver.computed:
        return _computed_proof(atom, solver, relations, given)
    if atom.indicator in BUILTINS and atom.indicator not in solver.clauses:
        holds = next(solver.solve([Literal(atom)]), None) is not None
        return Proof(Literal(atom), None, (), "computed") if holds else None
    for clause in solver.clauses.get(atom.indicator, ()):
        if not clause.body and unify(clause.head, atom, {}) is not None:
            return Proof(Literal(atom), clause)
    for clause in solver.clauses.get(atom.indicator, ()):
        for body in _instances(atom, clause, solver) if clause.body else ():
            proofs = [p for p in (_literal_proof(x, relations, solver, given) for x in body) if p is not None]
            if len(proofs) == len(body):
                return Proof(Literal(atom), clause, tuple(proofs))
    return None


def _stored_proof(
    goal: Compound, relations: Mapping[Indicator, Relation], solver: Search, given: Given
) -> Proof:
    """The proof of a stored row, premises first: a loop, because a chain of rules may be longer than Python's stack."""
    steps: dict[Compound, tuple[Clause, tuple[Literal, ...]]] = {}
    proofs: dict[Compound, Proof] = {}  # each row is proved once, however often it is used
    waiting = [goal]
    while waiting:
        atom = waiting[-1]
        if atom not in steps:
            steps[atom] = _step(atom, relations, solver, given)
        clause, body = steps[atom]
        missing = [x.atom for x in body if _is_derived(x) and x.atom not in proofs]
        if missing:
            waiting.extend(reversed(missing))
        else:
            premises = tuple(proofs[x.atom] if _is_derived(x) else Proof(x) for x in body)
            proofs[atom] = Proof(Literal(atom), clause, premises)
            waiting.pop()
    return proofs[goal]


def _step(
    atom: Compound, relations: Mapping[Indicator, Relation], solver: Search, given: Given
) -> tuple[Clause, tuple[Literal, ...]]:
    """The fact or the first rule behind a stored row, with the instance of its body that gives it."""
    facts = given.get(atom.indicator, {})
    if atom.args in facts:
        return facts[atom.args] or Clause(atom), ()
    round_ = relations[atom.indicator].round_of(atom.args)
    for clause in solver.clauses[atom.indicator]:
        needed = {x.atom.indicator for x in clause.body if not x.is_comparison}
        earlier: dict[Indicator, Relation] = {i: _Earlier(relations[i], round_) for i in needed}  # type: ignore[misc]
        search = replace(solver, relations=earlier, steps=0)
        body = next(_instances(atom, clause, search), None) if clause.body else None
        if body is not None:
            return clause, body
    raise AssertionError("every row was derived by a clause from earlier rows")


def _instances(atom: Compound, clause: Clause, search: Search) -> Iterator[tuple[Literal, ...]]:
    """The instances of the clause's body that hold and give the atom."""
    head, body = search.fresh(clause)
    bindings = unify(head, atom, {})
    if bindings is not None:
        for solution in search.solve(body, bindings):
            yield tuple(Literal(substitute(x.atom, solution), x.negated) for x in body)


def _is_derived(literal: Literal) -> bool:
    """Whether a condition has a proof of its own; a comparison or an absence is its own."""
    return not (literal.is_comparison or literal.negated)


def _literal_proof(
    literal: Literal, relations: Mapping[Indicator, Relation], solver: Search, given: Given
) -> Proof | None:
    return prove(literal.atom, relations, solver, given) if _is_derived(literal) else Proof(literal)


def _computed_proof(
    atom: Compound, solver: Search, relations: Mapping[Indicator, Relation], given: Given
) -> Proof | None:
    """valid(S) rests on the proof of S, and on no constraint being broken; never(S) on the facts as they are."""
    if next(solver.computed[atom.indicator](atom), None) is None:
        return None
    if atom.functor == "never":
        return Proof(Literal(atom), None, (), "the facts break this constraint")
    inner = prove(predication(atom[1]), relations, solver, given)
    return None if inner is None else Proof(Literal(atom), None, (inner,), "no constraint is broken")
