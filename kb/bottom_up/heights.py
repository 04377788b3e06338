"""Least proof heights: the round of every row if all strata were evaluated at once.

Within one stratum the fixpoint's own rounds are the least heights. Across strata, and after changes, they are not: a
row of a higher stratum may have a shorter proof than its round says. With the model known, negations are settled, so
one fixpoint over all rules gives every row its least height.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace

from casper.kb.bottom_up.circles.minimum import Within
from casper.kb.bottom_up.size import MOST_ROWS, Room
from casper.kb.bottom_up.stratum import Joins
from casper.kb.program.program import Program
from casper.kb.relations.relation import Relation, Row
from casper.kb.relations.undefined import Possible
from casper.kb.terms.clauses import Clause, Indicator, Literal
from casper.kb.terms.terms import Compound

_SETTLED = "settled: "  # in front of the name of a predicate whose rows are all known; no text can spell it bare


class Heights:
    """The least heights of one program's proofs; its rules are compiled once, whatever facts it is asked about."""

    def __init__(self, program: Program) -> None:
        self._stored = frozenset(indicator for stratum in program.strata for indicator in stratum)
        rules = {i: tuple(_settled(rule) for rule in program.rules[i]) for i in self._stored}
        self._program, self._joins = replace(program, rules=rules), Joins()

    def of(
        self, given: Mapping[Indicator, Collection[Row]], relations: Mapping[Indicator, Relation]
    ) -> dict[Indicator, Relation]:
        """The same rows, and the undefined ones beside them, each row with the least height of a proof as its round.

        Args:
            given: the base facts of every stored predicate.
            relations: all rows.
        """
        found = {i: Relation(*i, (row for row in given[i] if row in relations[i])) for i in self._stored}
        everything = dict(found)
        everything.update((_final(indicator), relations[indicator]) for indicator in self._stored)
        room, possible = Room(MOST_ROWS, everything), Possible(everything)
        Within(self._program, self._stored, everything, room, relations, possible, self._joins).run(0)
        for indicator, relation in found.items():
            relation.undefined = relations[indicator].undefined  # a proof rests on no absence of what may be there
        return found


def _settled(rule: Clause) -> Clause:
    body = tuple(_look_up(x) if x.is_strict else x for x in rule.body)
    return replace(rule, body=body)


def _look_up(literal: Literal) -> Literal:
    if literal.is_aggregate:
        what, atom, result = literal.atom.args
        settled = Compound((_final(atom.indicator)[0], *atom.args))
        return replace(literal, atom=Compound((literal.atom[0], what, settled, result)))
    return replace(literal, atom=Compound((_final(literal.atom.indicator)[0], *literal.atom.args)))


def _final(indicator: Indicator) -> Indicator:
    return _SETTLED + indicator[0], indicator[1]
