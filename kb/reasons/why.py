"""Why something holds: a proof rebuilt on demand from the rounds of the fixpoint, no bodies stored."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from casper.kb.reasons.counting import counted
from casper.kb.reasons.premises import NotLookedUp, Premises
from casper.kb.reasons.proof import Proof
from casper.kb.relations.relation import Columns, Relation, Row
from casper.kb.terms.builtins import BUILTINS
from casper.kb.terms.clauses import Clause, Indicator, Literal
from casper.kb.terms.origins import Origin, clause_behind
from casper.kb.terms.terms import Compound, predication
from casper.kb.terms.unification import unify
from casper.kb.top_down.linking import Rows
from casper.kb.top_down.solve import Solver

Given: TypeAlias = Mapping[Indicator, Mapping[Row, Origin]]  # base facts, with the clause behind each


@dataclass(frozen=True, slots=True)
class _Earlier:
    """A relation as it stood before a round: premises looked up here can never lean on what they prove."""

    relation: Relation
    round: int

    @property
    def undefined(self) -> Relation | None:
        """The undefined rows: they have no round."""
        return self.relation.undefined

    def matching(self, columns: Columns, key: Row) -> Sequence[Row]:
        round_of, before = self.relation.round_of, self.round
        return [row for row in self.relation.matching(columns, key) if round_of(row) < before]

    def __contains__(self, row: object) -> bool:
        return row in self.relation and self.relation.round_of(row) < self.round  # type: ignore[arg-type]


@dataclass(frozen=True, slots=True)
class _Known:
    """What proofs are built from."""

    relations: Mapping[Indicator, Relation]
    solver: Solver
    given: Given
    strata: Sequence[frozenset[Indicator]]

    def stratum_of(self, indicator: Indicator) -> frozenset[Indicator]:
        """The stratum of a stored predicate: only within it can a row lean on itself."""
        return next((stratum for stratum in self.strata if indicator in stratum), frozenset({indicator}))


def prove(
    atom: Compound,
    relations: Mapping[Indicator, Relation],
    solver: Solver,
    given: Given,
    strata: Sequence[frozenset[Indicator]] = (),
) -> Proof | None:
    """A proof of a ground atom, its rules tried in the author's order; None when there is none.

    Premises of a stored row come from rounds before its own, so the proof is well-founded even through recursion.

    Raises:
        BudgetExceeded: the search outlived the solver's budget.
        Undefined: the atom rests on a check that is undefined.
    """
    return _prove(atom, _Known(relations, solver, given, strata))


def _prove(atom: Compound, known: _Known) -> Proof | None:
    solver, relation = known.solver, known.relations.get(atom.indicator)
    if relation is not None:
        return _stored_proof(atom, known) if atom.args in relation else None
    if atom.indicator in solver.computed:
        return _computed_proof(atom, known)
    if atom.indicator in BUILTINS and atom.indicator not in solver.clauses:
        holds = next(solver.solve([Literal(atom)]), None) is not None
        return Proof(Literal(atom), None, (), "computed") if holds else None
    for clause in solver.clauses.get(atom.indicator, ()):
        if not clause.body and unify(clause.head, atom, {}) is not None:
            return Proof(Literal(atom), clause)
    for clause in solver.clauses.get(atom.indicator, ()):
        for body in _instances(atom, clause, solver) if clause.body else ():
            proofs = [p for p in (_literal_proof(x, known) for x in body) if p is not None]
            if len(proofs) == len(body):
                return Proof(Literal(atom), clause, tuple(proofs))
    return None


def _stored_proof(goal: Compound, known: _Known) -> Proof:
    """The proof of a stored row, premises first: a loop, because a chain of rules may be longer than Python's stack."""
    steps: dict[Compound, tuple[Clause, tuple[Literal, ...]]] = {}
    proofs: dict[Compound, Proof] = {}  # each row is proved once, however often it is used
    waiting = [goal]
    while waiting:
        atom = waiting[-1]
        if atom not in steps:
            steps[atom] = _step(atom, known)
        clause, body = steps[atom]
        missing = [x.atom for x in body if _is_derived(x) and x.atom not in proofs]
        if missing:
            waiting.extend(reversed(missing))
        else:
            premises = tuple(proofs[x.atom] if _is_derived(x) else _leaf(x, known.solver) for x in body)
            proofs[atom] = Proof(Literal(atom), clause, premises)
            waiting.pop()
    return proofs[goal]


def _step(atom: Compound, known: _Known) -> tuple[Clause, tuple[Literal, ...]]:
    """The fact or the first rule behind a stored row, with the instance of its body that gives it."""
    facts = known.given.get(atom.indicator, {})
    if atom.args in facts:
        return clause_behind(atom, facts[atom.args]), ()
    for everywhere in (True, False):  # after a change a row may be older than premises from below its stratum
        for clause in known.solver.clauses[atom.indicator]:
            body = _earlier_body(atom, clause, known, everywhere) if clause.body else None
            if body is not None:
                return clause, body
    raise AssertionError("every row was derived by a clause from earlier rows")


def _earlier_body(atom: Compound, clause: Clause, known: _Known, everywhere: bool) -> tuple[Literal, ...] | None:
    """An instance of the clause's body that gives the row and rests on earlier ones; of the same stratum, or all."""
    round_ = known.relations[atom.indicator].round_of(atom.args)
    within = None if everywhere else known.stratum_of(atom.indicator)
    earlier = {x.needed for x in clause.body if not x.is_strict}  # of a comparison None, which is no predicate
    earlier = earlier if within is None else earlier & within
    try:
        return Premises(known.relations, known.solver.relations, earlier, round_, known.solver.budget).of(atom, clause)
    except NotLookedUp:
        return _searched_body(atom, clause, known, earlier, round_)


def _searched_body(
    atom: Compound, clause: Clause, known: _Known, earlier: Collection[Indicator | None], round_: int
) -> tuple[Literal, ...] | None:
    """As `_earlier_body`, by resolution."""
    relations = dict[Indicator, Relation]()
    for indicator in (x.needed for x in clause.body if x.needed is not None):
        relation = known.relations[indicator]
        is_earlier = indicator in earlier
        relations[indicator] = _Earlier(relation, round_) if is_earlier else relation  # type: ignore[assignment]
    solver = known.solver
    search = solver.over(relations)  # its premises are rows, too
    for body in _instances(atom, clause, search):
        if all(next(solver.solve([x]), None) is not None for x in body if x.is_strict):  # in all rows, not the earlier
            return body
    return None


def _instances(atom: Compound, clause: Clause, search: Solver) -> Iterator[tuple[Literal, ...]]:
    """The instances of the clause's body that hold and give the atom."""
    head, body = search.fresh(clause)
    bindings = unify(head, atom, {})
    if bindings is not None:
        for solution in search.solve(body, bindings):
            yield tuple(x.instance(solution) for x in body)


def _is_derived(literal: Literal) -> bool:
    """Whether a condition has a proof of its own; a comparison, an absence or an aggregate is its own."""
    return not (literal.is_comparison or literal.is_strict)


def _leaf(literal: Literal, solver: Solver) -> Proof:
    """What holds by itself; an aggregate with what it was worked out of."""
    return Proof(literal, remark=counted(literal, solver)) if literal.is_aggregate else Proof(literal)


def _literal_proof(literal: Literal, known: _Known) -> Proof | None:
    return _prove(literal.atom, known) if _is_derived(literal) else _leaf(literal, known.solver)


def _computed_proof(atom: Compound, known: _Known) -> Proof | None:
    """valid(S) rests on the proof of S, and on no constraint being broken; never(S) on the facts as they are.

    A row that somebody outside gives rests on nothing.
    """
    computed = known.solver.computed[atom.indicator]
    if next(computed(atom), None) is None:
        return None
    if isinstance(computed, Rows):
        return Proof(Literal(atom), None, (), computed.remark)
    if atom.functor == "never":
        return Proof(Literal(atom), None, (), "the facts break this constraint")
    inner = _prove(predication(atom[1]), known)
    return None if inner is None else Proof(Literal(atom), None, (inner,), "no constraint is broken")
