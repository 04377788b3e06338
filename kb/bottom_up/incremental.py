"""Incremental upkeep: facts come and go, and the stored rows follow (delete and rederive, stratum by stratum).

For each stratum, lowest first: everything that some derivation rests on a row that went (or, under a negation, on one
that came) is over-deleted; what another rule still gives is put back; then what the new rows give is added. A row that
is put back or added gets a new, later round, so proofs stay well-founded.

When more rows are over-deleted than recomputing would cost, `TooMuch` asks for that instead. A rule that counts is
followed group by group. A stratum in which negation runs in a circle, that keeps a minimum, or that has to do with
undefined rows, is always worked out anew when something it needs has changed.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping, MutableMapping
from dataclasses import dataclass, field, replace
from typing import TypeAlias

from casper.kb.bottom_up.changes import Before, Change, ChangePlan, derives, noting
from casper.kb.bottom_up.circles.doubts import Failure, add_undefined
from casper.kb.bottom_up.join import Join
from casper.kb.bottom_up.row_fixpoint import evaluate_stratum
from casper.kb.bottom_up.size import MOST_ROWS, Room
from casper.kb.bottom_up.stratification import Strata, Stratum
from casper.kb.program.program import Program
from casper.kb.relations.relation import Relation, Row
from casper.kb.terms.clauses import Indicator

Given: TypeAlias = Mapping[Indicator, Mapping[Row, object]]  # base facts
LEAST_TO_RECOMPUTE = 20_000  # over-deleted rows from which recomputing is considered at all


class TooMuch(Exception):
    """A removal took so many rows with it that the fixpoint is better computed anew."""


@dataclass
class Maintenance:
    """The compiled plans of a program, made when they are first needed."""

    program: Program
    _plans: dict[tuple[Indicator, bool], list[ChangePlan]] = field(init=False)
    _strata: Strata = field(init=False)
    _checks: dict[Indicator, list[Join]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._plans, self._strata = defaultdict(list), Strata(self.program)
        stored = {indicator for stratum in self.program.strata for indicator in stratum}
        for rule in (rule for indicator in stored for rule in self.program.rules[indicator]):
            for at, literal in enumerate(rule.body):
                if literal.is_aggregate and literal.needed is not None:
                    for changed in (False, True):  # whether a row comes or goes
                        self._plans[literal.needed, changed].append(ChangePlan(rule, at))
                elif not literal.is_comparison:
                    self._plans[literal.atom.indicator, literal.negated].append(ChangePlan(rule, at))

    def update(
        self, given: Given, relations: MutableMapping[Indicator, Relation], added: Change, removed: Change, round_: int
    ) -> int:
        """Bring the relations in step with base facts that came and went; the last round used.

        ``given`` already says what is given now. Rows come with rounds from ``round_`` on.

        Raises:
            TooMuch: compute the fixpoint anew; the relations are then in no defined state.
        """
        came: Change = defaultdict(dict)
        went: Change = defaultdict(dict)
        blurred: set[Indicator] = set()  # predicates whose undefined rows have changed
        changed = {i for rows in (added, removed) for i in rows if rows[i]}
        for stratum in self.program.strata:
            if changed.isdisjoint(stratum) and changed.isdisjoint(self._strata.needs(stratum)):
                continue
            if self._strata.is_blurred(stratum, relations, blurred):
                round_ = self._renew(given, relations, stratum, came, went, blurred, round_)
                changed.update(blurred, (i for i in stratum if came[i] or went[i]))
                continue
            failures: list[Failure] = []
            disturbed = removed or came or went
            over: Change = self._overdelete(given, relations, stratum, removed, came, went) if disturbed else {}
            for indicator, rows in over.items():
                for row in rows:
                    relations[indicator].remove(row)
            fresh: Change = {i: dict(rows) for i, rows in added.items() if i in stratum}
            self._rederive(given, relations, over, fresh, failures)
            round_, new = self._insert(relations, stratum, fresh, came, went, round_, failures)
            for indicator in {*over, *new}:
                old, now = over.get(indicator, {}), new.get(indicator, {})
                came[indicator] = {row: None for row in now if row not in old}
                went[indicator] = {row: None for row in old if row not in now}
                if came[indicator] or went[indicator]:
                    changed.add(indicator)
            if failures:
                rules = [rule for i in stratum for rule in self.program.rules[i]]
                add_undefined(rules, stratum, relations, failures, Room(MOST_ROWS, relations))
                blurred.update(i for i in stratum if relations[i].undefined is not None)
                changed |= blurred
        return round_

    def _renew(
        self,
        given: Given,
        relations: MutableMapping[Indicator, Relation],
        stratum: Stratum,
        came: Change,
        went: Change,
        blurred: set[Indicator],
        round_: int,
    ) -> int:
        """Work a stratum out anew, and note what that changes; the last round used."""
        program = replace(self.program, given=given)  # type: ignore[arg-type]
        anew = {i: relations[i] for i in self._strata.needs(stratum) if i in relations}
        anew.update((i, Relation(*i, given[i])) for i in stratum)
        last = evaluate_stratum(program, stratum, anew, Room(MOST_ROWS, anew), round_)
        for indicator in stratum:
            relation, now = relations[indicator], anew[indicator]
            before = list(relation)
            went[indicator] = {row: None for row in before if row not in now}
            came[indicator] = {row: None for row in now if row not in relation}
            for row in before:
                relation.remove(row)
            for row, at in now.rows.items():
                relation.add(row, at)
            if set(relation.undefined or ()) != set(now.undefined or ()):
                blurred.add(indicator)
            relation.undefined = now.undefined
        return last

    def _overdelete(
        self,
        given: Given,
        relations: Mapping[Indicator, Relation],
        stratum: Stratum,
        removed: Change,
        came: Change,
        went: Change,
    ) -> Change:
        """Every row of the stratum that some derivation rests on a change of; a superset of what must go."""
        view = Before(relations, went)
        over: Change = defaultdict(dict)
        delta: Change = {i: {r: None for r in removed[i] if r in relations[i]} for i in stratum if removed.get(i)}
        for indicator, rows in delta.items():
            over[indicator].update(rows)
        found: Change = defaultdict(dict)
        for indicator, rows in went.items():
            self._gave(indicator, False, rows, stratum, view, found)
        for indicator, rows in came.items():
            self._gave(indicator, True, rows, stratum, view, found)
        delta = {i: {**delta.get(i, {}), **found.get(i, {})} for i in {*delta, *found}}
        while delta:
            delta = {i: {r: None for r in rows if r in relations[i] and r not in given[i]} for i, rows in delta.items()}
            found = defaultdict(dict)
            for indicator, rows in delta.items():
                over[indicator].update(rows)
                self._gave(indicator, False, rows, stratum, view, found)
            delta = {i: {r: None for r in rows if r not in over[i]} for i, rows in found.items() if rows}
            delta = {i: rows for i, rows in delta.items() if rows}
            self._limit(relations, over)
        return over

    def _gave(
        self,
        indicator: Indicator,
        negated: bool,
        rows: Iterable[Row],
        stratum: Stratum,
        view: Mapping[Indicator, Relation],
        found: Change,
    ) -> None:
        if not rows:
            return
        for plan in self._plans.get((indicator, negated), ()):
            if plan.head in stratum:
                plan.gave(view, rows, found[plan.head])

    def _rederive(
        self,
        given: Given,
        relations: Mapping[Indicator, Relation],
        over: Change,
        fresh: Change,
        failures: list[Failure],
    ) -> None:
        """Of the rows that were over-deleted, those that a rule gives from what is left."""
        for indicator, rows in over.items():
            checks = self._checks_of(indicator)
            for row in rows:
                if row in given[indicator] or any(derives(check, relations, row, failures) for check in checks):
                    fresh.setdefault(indicator, {})[row] = None

    def _checks_of(self, indicator: Indicator) -> list[Join]:
        found = self._checks.get(indicator)
        if found is None:
            found = self._checks[indicator] = [Join(rule, bound_head=True) for rule in self.program.rules[indicator]]
        return found

    def _insert(
        self,
        relations: Mapping[Indicator, Relation],
        stratum: Stratum,
        fresh: Change,
        came: Change,
        went: Change,
        round_: int,
        failures: list[Failure],
    ) -> tuple[int, Change]:
        """Add rows and all they give, round by round; everything that was new."""
        for changed, negated in ((came, False), (went, True)):
            for indicator, rows in changed.items():
                self._give(indicator, negated, rows, stratum, relations, fresh, failures)
        new: Change = defaultdict(dict)
        while fresh:
            round_ += 1
            delta = {i: [r for r in rows if relations[i].add(r, round_)] for i, rows in fresh.items()}
            fresh = {}
            for indicator, added in delta.items():
                new[indicator].update(dict.fromkeys(added))
                self._give(indicator, False, added, stratum, relations, fresh, failures)
        return round_, new

    def _give(
        self,
        indicator: Indicator,
        negated: bool,
        rows: Collection[Row],
        stratum: Stratum,
        relations: Mapping[Indicator, Relation],
        fresh: Change,
        failures: list[Failure],
    ) -> None:
        if not rows:
            return
        for plan in self._plans.get((indicator, negated), ()):
            if plan.head in stratum:
                found: dict[Row, None] = {}
                plan.gives.run(relations, rows, found.setdefault, None, noting(plan.rule, failures))
                known = relations[plan.head]
                for row in found:
                    if row not in known:
                        fresh.setdefault(plan.head, {})[row] = None

    def _limit(self, relations: Mapping[Indicator, Relation], over: Change) -> None:
        gone = sum(map(len, over.values()))
        if gone > LEAST_TO_RECOMPUTE and gone > 0.1 * sum(map(len, relations.values())):
            raise TooMuch
