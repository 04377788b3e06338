"""Negation in a circle: the well-founded model of one stratum by the alternating fixpoint (Van Gelder).

What holds for certain and what is possible are worked out in turn: a negation is certain when what it negates is not
possible, and possible when that is not certain. The certain rows grow and the possible ones shrink until both stay;
what is then possible but not certain is undefined.
"""

from __future__ import annotations

from collections.abc import Mapping

from casper.kb.bottom_up.circles.doubts import Failure, add_undefined
from casper.kb.bottom_up.circles.ground import settle
from casper.kb.bottom_up.size import Room
from casper.kb.bottom_up.stratum import Stratum
from casper.kb.program.program import Program
from casper.kb.relations.relation import Relation
from casper.kb.relations.undefined import Possible, UndefinedRows, are_settled, possible
from casper.kb.terms.clauses import Clause, Indicator

Relations = dict[Indicator, Relation]


def well_founded(program: Program, stratum: frozenset[Indicator], relations: Relations, room: Room, round_: int) -> int:
    """Give a stratum in which negation runs in a circle its rows; the last round's number.

    Args:
        relations: all rows of what the stratum needs; its own are replaced.
        round_: rounds of rows are later.
    """
    circle = Circle(program, stratum, relations, room, round_)
    certain = circle.given()
    over, failures = circle.fixpoint(certain)
    needed = {x.needed for rule in circle.rules for x in rule.body if x.needed not in stratum}
    if not failures and are_settled(relations, (i for i in needed if i is not None)):
        last = settle(circle.rules, certain, {**relations, **over}, round_)
    else:
        certain, last = alternate(circle)
    relations.update(certain)
    return last


def alternate(circle: Circle) -> tuple[Relations, int]:
    """The stratum's rows, undefined ones among them, by alternation alone."""
    certain = circle.given()
    while True:
        circle.add_possible(certain)
        grown, _ = circle.fixpoint({i: possible(r) for i, r in certain.items()})
        if sum(map(len, grown.values())) == sum(map(len, certain.values())):
            for indicator, relation in grown.items():
                relation.undefined = certain[indicator].undefined
            return grown, circle.last
        certain = grown


class Circle:
    """A stratum in which negation runs in a circle, with the two fixpoints that alternate."""

    def __init__(
        self, program: Program, stratum: frozenset[Indicator], relations: Relations, room: Room, round_: int
    ) -> None:
        self.program, self.stratum, self.room, self.round_ = program, stratum, room, round_
        self.below = {i: r for i, r in relations.items() if i not in stratum}
        self.rules: list[Clause] = [c for i in sorted(stratum) for c in program.rules[i]]

    def given(self) -> Relations:
        """The stratum's relations with what is given alone."""
        return {i: Relation(*i, self.program.given[i]) for i in self.stratum}

    def fixpoint(self, negated: Mapping[Indicator, Relation]) -> tuple[Relations, list[Failure]]:
        """The rows that follow where the stratum's negations look into the given relations; and what failed."""
        found = self.given()
        absent: Relations = Possible(self.below)
        absent.update(negated)
        relations = {**self.below, **found}
        stratum = Stratum(self.program, self.stratum, relations, Room(self.room.most_rows, relations), absent)
        self.last = stratum.run(self.round_)
        return found, stratum.failures

    def add_possible(self, certain: Relations) -> None:
        """Give the certain relations as undefined rows whatever else is possible while they are all that is certain."""
        found, failures = self.fixpoint(certain)
        for indicator, relation in certain.items():
            more = [row for row in found[indicator] if row not in relation]
            relation.undefined = UndefinedRows(*indicator, more) if more else None
        relations = {**self.below, **certain}
        add_undefined(self.rules, self.stratum, relations, failures, Room(self.room.most_rows, relations))
