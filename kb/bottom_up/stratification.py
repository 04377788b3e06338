"""What the upkeep of a stratum has to know of it, found once: what it needs, and whether anything may be undefined."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TypeAlias

from casper.kb.program.program import Program
from casper.kb.program.strata import dependents, needs
from casper.kb.relations.relation import Relation
from casper.kb.terms.clauses import Indicator

Stratum: TypeAlias = frozenset[Indicator]


@dataclass
class Strata:
    """The strata of a program."""

    program: Program
    _needed: dict[Stratum, frozenset[Indicator]] = field(default_factory=dict)
    _renewed: dict[Stratum, bool] = field(default_factory=dict)
    _doubtful: dict[Stratum, Sequence[Indicator]] = field(default_factory=dict)

    def needs(self, stratum: Stratum) -> frozenset[Indicator]:
        """The predicates that its rules need."""
        found = self._needed.get(stratum)
        if found is None:
            rules = (rule for i in stratum for rule in self.program.rules[i])
            found = self._needed[stratum] = frozenset(needs(rules))
        return found

    def is_blurred(
        self, stratum: Stratum, relations: Mapping[Indicator, Relation], blurred: set[Indicator]
    ) -> bool:
        """Whether undefined rows play a part in a stratum, or may come to."""
        needed = self.needs(stratum)
        if self._is_renewed(stratum) or not needed.isdisjoint(blurred):
            return True
        for indicator in self._doubtful_of(stratum):
            relation = relations.get(indicator)
            if relation is not None and relation.undefined is not None:
                return True
        return False

    def _doubtful_of(self, stratum: Stratum) -> Sequence[Indicator]:
        """The predicates that a stratum has to do with and that can have undefined rows at all."""
        found = self._doubtful.get(stratum)
        if found is None:
            found = self._doubtful[stratum] = [i for i in (*stratum, *self.needs(stratum)) if i in self._fallible]
        return found

    @cached_property
    def _fallible(self) -> set[Indicator]:
        """The predicates with a rule that compares, counts, runs in a circle or keeps the best, and all that need them.

        Rows of no other are ever undefined.
        """
        rules = self.program.rules
        bodies = ((indicator, rule.body) for indicator, found in rules.items() for rule in found)
        worked_out = {i for i, body in bodies if any(x.is_comparison or x.is_aggregate for x in body)}
        roots = {*worked_out, *self.program.circular, *self.program.least}
        return roots | dependents(rules, roots)

    def _is_renewed(self, stratum: Stratum) -> bool:
        """Whether a stratum is worked out anew whatever has changed: it runs in a circle, or keeps the best."""
        found = self._renewed.get(stratum)
        if found is None:
            found = self._renewed[stratum] = not stratum.isdisjoint({*self.program.circular, *self.program.least})
        return found
