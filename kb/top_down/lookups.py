"""A question on stored rows alone: nested look-ups, without the machine.

Its answers are the machine's, in the same order; only conditions that are look-ups of constants and variables qualify.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from casper.kb.relations.relation import Columns, Relation, Row
from casper.kb.terms.clauses import Literal
from casper.kb.terms.terms import Term, Variable
from casper.kb.terms.unification import is_ground
from casper.kb.top_down.linking import STORED, Links


@dataclass(frozen=True, slots=True)
class Lookup:
    """One condition: the columns that are known when it is reached, and what its rows tell.

    ``key`` has for each known column a slot of the answer, or -1 and a constant; ``binds`` and ``agrees`` are columns
    with the slot that they fill, or must be the same as.
    """

    relation: Relation
    columns: Columns
    key: tuple[tuple[int, Term], ...]
    binds: tuple[tuple[int, int], ...]
    agrees: tuple[tuple[int, int], ...]

    def rows(self, answer: list[Term]) -> Iterator[Row]:
        """The rows that fit what is known."""
        key = tuple([constant if slot < 0 else answer[slot] for slot, constant in self.key])
        return iter(self.relation.matching(self.columns, key))


def lookups_of(body: Sequence[Literal], names: Sequence[Variable], links: Links) -> list[Lookup] | None:
    """The conditions as look-ups; None where one is something else."""
    slots = {name: at for at, name in enumerate(names)}
    known: set[Variable] = set()
    found: list[Lookup] = []
    for literal in body:
        if literal.is_comparison or literal.is_strict or links[literal.atom.indicator].how != STORED:
            return None
        if not all(isinstance(arg, Variable) or is_ground(arg) for arg in literal.atom.args):
            return None
        found.append(_lookup(links[literal.atom.indicator].what, literal.atom.args, slots, known))
        known.update(literal.variables())
    return found or None


def _lookup(relation: Relation, args: Sequence[Term], slots: dict[Variable, int], known: set[Variable]) -> Lookup:
    columns = tuple(at for at, arg in enumerate(args) if not isinstance(arg, Variable) or arg in known)
    key = tuple((slots[args[at]], None) if isinstance(args[at], Variable) else (-1, args[at]) for at in columns)
    binds: dict[Variable, int] = {}
    agrees: list[tuple[int, int]] = []
    for at, arg in enumerate(args):
        if at not in columns:
            if arg in binds:
                agrees.append((at, slots[arg]))
            else:
                binds[arg] = at
    return Lookup(relation, columns, key, tuple((at, slots[v]) for v, at in binds.items()), tuple(agrees))


def answers(lookups: Sequence[Lookup], size: int, look: Callable[[int], int]) -> Iterator[Row]:
    """Every answer, as the row of the values of all names; ``look`` is told of the steps now and then."""
    answer: list[Term] = [None] * size
    last, granted = len(lookups) - 1, look(0)
    left = granted
    open_ = [lookups[0].rows(answer)]
    while open_:
        depth = len(open_) - 1
        lookup = lookups[depth]
        for row in open_[-1]:
            for column, slot in lookup.binds:
                answer[slot] = row[column]
            if lookup.agrees and any(row[column] != answer[slot] for column, slot in lookup.agrees):
                continue
            if depth == last:
                yield tuple(answer)
                continue
            left -= 1
            if left <= 0:
                granted = left = look(granted - left)
            open_.append(lookups[depth + 1].rows(answer))
            break
        else:
            open_.pop()
