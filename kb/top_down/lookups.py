"""A question on stored rows alone: nested look-ups, or a join on columns, without the machine.

The answers of the look-ups are the machine's, in the same order; only conditions that are look-ups of constants and
variables qualify. A question with many answers is worked out on numpy columns (`kb.relations.tables.joins`), where
negations and comparisons qualify, too.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import prod
from typing import TYPE_CHECKING

from casper.kb.errors import NotOnColumns, ProgramError
from casper.kb.relations.relation import Columns, Relation, Row
from casper.kb.terms.clauses import Indicator, Literal
from casper.kb.terms.terms import Term, Variable
from casper.kb.terms.unification import is_ground
from casper.kb.top_down.compiled.code import NotCarried
from casper.kb.top_down.linking import STORED, Links
from casper.kb.top_down.planning import estimate, ordered

if TYPE_CHECKING:
    from casper.kb.relations.tables.joins import Join

MANY = 1 << 40  # rows that a predicate without stored ones is taken to have
WORTH = 2_000  # answers to expect from which a join on columns is worth its columns


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


def join_on_columns(body: Sequence[Literal], names: Sequence[Variable], links: Links) -> Join | str | None:
    """The question as a join on columns; why it is none, in words, or None where it has too few rows to be worth it."""

    def find(indicator: Indicator) -> Relation | None:
        try:
            link = links[indicator]
        except (NotCarried, ProgramError):
            return None
        return link.what if link.how == STORED else None

    def size_of(indicator: Indicator) -> int:
        relation = find(indicator)
        return MANY if relation is None else len(relation)

    order = ordered(body, (), size_of)
    looked_up = [x for x in order if not (x.is_comparison or x.is_strict) and find(x.atom.indicator) is not None]
    if not names or not _is_worth_it(looked_up, size_of):
        return None
    from casper.kb.relations.tables.joins import join_of  # numpy is loaded for large questions only

    try:
        return join_of(order, names, find)
    except NotOnColumns as reason:
        return reason.sentence


def _is_worth_it(looked_up: Sequence[Literal], size_of: Callable[[Indicator], int]) -> bool:
    """Whether many answers are to be expected: nothing is known of the first rows, and there are enough."""
    if not looked_up or any(is_ground(arg) for arg in looked_up[0].atom.args):
        return False
    known: set[Variable] = set()
    expected: list[float] = []
    for literal in looked_up:
        expected.append(max(estimate(literal, known, size_of), 1.0))
        known.update(literal.variables())
    return prod(expected) >= WORTH
