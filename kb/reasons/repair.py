"""Repairs: the smallest sets of base facts whose addition or removal would make a statement valid.

A best-first search over sets of changes, smallest sets first, each tried out on an overlay. While a set does not do, it
grows by one fact that takes away one obstacle: a failing condition needs a fact (through rules, what the rule needs), a
failing negation or a broken constraint needs one fact gone (or one there) of those it rests on. Every repair must
take that obstacle away somehow, so no smaller set is missed, up to what cannot be settled by one ground fact.
"""

from __future__ import annotations

import heapq
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Protocol, Self

from casper.kb.reasons.constraints import History
from casper.kb.reasons.doubt import Doubt
from casper.kb.reasons.proof import Proof
from casper.kb.reasons.why_not import Refusal, Violation, attempts
from casper.kb.terms.clauses import SYSTEM, Clause, Indicator, Literal
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.kb.terms.unification import is_ground, substitute, unify
from casper.kb.text.lines import Shown, one_line
from casper.kb.top_down.solve import Solver

MOST_TRIED = 150  # sets of changes tried out before the search gives up
LARGEST = 6  # facts in a set
DEEPEST = 6  # rules between a condition and the base fact that would mend it


@dataclass(frozen=True, slots=True)
class Repair(Shown):
    """Facts to add and facts to remove."""

    add: frozenset[Compound] = frozenset()
    remove: frozenset[Compound] = frozenset()

    @property
    def size(self) -> int:
        """How many facts change."""
        return len(self.add) + len(self.remove)

    def joined(self, other: Repair) -> Repair:
        """Both repairs at once."""
        return Repair(self.add | other.add, self.remove | other.remove)

    def to_json(self) -> dict[str, list[str]]:
        """``{"add": [fact], "remove": [fact]}``."""
        return {
            "add": sorted(term_text(as_term(f)) for f in self.add),
            "remove": sorted(term_text(as_term(f)) for f in self.remove),
        }

    def __str__(self) -> str:
        parts = [f"{verb} {text}" for verb, texts in self.to_json().items() for text in texts]
        return " and ".join(parts)

    def __repr__(self) -> str:
        return one_line(f"Repair: {str(self) or 'nothing to change'}")


class Mendable(Protocol):
    """What a search for repairs asks of a knowledge base."""

    def broken(self) -> Sequence[Violation]:
        """The constraints that the facts break as they are."""

    def changed(self, repair: Repair, /) -> Self:
        """The base as it would be after a repair."""

    def clauses_of(self, indicator: Indicator, /) -> Sequence[Clause]:
        """The clauses of a predicate."""

    def solver(self) -> Solver:
        """What proves conditions."""

    def why(self, statement: Compound, /) -> Proof | Doubt | None:
        """A proof of the statement."""

    def why_not(self, statement: Compound, history: History, /) -> Refusal | None:
        """What the statement fails by."""


def repairs(base: Mendable, statement: Compound, history: History, limit: int = 3) -> list[Repair]:
    """The smallest repairs of a statement that is not valid: at most ``limit`` sets, all of one size.

    Sets that remove nothing come before others of their size. None when the statement is valid, or beyond mending.
    """
    standing = {v.sentence for v in base.broken()}
    waiting = [(0, 0, "", Repair())]
    seen, found, tried = {Repair()}, list[Repair](), 0
    while waiting and tried < MOST_TRIED:
        size, _, _, repair = heapq.heappop(waiting)
        if len(found) >= limit or (found and size > found[0].size):
            break
        tried += 1
        changed = base.changed(repair)
        refusal = changed.why_not(statement, history)
        clashes = [v for v in changed.broken() if v.sentence not in standing]
        if refusal is None and not clashes:
            if size:
                found.append(repair)
            continue
        for step in _steps(changed, refusal, clashes) if size < LARGEST else ():
            grown = repair.joined(step)
            if grown not in seen and not grown.add & grown.remove:
                seen.add(grown)
                heapq.heappush(waiting, (grown.size, len(grown.remove), str(grown), grown))
    return found


def _steps(base: Mendable, refusal: Refusal | None, clashes: Sequence[Violation]) -> Iterator[Repair]:
    """Changes of one fact that take the first obstacle away: a clash of the facts, else what the refusal names."""
    if clashes:
        yield from _unclash(base, clashes[0])
    elif refusal is not None and refusal.provable and refusal.violations:
        yield from _unclash(base, refusal.violations[0])
    elif refusal is not None and not refusal.undefined:
        yield from _mend(base, Literal(refusal.statement), DEEPEST)


def _mend(base: Mendable, literal: Literal, depth: int) -> Iterator[Repair]:
    """Changes of one fact towards making a failing condition hold: each clause's first failing condition."""
    atom = literal.atom
    if literal.is_comparison or not is_ground(atom) or atom.indicator in SYSTEM or depth == 0:
        return
    if literal.negated:
        yield from _shake(base, atom, depth - 1)
        return
    clauses = base.clauses_of(atom.indicator)
    rules = [c for c in clauses if c.body]
    if not rules:
        yield Repair(add=frozenset({atom}))
    for attempt in attempts(atom, rules, base.solver()):
        if attempt.failed and (attempt.failed[0].is_comparison or attempt.failed[0].is_aggregate):
            yield from _recount(base, atom, attempt.clause, depth - 1)
        elif attempt.failed:
            yield from _mend(base, attempt.failed[0], depth - 1)


def _recount(base: Mendable, atom: Compound, clause: Clause, depth: int) -> Iterator[Repair]:
    """Changes of one fact that take an answer away from what a clause counts."""
    bindings = unify(clause.head, atom, {})
    for literal in clause.body if bindings is not None else ():
        if literal.is_aggregate:
            counted = substitute(literal.atom[2], bindings or {})
            for answer in base.solver().solve([Literal(counted)]):
                instance = substitute(counted, answer)
                if is_ground(instance):
                    yield from _shake(base, instance, depth)


def _unclash(base: Mendable, violation: Violation) -> Iterator[Repair]:
    """Changes of one fact towards ending a clash: against any of its conditions."""
    for literal in violation.clash:
        if literal.is_aggregate:
            counted = literal.atom[2]
            for answer in base.solver().solve([Literal(counted)]):
                yield from _shake(base, substitute(counted, answer), DEEPEST)
        elif literal.is_comparison or literal.atom.indicator in SYSTEM:
            continue
        elif literal.negated:
            yield from _mend(base, Literal(literal.atom), DEEPEST)
        else:
            yield from _shake(base, literal.atom, DEEPEST)


def _shake(base: Mendable, atom: Compound, depth: int) -> Iterator[Repair]:
    """Changes of one fact that take a proof of the atom apart: a given fact gone, or one there that it needs absent."""
    proof = base.why(atom) if is_ground(atom) else None
    if isinstance(proof, Doubt):
        yield from _decide(base, proof, depth)
        return
    for node in proof.premises_first() if proof is not None else ():
        if _is_given(node):
            yield Repair(remove=frozenset({node.fact}))
        elif node.literal.negated and not node.literal.is_comparison:
            yield from _mend(base, Literal(node.fact), depth)


def _decide(base: Mendable, doubt: Doubt, depth: int) -> Iterator[Repair]:
    """Changes of one fact that take an undefined atom's reason apart: a condition of its steps gone or there."""
    for step in doubt.steps:
        for literal in step.body:
            if literal.is_comparison or literal == step.literal:
                continue
            if literal.negated:
                yield from _mend(base, Literal(literal.atom), depth)
            elif is_ground(literal.atom) and isinstance(proof := base.why(literal.atom), Proof):
                given = (node.fact for node in proof.premises_first() if _is_given(node))
                yield from (Repair(remove=frozenset({fact})) for fact in given)


def _is_given(node: Proof) -> bool:
    return node.clause is not None and not node.clause.body
