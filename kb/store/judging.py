"""Why something holds, why not, and whether it is valid, in one state of a base."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from difflib import get_close_matches
from typing import TypeAlias

from casper.kb.errors import BudgetExceeded, Undefined
from casper.kb.program.refusals import undefined_sentence
from casper.kb.reasons.doubt import Doubt, doubt_of
from casper.kb.reasons.proof import Proof
from casper.kb.reasons.validity import Verdict, valid_instances, verify
from casper.kb.reasons.why import prove
from casper.kb.reasons.why_not import Refusal, Violation, attempts
from casper.kb.store.model import Model
from casper.kb.store.queries import instances
from casper.kb.terms.clauses import Indicator, Literal
from casper.kb.terms.terms import Compound
from casper.kb.terms.unification import is_ground, substitute
from casper.kb.top_down.answering import Answering

Fresh: TypeAlias = Callable[[], Answering]  # makes a search over the state, after what happened earlier


def why(atom: Compound, model: Model, search: Fresh) -> Proof | Doubt | None:
    """A proof of the atom's first instance, what makes it undefined, or None."""
    _ = model.relations  # reasons are told of what is listed
    try:
        if not is_ground(atom):
            first = next((found for found in instances(atom, search) if is_ground(found)), None)
            if first is None:
                return None
            atom = first
        proof = prove(atom, model.proofs, search(), model.given, model.program.strata)
    except Undefined:
        proof = None
    return proof or doubt_of(atom, search())


def why_not(atom: Compound, model: Model, search: Fresh) -> Refusal | None:
    """Why an atom of a defined predicate is not provable or not valid; None when it is both."""
    relation = model.relations.get(atom.indicator)  # reasons are told of what is listed
    if relation is not None and atom.args in relation:  # ground, so only constraints can object
        violations = _violations(atom, model, search)
        return Refusal(atom, (), violations, provable=True) if violations else None
    is_listed = relation is not None and relation.undefined is None and is_ground(atom)  # then it is no row: false
    provable = None if is_listed else next(search().solve([Literal(atom)]), None)
    if provable is None:
        tried = tuple(attempts(atom, model.program.clauses[atom.indicator], search()))
        doubt = None if is_listed else doubt_of(atom, search())
        violations = _violations(atom, model, search) if is_ground(atom) else ()
        return Refusal(atom, tried, violations, doubt="" if doubt is None else doubt.sentence)
    try:
        if next(valid_instances(atom, search(), model.constraints), None) is not None:
            return None
    except Undefined:
        pass
    return Refusal(atom, (), _violations(substitute(atom, provable), model, search), provable=True)


def _violations(atom: Compound, model: Model, search: Fresh) -> tuple[Violation, ...]:
    """The constraints that are broken; where none is, those that may be."""
    found = list(model.constraints.judged(atom, search()))
    return tuple([v for v in found if not v.doubt] or found)


def judged(atom: Compound, model: Model, search: Fresh) -> Verdict:
    """Whether an atom of a defined predicate is valid, with the reason against it."""
    constraints = model.constraints  # which may list: before the search
    verdict = verify(atom, search(), constraints)
    if verdict.valid is None:
        return _with_reason(verdict, search)
    return verdict if verdict.valid else Verdict(atom, False, atom, why_not(atom, model, search))


def _with_reason(verdict: Verdict, search: Fresh) -> Verdict:
    """An unknown verdict with the whole reason, where the statement itself is undefined."""
    try:
        doubt = doubt_of(verdict.statement, search())
    except BudgetExceeded:
        return verdict
    return verdict if doubt is None else replace(verdict, remark=doubt.sentence)


def nobody_defines(indicator: Indicator, model: Model, declared: list[Indicator]) -> str:
    """Why a statement whose predicate nobody defines is invalid, with what may have been meant."""
    known = declared or list(model.program.clauses)
    name, arity = indicator
    if any(name == other for other, _ in known):
        return undefined_sentence(indicator, known)
    close = get_close_matches(name, sorted({other for other, _ in known}), n=1)
    return f"there is no action {name}/{arity} here" + (f"; did you mean {close[0]}?" if close else "")
