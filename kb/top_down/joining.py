"""A question with many answers over stored rows: whether it is worth a join on numpy columns, and as which join.

`kb.relations.tables.joins` works it out; negations and comparisons qualify, too.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import prod
from typing import TYPE_CHECKING

from casper.kb.errors import NotOnColumns, ProgramError
from casper.kb.relations.relation import Relation
from casper.kb.terms.clauses import Indicator, Literal
from casper.kb.terms.terms import Variable
from casper.kb.terms.unification import is_ground
from casper.kb.top_down.linking import STORED, Links
from casper.kb.top_down.planning import estimate, ordered

if TYPE_CHECKING:
    from casper.kb.relations.tables.joins import Join

MANY = 1 << 40  # rows that a predicate without stored ones is taken to have
WORTH = 2_000  # answers to expect from which a join on columns is worth its columns


def join_on_columns(body: Sequence[Literal], names: Sequence[Variable], links: Links) -> Join | str | None:
    """The question as a join on columns; why it is none, in words, or None where it has too few rows to be worth it."""

    def find(indicator: Indicator) -> Relation | None:
        try:
            link = links[indicator]
        except ProgramError:
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
