"""Semi-naive evaluation on columns: the joins of one stratum in numpy, for programs too large for Python rows.

It covers what large programs are made of: atoms of constants and variables, negation, and (dis)equality. A rule with
compound terms, arithmetic or order comparisons is left to `kb.bottom_up.materialise` (`is_columnar` tells).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from casper.kb.relations.columns import MOST_CODES, Ids, Interner, Table, code, decode
from casper.kb.terms.clauses import Clause, Indicator, Literal
from casper.kb.terms.terms import Compound, Variable

BLOCK = 1 << 21  # solutions that are in memory at once: what a round may hold besides the rows
Frame: TypeAlias = dict[Variable, Ids]  # the values of each variable in all partial solutions, in parallel


def is_columnar(rules: Iterable[Clause]) -> bool:
    """Whether every rule is plain enough for columns."""
    return all(
        all(not isinstance(arg, tuple) for atom in (rule.head, *(x.atom for x in rule.body)) for arg in atom.args)
        and all(not x.is_comparison or x.atom[0] in ("=", "\\=", "==", "\\==") for x in rule.body)
        and rule.head.arity > 0
        and all(x.is_comparison or x.atom.arity > 0 for x in rule.body)
        and not any(x.is_aggregate or _repeats_wildcard(x) for x in rule.body)
        for rule in rules
    )


def _repeats_wildcard(literal: Literal) -> bool:
    """``\\+ p(_X, _X)`` asks for equal columns, which an index of bound columns cannot tell."""
    variables = [arg for arg in literal.atom.args if isinstance(arg, Variable) and arg.is_anonymous]
    return literal.negated and len(set(variables)) < len(variables)


def fits(arities: Iterable[int], constants: int) -> bool:
    """Whether rows of these arities over so many constants can be coded as one integer each."""
    return all((constants + 1) ** arity < MOST_CODES for arity in arities)


@dataclass
class _Rule:
    """A rule, and which of its conditions (if any) ranges over what is new."""

    number: int
    clause: Clause
    delta_at: int | None = None

    @cached_property
    def order(self) -> tuple[Literal, ...]:
        """The conditions in the order of evaluation: what is new comes first."""
        return _ordered(self.clause.body, self.delta_at)


class ColumnStratum:
    """The fixpoint of one stratum on tables.

    Args:
        tables: every predicate's table; those of the stratum grow.
        rules: the stratum's rules.
        check: called with a number of new rows (and perhaps what they are of); raises when there are too many.
    """

    def __init__(
        self,
        tables: Mapping[Indicator, Table],
        interner: Interner,
        stratum: frozenset[Indicator],
        rules: list[Clause],
        check: Callable[..., None],
    ) -> None:
        self.tables, self.interner, self.stratum, self.check = tables, interner, stratum, check
        self.first = [_Rule(number, rule) for number, rule in enumerate(rules)]
        self.recursive: dict[Indicator, list[_Rule]] = {}
        for number, rule in enumerate(rules):
            for at, literal in enumerate(rule.body):
                if not literal.negated and not literal.is_comparison and literal.atom.indicator in stratum:
                    self.recursive.setdefault(literal.atom.indicator, []).append(_Rule(number, rule, at))

    def run(self, round_: int) -> int:
        """Evaluate to the fixpoint; the last round's number."""
        found = [(rule.clause.head.indicator, self._derive(rule, None)) for rule in self.first if self._may_fire(rule)]
        while delta := self._add(found, round_ := round_ + 1):
            due = [rule for indicator in delta for rule in self.recursive.get(indicator, ())]
            found = [
                (rule.clause.head.indicator, self._derive(rule, delta[rule.order[0].atom.indicator]))
                for rule in sorted(due, key=lambda rule: rule.number)
            ]
        return round_

    def _may_fire(self, rule: _Rule) -> bool:
        """Whether there is something to look up for every condition."""
        looked_up = (x for x in rule.clause.body if not x.negated and not x.is_comparison)
        return all(len(self.tables[x.atom.indicator]) for x in looked_up)

    def _add(self, found: list[tuple[Indicator, list[Ids]]], round_: int) -> dict[Indicator, list[Ids]]:
        """Put what a round derived into the tables; what was new, by predicate."""
        by_head: dict[Indicator, list[list[Ids]]] = {}
        for indicator, columns in found:
            if len(columns[0]):
                by_head.setdefault(indicator, []).append(columns)
        delta: dict[Indicator, list[Ids]] = {}
        for indicator, parts in by_head.items():
            columns = [np.concatenate(column) for column in zip(*parts)]
            new = self.tables[indicator].add(columns, round_)
            if len(new[0]):
                delta[indicator] = new
        self.check(sum(len(new[0]) for new in delta.values()))
        return delta

    def _derive(self, rule: _Rule, delta: list[Ids] | None) -> list[Ids]:
        """The head's columns for every solution of the body; of more than one block only what is new."""
        head = rule.clause.head
        table, kept = self.tables[head.indicator], np.empty(0, np.int64)
        parts: list[list[Ids]] = []
        waiting = 0
        for frame, size in self._blocks(rule.order, delta):
            parts.append([self._column(arg, frame, size) for arg in head.args])
            waiting += size
            if waiting > max(BLOCK, len(kept)):
                codes = [code(part, table.base, len(part[0])) for part in parts]
                parts, waiting = [], 0
                kept = table.new(np.concatenate([kept, *codes]))
                self._check_aside(len(kept), head.indicator)
        return [np.concatenate(column) for column in zip(decode(kept, table.base, head.arity), *parts)]

    def _check_aside(self, waiting: int, indicator: Indicator) -> None:
        """Whether there is room for rows that are counted when they are added."""
        self.check(waiting, indicator)
        self.check(-waiting, indicator)

    def solutions(self, body: tuple[Literal, ...], indicator: Indicator) -> tuple[Frame, int]:
        """Every solution of the body of a rule for some predicate."""
        parts: list[Frame] = []
        size = 0
        for frame, more in self._blocks(_ordered(body, None), None):
            size += more
            self._check_aside(size, indicator)
            parts.append(frame)
        return {v: np.concatenate([part[v] for part in parts]) for v in (parts[0] if parts else ())}, size

    def _blocks(self, order: tuple[Literal, ...], delta: list[Ids] | None) -> Iterator[tuple[Frame, int]]:
        """The solutions in blocks; with a delta the first condition ranges over that."""
        if delta is None:
            return self._extended(order, 0, {}, 1)
        return self._extended(order, 1, *self._bind(order[0], {}, delta, len(delta[0])))

    def _extended(self, order: tuple[Literal, ...], at: int, frame: Frame, size: int) -> Iterator[tuple[Frame, int]]:
        """The solutions that extend some partial ones, depth first: at most one block is kept for each condition."""
        while size and at < len(order):
            literal, at = order[at], at + 1
            if literal.is_comparison:
                frame, size = self._compare(literal, frame, size)
            elif literal.negated:
                frame, size = self._absent(literal, frame, size)
            else:
                for extended, more in self._join(literal, frame, size):
                    yield from self._extended(order, at, extended, more)
                return
        if size:
            yield frame, size

    def codes(self, atom: Compound, frame: Frame, size: int) -> Ids:
        """The codes of an atom's rows, one for each solution."""
        return code([self._column(arg, frame, size) for arg in atom.args], self.tables[atom.indicator].base, size)

    def _column(self, arg: object, frame: Frame, size: int) -> Ids:
        if isinstance(arg, Variable):
            return frame[arg]
        return np.full(size, self.interner.intern(arg), np.int64)

    def _join(self, literal: Literal, frame: Frame, size: int) -> Iterator[tuple[Frame, int]]:
        table = self.tables[literal.atom.indicator]
        args = literal.atom.args
        bound = tuple(c for c, arg in enumerate(args) if not isinstance(arg, Variable) or arg in frame)
        keys = code([self._column(args[c], frame, size) for c in bound], table.base, size)
        for which, columns in table.join(bound, keys, BLOCK):
            extended = {variable: values[which] for variable, values in frame.items()}
            yield self._bind(literal, extended, columns, len(which))

    def _bind(self, literal: Literal, frame: Frame, columns: list[Ids], size: int) -> tuple[Frame, int]:
        """Give the literal's variables their columns; constants and repeated variables become filters."""
        keep = np.ones(size, dtype=bool)
        bound = dict(frame)
        for arg, values in zip(literal.atom.args, columns):
            if not isinstance(arg, Variable):
                keep &= values == self.interner.intern(arg)
            elif arg in bound:
                keep &= bound[arg] == values
            else:
                bound[arg] = values
        return _filtered(bound, keep)

    def _absent(self, literal: Literal, frame: Frame, size: int) -> tuple[Frame, int]:
        table = self.tables[literal.atom.indicator]
        args = literal.atom.args
        bound = tuple(c for c, arg in enumerate(args) if not isinstance(arg, Variable) or arg in frame)
        keys = code([self._column(args[c], frame, size) for c in bound], table.base, size)
        return _filtered(frame, ~table.any_match(bound, keys))

    def _compare(self, literal: Literal, frame: Frame, size: int) -> tuple[Frame, int]:
        operator, left, right = literal.atom
        wants_equal = (operator in ("=", "==")) != literal.negated
        for one, other in ((left, right), (right, left)):
            if isinstance(one, Variable) and one not in frame and wants_equal:
                return {**frame, one: self._column(other, frame, size)}, size
        equal = self._column(left, frame, size) == self._column(right, frame, size)
        return _filtered(frame, equal if wants_equal else ~equal)


def _filtered(frame: Frame, keep: NDArray[np.bool_]) -> tuple[Frame, int]:
    """The partial solutions that are kept, and how many."""
    if keep.all():
        return frame, len(keep)
    return {variable: values[keep] for variable, values in frame.items()}, int(keep.sum())


def _ordered(body: tuple[Literal, ...], delta_at: int | None) -> tuple[Literal, ...]:
    """The delta first, tests as soon as they are bound, then the condition with most bound columns."""
    from casper.kb.bottom_up.join import ordered_body

    return tuple(literal for literal, _ in ordered_body(body, delta_at))
