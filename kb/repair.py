"""Repairs: the fewest base facts whose addition or removal would make a statement valid, each one tried out.

A candidate comes from what `kb.why_not` names: a failing condition is mended by adding a fact (through rules, by what
the rule needs), a failing negation or a broken constraint by removing one. Only candidates that really make the
statement valid, and break no constraint that held before, are returned.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from itertools import islice, product
from typing import TYPE_CHECKING

from casper.kb.clauses import Literal
from casper.kb.program import SYSTEM
from casper.kb.proof import facts_of
from casper.kb.terms import Compound, as_term, is_ground
from casper.kb.why_not import Refusal, attempts
from casper.kb.writer import term_text

if TYPE_CHECKING:
    from casper.kb.base import KnowledgeBase

MOST_CANDIDATES = 60
DEEPEST = 4  # rules between a condition and the base fact that would mend it


@dataclass(frozen=True, slots=True)
class Repair:
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


def repairs(base: KnowledgeBase, refusal: Refusal, works: Callable[[Repair], bool], limit: int = 3) -> list[Repair]:
    """The smallest repairs of a refused statement, smallest first, those that remove nothing before others."""
    found = {c for c in islice(_candidates(base, refusal), MOST_CANDIDATES) if c.size}
    ranked = sorted(found, key=lambda r: (r.size, len(r.remove), str(r)))
    working: list[Repair] = []
    for candidate in ranked:
        if len(working) >= limit or (working and candidate.size > working[0].size):
            break
        if works(candidate):
            working.append(candidate)
    return working


def _candidates(base: KnowledgeBase, refusal: Refusal) -> Iterator[Repair]:
    """Ways to make the statement provable, each with ways to end every clash."""
    clashes = [list(_unclash(base, violation.clash)) for violation in refusal.violations]
    for proof in _provable(base, refusal):
        yield from (proof.joined(_joined(choice)) for choice in product(*clashes))


def _provable(base: KnowledgeBase, refusal: Refusal) -> Iterator[Repair]:
    if refusal.undefined:
        return
    if refusal.provable:
        yield Repair()
        return
    if not any(c.body for c in base.clauses_of(refusal.statement.indicator)):
        yield from _mend(base, Literal(refusal.statement), DEEPEST)
    for attempt in sorted(refusal.attempts, key=lambda a: len(a.failed)):
        yield from _all_of(base, attempt.failed, DEEPEST)


def _all_of(base: KnowledgeBase, failed: Iterable[Literal], depth: int) -> Iterator[Repair]:
    """Ways to make all of an attempt's failing conditions hold; none where they are not known."""
    ways = [list(_mend(base, literal, depth)) for literal in failed] or [[]]
    return (_joined(choice) for choice in product(*ways))


def _joined(choice: Iterable[Repair]) -> Repair:
    whole = Repair()
    for part in choice:
        whole = whole.joined(part)
    return whole


def _mend(base: KnowledgeBase, literal: Literal, depth: int) -> Iterator[Repair]:
    """Ways to make one failing condition hold."""
    atom = literal.atom
    if literal.is_comparison or not is_ground(atom) or atom.indicator in SYSTEM or depth == 0:
        return
    if literal.negated:
        yield from _remove(base, atom)
        return
    rules = [c for c in base.clauses_of(atom.indicator) if c.body]
    if not rules:
        yield Repair(add=frozenset({atom}))
    for attempt in attempts(atom, rules, base.solver()):
        yield from _all_of(base, attempt.failed, depth - 1)


def _unclash(base: KnowledgeBase, clash: Iterable[Literal]) -> Iterator[Repair]:
    """Ways to end a clash: remove a fact it rests on, or add one whose absence it rests on."""
    for literal in clash:
        if literal.is_comparison or literal.atom.indicator in SYSTEM:
            continue
        if literal.negated:
            yield from _mend(base, Literal(literal.atom), DEEPEST)
        else:
            yield from _remove(base, literal.atom)


def _remove(base: KnowledgeBase, atom: Compound) -> Iterator[Repair]:
    """Ways to make what holds fail: remove one of the facts that its proof rests on."""
    proof = base.why(atom) if is_ground(atom) else None
    for fact in dict.fromkeys(facts_of(proof)) if proof is not None else ():
        yield Repair(remove=frozenset({fact}))
