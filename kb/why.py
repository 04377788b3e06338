"""Why something holds: a proof rebuilt on demand from the rounds of the fixpoint, no bodies stored."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from casper.kb.clauses import Clause, Literal
from casper.kb.program import Indicator
from casper.kb.proof import Proof
from casper.kb.relation import Columns, Relation, Row
from casper.kb.solve import Solver
from casper.kb.terms import Compound, substitute, unify


@dataclass(frozen=True, slots=True)
class _Earlier:
    """A relation as it stood before a round: premises looked up here can never lean on what they prove."""

    relation: Relation
    round: int

    def matching(self, columns: Columns, key: Row) -> Sequence[Row]:
        rounds = self.relation.rows
        return [row for row in self.relation.matching(columns, key) if rounds[row] < self.round]


def prove(atom: Compound, relations: Mapping[Indicator, Relation], solver: Solver) -> Proof | None:
    """A proof of a ground atom, its rules tried in the author's order; None when there is none.

    Premises of a stored row come from rounds before its own, so the proof is well-founded even through recursion.

    Raises:
        BudgetExceeded: the search outlived the solver's budget.
    """
    relation = relations.get(atom.indicator)
    if relation is not None and atom.args not in relation.rows:
        return None
    if relation is None and atom.indicator in solver.computed:
        return _computed_proof(atom, solver, relations)
    for clause in solver.clauses.get(atom.indicator, ()):
        if not clause.body and unify(clause.head, atom, {}) is not None:
            return Proof(Literal(atom), clause)
    for clause in solver.clauses.get(atom.indicator, ()):
        premises = _premises(atom, clause, relation, relations, solver) if clause.body else None
        if premises is not None:
            return Proof(Literal(atom), clause, premises)
    if relation is not None:  # a row of the situation: claim/1 or did/2
        return Proof(Literal(atom), None, (), "observed")
    return None


def _premises(
    atom: Compound,
    clause: Clause,
    relation: Relation | None,
    relations: Mapping[Indicator, Relation],
    solver: Solver,
) -> tuple[Proof, ...] | None:
    """The proofs of the clause's body that give the atom, or None where the clause does not give it."""
    search = solver
    if relation is not None:
        round_ = relation.rows[atom.args]
        earlier: Mapping[Indicator, Relation] = {i: _Earlier(r, round_) for i, r in relations.items()}  # type: ignore[misc]
        search = Solver(earlier, solver.clauses, solver.computed, solver.budget)
    head, body = search.fresh(clause)
    bindings = unify(head, atom, {})
    if bindings is None:
        return None
    for solution in search.solve(body, bindings):
        proofs = [_literal_proof(literal, solution, relations, solver) for literal in body]
        if all(proof is not None for proof in proofs):
            return tuple(proof for proof in proofs if proof is not None)
    return None


def _literal_proof(
    literal: Literal, solution: dict, relations: Mapping[Indicator, Relation], solver: Solver  # type: ignore[type-arg]
) -> Proof | None:
    atom = substitute(literal.atom, solution)
    if literal.is_comparison or literal.negated:
        return Proof(Literal(atom, literal.negated))
    return prove(atom, relations, solver)


def _computed_proof(atom: Compound, solver: Solver, relations: Mapping[Indicator, Relation]) -> Proof | None:
    """valid(S): the proof of S, and that no constraint is broken when it is claimed."""
    if next(solver.computed[atom.indicator](atom), None) is None:
        return None
    from casper.kb.terms import predication

    inner = prove(predication(atom[1]), relations, solver)
    return None if inner is None else Proof(Literal(atom), None, (inner,), "no constraint is broken")
