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
from collections.abc import Callable, Collection, Iterable, Mapping, MutableMapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TypeAlias

from casper.kb.bottom_up.circles.doubts import Failure, add_undefined
from casper.kb.bottom_up.join import Join
from casper.kb.bottom_up.row_fixpoint import evaluate_stratum
from casper.kb.bottom_up.size import MOST_ROWS, Room
from casper.kb.program.program import Program
from casper.kb.program.strata import needs
from casper.kb.relations.relation import Columns, Relation, Row
from casper.kb.terms.clauses import Clause, Indicator, Literal
from casper.kb.terms.terms import Compound, Variable
from casper.kb.terms.unification import Bindings, substitute, variables_of

Change: TypeAlias = dict[Indicator, dict[Row, None]]
Given: TypeAlias = Mapping[Indicator, Mapping[Row, object]]  # base facts
LEAST_TO_RECOMPUTE = 20_000  # over-deleted rows from which recomputing is considered at all


class TooMuch(Exception):
    """A removal took so many rows with it that the fixpoint is better computed anew."""


@dataclass
class _Plan:
    """A rule for a change of one of its conditions: to find what it gives, and what it may have given.

    A row that comes or goes of what an aggregate counts changes its group: all that the group gives now is found, and
    all that it may have given is what stands there, whatever the result was.
    """

    rule: Clause
    at: int

    @property
    def head(self) -> Indicator:
        """The predicate it gives rows of."""
        return self.rule.head.indicator

    @cached_property
    def gives(self) -> Join:
        """The rule compiled for rows that came."""
        if self.rule.body[self.at].is_aggregate:
            return Join(replace(self.rule, body=(self._seed, *self.rule.body)), 0)
        return Join(self.rule, self.at)

    def gave(self, view: Mapping[Indicator, Relation], rows: Iterable[Row], found: dict[Row, None]) -> None:
        """Add a superset of what the rule gave by way of rows that changed."""
        if not any(x.is_aggregate for x in self.rule.body):
            self._gave.run(view, rows, found.setdefault)
            return
        keys: dict[Row, None] = {}
        self._groups.run(view, rows, keys.setdefault)
        for key in keys:
            found.update(dict.fromkeys(view[self.head].matching(self._columns, key)))

    @cached_property
    def _gave(self) -> Join:
        return Join(self.rule, self.at, negations=False)

    @cached_property
    def _seed(self) -> Literal:
        """The condition as a look-up of the row that changed, with wildcards of its own."""
        literal = self.rule.body[self.at]
        atom: Compound = literal.atom[2] if literal.is_aggregate else literal.atom
        fresh: Bindings = {v: Variable(f"{v.name}again") for v in variables_of(atom) if v.is_anonymous}
        return Literal(substitute(atom, fresh))

    @cached_property
    def _looked_up(self) -> tuple[Literal, ...]:
        others = (x for at, x in enumerate(self.rule.body) if at != self.at)
        return (self._seed, *(x for x in others if not x.is_strict and not x.is_comparison))

    @cached_property
    def _columns(self) -> tuple[int, ...]:
        """The columns of the head that are known without any aggregate."""
        known = {v for x in self._looked_up for v in x.variables()}
        return tuple(c for c, arg in enumerate(self.rule.head.args) if known.issuperset(variables_of(arg)))

    @cached_property
    def _groups(self) -> Join:
        """What is known of the rows that the changed row has to do with."""
        key = Compound((self.rule.head[0], *(self.rule.head.args[c] for c in self._columns)))
        return Join(Clause(key, self._looked_up), 0)


@dataclass
class Maintenance:
    """The compiled plans of a program, made when they are first needed."""

    program: Program
    _plans: dict[tuple[Indicator, bool], list[_Plan]] = field(init=False)
    _checks: dict[Indicator, list[Join]] = field(default_factory=dict)
    _needed: dict[frozenset[Indicator], frozenset[Indicator]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._plans = defaultdict(list)
        stored = {indicator for stratum in self.program.strata for indicator in stratum}
        for rule in (rule for indicator in stored for rule in self.program.rules[indicator]):
            for at, literal in enumerate(rule.body):
                if literal.is_aggregate and literal.needed is not None:
                    for changed in (False, True):  # whether a row comes or goes
                        self._plans[literal.needed, changed].append(_Plan(rule, at))
                elif not literal.is_comparison:
                    self._plans[literal.atom.indicator, literal.negated].append(_Plan(rule, at))

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
        for stratum in self.program.strata:
            changed = {i for rows in (added, removed, came, went) for i in rows if rows[i]} | blurred
            if changed.isdisjoint(stratum) and changed.isdisjoint(self._needs(stratum)):
                continue
            if self._is_blurred(stratum, relations, blurred):
                round_ = self._renew(given, relations, stratum, came, went, blurred, round_)
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
            if failures:
                rules = [rule for i in stratum for rule in self.program.rules[i]]
                add_undefined(rules, stratum, relations, failures, Room(MOST_ROWS, relations))
                blurred.update(i for i in stratum if relations[i].undefined is not None)
        return round_

    def _needs(self, stratum: frozenset[Indicator]) -> frozenset[Indicator]:
        found = self._needed.get(stratum)
        if found is None:
            rules = (rule for i in stratum for rule in self.program.rules[i])
            found = self._needed[stratum] = frozenset(needs(rules))
        return found

    def _is_blurred(
        self, stratum: frozenset[Indicator], relations: Mapping[Indicator, Relation], blurred: set[Indicator]
    ) -> bool:
        """Whether undefined rows play a part in a stratum, or may come to."""
        needed = self._needs(stratum)
        if not (stratum.isdisjoint({*self.program.circular, *self.program.least}) and needed.isdisjoint(blurred)):
            return True
        return any(relations[i].undefined is not None for i in (*stratum, *needed) if i in relations)

    def _renew(
        self,
        given: Given,
        relations: MutableMapping[Indicator, Relation],
        stratum: frozenset[Indicator],
        came: Change,
        went: Change,
        blurred: set[Indicator],
        round_: int,
    ) -> int:
        """Work a stratum out anew, and note what that changes; the last round used."""
        program = replace(self.program, given=given)  # type: ignore[arg-type]
        anew = {i: relations[i] for i in self._needs(stratum) if i in relations}
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
        stratum: frozenset[Indicator],
        removed: Change,
        came: Change,
        went: Change,
    ) -> Change:
        """Every row of the stratum that some derivation rests on a change of; a superset of what must go."""
        view = _Before(relations, went)
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
        stratum: frozenset[Indicator],
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
                if row in given[indicator] or any(_derives(check, relations, row, failures) for check in checks):
                    fresh.setdefault(indicator, {})[row] = None

    def _checks_of(self, indicator: Indicator) -> list[Join]:
        found = self._checks.get(indicator)
        if found is None:
            found = self._checks[indicator] = [Join(rule, bound_head=True) for rule in self.program.rules[indicator]]
        return found

    def _insert(
        self,
        relations: Mapping[Indicator, Relation],
        stratum: frozenset[Indicator],
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
        stratum: frozenset[Indicator],
        relations: Mapping[Indicator, Relation],
        fresh: Change,
        failures: list[Failure],
    ) -> None:
        if not rows:
            return
        for plan in self._plans.get((indicator, negated), ()):
            if plan.head in stratum:
                found: dict[Row, None] = {}
                plan.gives.run(relations, rows, found.setdefault, None, _noting(plan.rule, failures))
                known = relations[plan.head]
                for row in found:
                    if row not in known:
                        fresh.setdefault(plan.head, {})[row] = None

    def _limit(self, relations: Mapping[Indicator, Relation], over: Change) -> None:
        gone = sum(map(len, over.values()))
        if gone > LEAST_TO_RECOMPUTE and gone > 0.1 * sum(map(len, relations.values())):
            raise TooMuch


def _noting(rule: Clause, failures: list[Failure]) -> Callable[[Bindings], None]:
    def failed(known: Bindings) -> None:
        failures.append((rule, known))

    return failed


def _derives(check: Join, relations: Mapping[Indicator, Relation], row: Row, failures: list[Failure]) -> bool:
    """Whether a rule gives a row; where an evaluation fails, the row's value for its result was never worked out."""
    computed = {v for x in check.clause.body if x.is_aggregate for v in variables_of(x.atom[3])}
    computed |= {v for x in check.clause.body if x.is_comparison for v in variables_of(x.atom[1])}

    def failed(known: Bindings) -> None:
        failures.append((check.clause, {v: value for v, value in known.items() if v not in computed}))

    return check.derives(relations, row, failed)


class _Before(dict[Indicator, Relation]):
    """The relations with the rows that already went in lower strata laid back in."""

    def __init__(self, relations: Mapping[Indicator, Relation], went: Change) -> None:
        super().__init__()
        self.relations, self.went = relations, went

    def __missing__(self, indicator: Indicator) -> Relation:
        rows = self.went.get(indicator)
        relation = self.relations[indicator]
        found = _With(relation, rows) if rows else relation
        self[indicator] = found
        return found


class _With(Relation):
    """A relation together with some more rows, to be looked up only."""

    def __init__(self, below: Relation, more: Iterable[Row]) -> None:
        super().__init__(below.name, below.arity, more)
        self.below = below

    def matching(self, columns: Columns, key: Row) -> Collection[Row]:
        return [*self.below.matching(columns, key), *super().matching(columns, key)]


