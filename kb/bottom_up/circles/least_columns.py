"""A recursive minimum on numpy columns: the best value of every key in one array, improved until nothing gets better.

Only for rules with at most one recursive condition that never make a worse row of a better premise (`monotone`): the
order in which rows get better then changes nothing, so the best are followed first, as Dijkstra's algorithm does.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from casper.kb.bottom_up.circles.monotone import check_monotone
from casper.kb.bottom_up.join import ordered_body
from casper.kb.bottom_up.size import Room
from casper.kb.errors import BudgetExceeded, NotOnColumns
from casper.kb.program.declarations import Moded
from casper.kb.program.program import Program
from casper.kb.relations.coded import Coded, coded, number_of
from casper.kb.relations.column_relation import ColumnRelation
from casper.kb.relations.columns import MOST_CODES, Ids, Table, code, decode
from casper.kb.relations.constants import Constants
from casper.kb.relations.relation import Relation
from casper.kb.relations.tables.joins import Join, Solutions, join_of
from casper.kb.relations.tables.masks import Column, Frame, Values, codes, numbers
from casper.kb.terms.clauses import Clause, Indicator, Literal
from casper.kb.terms.terms import Variable
from casper.kb.terms.unification import variables_of

MOST_KEYS = 1 << 26  # for which there may be an entry each
FEW = 256  # rows, on average, that have to be followed at once for columns to be worth it
WARMING_UP = 100  # steps before that is looked at
AT_ONCE = 1 << 14  # keys from which only the best eighth of those that got better is followed
Heights: TypeAlias = NDArray[np.float64]
Found: TypeAlias = tuple[Indicator, Ids, Heights]  # rows: keys, and values in the order of "better is less"


@dataclass(frozen=True)
class _Rule:
    """A rule; ``seed`` is its recursive condition, whose rows come from outside, and ``rest`` what is joined to it."""

    clause: Clause
    seed: Literal | None
    rest: Join


def least_on_columns(
    program: Program, stratum: frozenset[Indicator], relations: dict[Indicator, Relation], room: Room, round_: int
) -> int:
    """Give a stratum of predicates with a moded argument its rows; the last round's number.

    Raises:
        NotOnColumns: it is not what columns can do; nothing has changed then. BudgetExceeded: it improves without end.
    """
    rules = [_compiled(rule, stratum, program.least, relations) for i in sorted(stratum) for rule in program.rules[i]]
    search = _Search(rules, {i: program.least[i] for i in stratum}, program.given, room)
    search.run()
    rounds = search.rounds(round_)
    relations.update({i: search.relation(i, rounds[i]) for i in stratum})
    return max([round_, *(int(found.max(initial=0)) for found in rounds.values())])


def _compiled(
    rule: Clause,
    stratum: frozenset[Indicator],
    least: Mapping[Indicator, Moded],
    relations: Mapping[Indicator, Relation],
) -> _Rule:
    inner = [at for at, x in enumerate(rule.body) if x.needed in stratum]
    if len(inner) > 1:
        raise NotOnColumns(f"{rule} has two recursive conditions")
    seed = rule.body[inner[0]] if inner else None
    if seed is not None:
        check_monotone(rule, inner[0], (least[seed.atom.indicator], least[rule.head.indicator]))
    order = [x for x, _ in ordered_body(rule.body, inner[0] if inner else None) if x is not seed]
    if not all(isinstance(arg, Variable) or not isinstance(arg, tuple) for arg in rule.head.args):
        raise NotOnColumns(f"the head of {rule} is made of terms")
    known = set() if seed is None else set(seed.variables())
    return _Rule(rule, seed, join_of(order, tuple(variables_of(*rule.head.args)), relations.get, known))


class _Search:
    """The best values known, and the rows that got better since they were last followed."""

    def __init__(
        self, rules: Sequence[_Rule], modes: Mapping[Indicator, Moded], given: Mapping[Indicator, Any], room: Room
    ) -> None:
        self.rules, self.modes, self.room = rules, modes, room
        self.given = {i: Relation(*i, given[i]) for i in modes}
        everything = [*self.given.values(), *(r for rule in rules for r in rule.rest.relations.values())]
        self.columns = coded(everything)
        self.constants: Constants = next(iter(self.columns.values())).constants
        self.joined = {id(rule): Solutions(rule.rest, self.columns, self.constants) for rule in rules}
        for rule in rules:
            for arg in (*rule.clause.head.args, *(() if rule.seed is None else rule.seed.atom.args)):
                if not isinstance(arg, Variable):
                    number_of(arg, self.constants)
        self.base = len(self.constants.interner)
        if any(self.base ** (arity - 1) > MOST_KEYS for _, arity in modes):
            raise NotOnColumns("there are too many keys")
        self.best = {i: np.full(self.base ** (i[1] - 1), np.inf) for i in modes}
        self.better = {i: np.zeros(len(self.best[i]), bool) for i in modes}
        self.kind: np.dtype[Any] | None = None  # of the values: all whole, or all floats
        self.is_strict = True  # whether every row was worse than its premise, which then comes before it

    def run(self) -> None:
        """Improve until nothing gets better."""
        self._offer(found for i in self.modes for found in self._stated(i))
        self._offer(found for rule in self.rules if rule.seed is None for found in self._derived(rule, {}, 1))
        known, steps, followed = 0, 0, 0
        few = FEW + sum(map(len, self.best.values())) // 4096  # rows that cost less than a look at all keys
        while any(better.any() for better in self.better.values()):
            size = sum(int(np.isfinite(best).sum()) for best in self.best.values())
            self.room.take(size - known)
            known, steps = size, steps + 1
            if steps > 9 * (size + 64):  # after so many rounds of all, a row would rest on one of the same key
                name, arity = min(self.modes)
                raise BudgetExceeded(f"the rows of {name}/{arity} improve without end: the answer is unknown")
            picked = {i: self._picked(i, steps > 8 * (size + 64)) for i in self.modes}
            for indicator, keys in picked.items():
                self.better[indicator][keys] = False
                followed += len(keys)
            if steps > WARMING_UP and followed < steps * few:
                raise NotOnColumns("rows get better a few at a time")
            self._offer(found for i, keys in picked.items() for found in self._followed(i, keys))

    def _picked(self, indicator: Indicator, is_late: bool) -> Ids:
        """Rows that got better, to be followed next: of many the best."""
        keys = np.flatnonzero(self.better[indicator])
        if is_late or len(keys) <= AT_ONCE:
            return keys
        values = self.best[indicator][keys]
        found: Ids = keys[values <= np.partition(values, len(keys) // 8)[len(keys) // 8]]
        return found

    def _offer(self, found: Iterator[Found]) -> None:
        for indicator, keys, values in found:
            best = self.best[indicator]
            at = np.flatnonzero(values < best[keys])
            if len(at):
                np.minimum.at(best, keys[at], values[at])
                self.better[indicator][keys[at]] = True

    def _stated(self, indicator: Indicator) -> Iterator[Found]:
        """What is given."""
        rows: Coded = self.columns[id(self.given[indicator])]
        if rows.size:
            at = self.modes[indicator].at
            keys = code([c for n, c in enumerate(rows.columns) if n != at], self.base, rows.size)
            yield indicator, keys, self._heights(indicator, rows.columns[at])

    def _followed(self, indicator: Indicator, keys: Ids) -> Iterator[Found]:
        """What the rules give of rows."""
        for rule in self.rules if len(keys) else ():
            if rule.seed is not None and rule.seed.atom.indicator == indicator:
                frame, size = self._seeded(rule.seed, keys)
                yield from self._derived(rule, frame, size)

    def _seeded(self, seed: Literal, keys: Ids) -> tuple[Frame, int]:
        """The frame in which a recursive condition is the given rows."""
        at, mode = self.modes[seed.atom.indicator]
        values = self.best[seed.atom.indicator][keys] * (1 if mode == "min" else -1)
        columns = list(decode(keys, self.base, seed.atom.arity - 1))
        columns.insert(at, keys)
        keep = np.ones(len(keys), bool)
        frame: dict[Variable, Column] = {}
        for place, (arg, column) in enumerate(zip(seed.atom.args, columns)):
            if place == at:
                continue
            if not isinstance(arg, Variable):
                keep &= column == number_of(arg, self.constants)
            elif arg in frame:
                keep &= codes(frame[arg], self.constants) == column
            else:
                frame[arg] = column
        frame[seed.atom.args[at]] = Values(values if self.kind is None else values.astype(self.kind))
        kept: Frame = {
            v: Values(c.array[keep]) if isinstance(c, Values) else c[keep] for v, c in frame.items()
        }
        return kept, int(keep.sum())

    def _derived(self, rule: _Rule, frame: Frame, size: int) -> Iterator[Found]:
        """The rows that a rule gives."""
        head = rule.clause.head
        at = self.modes[head.indicator].at
        for solution in self.joined[id(rule)].extending(frame, size):
            found = len(next((c.array if isinstance(c, Values) else c for c in solution.values()), range(1)))
            args = [self._column(arg, solution, found) for arg in head.args]
            values = self._heights(head.indicator, args[at])
            if rule.seed is not None and self.is_strict:
                indicator = rule.seed.atom.indicator
                before = self._heights(indicator, solution[rule.seed.atom.args[self.modes[indicator].at]])
                self.is_strict = bool((before < values).all())
            keys = [codes(column, self.constants) for n, column in enumerate(args) if n != at]
            if any(int(key.max(initial=0)) >= self.base for key in keys):
                raise NotOnColumns("a key is a computed number")
            yield head.indicator, code(keys, self.base, found), values

    def _column(self, arg: Any, frame: Frame, size: int) -> Column:
        if isinstance(arg, Variable):
            return frame[arg]
        return np.full(size, number_of(arg, self.constants), np.int64)

    def _heights(self, indicator: Indicator, column: Column) -> Heights:
        """Values in the order of "better is less"."""
        values = numbers(column, self.constants)
        if len(values) and self.kind not in (None, values.dtype):
            raise NotOnColumns("some values are whole numbers and some are not")
        self.kind = self.kind or (values.dtype if len(values) else None)
        return values.astype(np.float64) * (1 if self.modes[indicator].mode == "min" else -1)

    def rounds(self, round_: int) -> dict[Indicator, Ids]:
        """For every best row, in the order of keys, a round after those of all that it rests on.

        Raises:
            NotOnColumns: some rows rest on one another alone.
        """
        final = {i: np.flatnonzero(np.isfinite(best)) for i, best in self.best.items()}
        if not self.is_strict:
            return self._reached(final, round_)
        values = {i: self.best[i][keys] for i, keys in final.items()}
        steps = np.unique(np.concatenate(list(values.values())))
        found = {i: round_ + 1 + np.searchsorted(steps, heights) for i, heights in values.items()}
        for indicator in final:
            for _, keys, heights in self._stated(indicator):
                stated = keys[heights == self.best[indicator][keys]]
                found[indicator][np.searchsorted(final[indicator], stated)] = 0
        return found

    def _reached(self, final: Mapping[Indicator, Ids], round_: int) -> dict[Indicator, Ids]:
        """The same by following the best rows from those that are given, round by round."""
        rounds = {i: np.full(len(best), -1, np.int64) for i, best in self.best.items()}
        fresh = self._take((found for i in self.modes for found in self._stated(i)), rounds, 0)
        found = [found for rule in self.rules if rule.seed is None for found in self._derived(rule, {}, 1)]
        while any(map(len, fresh.values())) or found:
            round_ += 1
            found += [each for i, keys in fresh.items() for each in self._followed(i, keys)]
            fresh, found = self._take(iter(found), rounds, round_), []
        if any((rounds[i][keys] < 0).any() for i, keys in final.items()):
            raise NotOnColumns("some rows rest on one another alone")
        return {i: rounds[i][keys] for i, keys in final.items()}

    def _take(self, found: Iterator[Found], rounds: dict[Indicator, Ids], round_: int) -> dict[Indicator, Ids]:
        """Give rows that are best and new their round; their keys."""
        fresh: dict[Indicator, list[Ids]] = {i: [np.empty(0, np.int64)] for i in self.modes}
        for indicator, keys, values in found:
            new = keys[(values == self.best[indicator][keys]) & (rounds[indicator][keys] < 0)]
            fresh[indicator].append(np.unique(new))
            rounds[indicator][new] = round_
        return {i: np.concatenate(parts) for i, parts in fresh.items()}

    def relation(self, indicator: Indicator, rounds: Ids) -> Relation:
        """The best rows as a relation."""
        (at, mode), arity = self.modes[indicator], indicator[1]
        keys = np.flatnonzero(np.isfinite(self.best[indicator]))
        values = self.best[indicator][keys] * (1 if mode == "min" else -1)
        columns = list(decode(keys, self.base, arity - 1))
        columns.insert(at, codes(Values(values if self.kind is None else values.astype(self.kind)), self.constants))
        base = len(self.constants.interner)
        if (base + 1) ** arity >= MOST_CODES:
            terms = [self.constants.terms(column).tolist() for column in columns]
            found = Relation(*indicator)
            found.rows = dict(zip(zip(*terms), rounds.tolist()))
            return found
        table = Table(arity, base)
        table.fill(code(columns, base, len(keys)), rounds)
        return ColumnRelation(*indicator, table, self.constants.interner)
