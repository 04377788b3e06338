"""What a base knows by heart: every listed statement that holds, in one set, and what that set decides."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from typing import TypeAlias

from casper.kb.relations.relation import Relation
from casper.kb.store.on_demand import GIVEN
from casper.kb.terms.clauses import Indicator
from casper.kb.terms.terms import Term, predication
from casper.kb.terms.unification import is_ground

Statement: TypeAlias = str | tuple[Term, ...]  # text, or a Compound / a tuple that starts with the name
MOST_INDEXED = 20_000  # statements up to which all that hold are kept in one set
_NAMES = frozenset({str})


@dataclass(frozen=True, slots=True)
class Known:
    """The statements that hold, as tuples.

    Of a predicate that ``lengths`` has (its arity and one), a statement of ``constants`` that is not among the true
    ones does not hold. Any other may have a variable in it, or be spelt in another way.
    """

    true: Collection[Statement] = frozenset()
    lengths: Mapping[Term, int] = field(default_factory=dict)
    constants: frozenset[Term] = frozenset()


NOTHING = Known()


def known_of(listed: Mapping[Indicator, Relation]) -> Known:
    """What is known when all of these rows hold; nothing where there are too many."""
    if sum(map(len, listed.values())) > MOST_INDEXED:
        return NOTHING
    true = {(name, *row) for (name, _), relation in listed.items() for row in relation}
    arities = Counter(name for name, _ in listed)
    settled = {i for i, relation in listed.items() if relation.undefined is None and arities[i[0]] == 1}
    return Known(true, {name: arity + 1 for name, arity in settled}, frozenset(x for row in true for x in row))


def looked_up(statement: tuple[Term, ...], at_hand: Mapping[Indicator, Relation]) -> bool | None:
    """Whether a statement holds, as far as one look at the rows tells; else None."""
    name, row = statement[0], statement[1:]
    relation = at_hand.get((name, len(row)))
    if relation is None:  # of a predicate with rules its facts may be at hand
        given = at_hand.get((f"{GIVEN}{name}", len(row)))
        return True if given is not None and row in given else None
    if row in relation:
        return True
    if not _NAMES.issuperset(map(type, row)) and not is_ground(predication(statement).args):
        return None  # (a row of names has nothing open in it, which a fast look tells)
    return False if relation.undefined is None else None
