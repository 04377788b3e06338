"""Negation in a circle on columns: the instances of its rules come out of numpy joins, and are then settled."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from casper.kb.bottom_up.circles.ground import TRUE, UNDECIDED, Ground
from casper.kb.bottom_up.columnar import ColumnStratum
from casper.kb.relations.columns import Ids, Interner, Table, code, decode
from casper.kb.relations.relation import Row
from casper.kb.terms.clauses import Clause, Indicator, Literal


def is_plain_circle(rules: list[Clause], stratum: frozenset[Indicator]) -> bool:
    """Whether no negation within the circle has a wildcard: each instance then denies one atom."""
    negations = (x for rule in rules for x in rule.body if x.negated and x.needed in stratum)
    return not any(v.is_anonymous for x in negations for v in x.variables())


def settle_columns(
    tables: dict[Indicator, Table],
    interner: Interner,
    stratum: frozenset[Indicator],
    rules: list[Clause],
    check: Callable[..., None],
    round_: int,
) -> tuple[int, dict[Indicator, list[Row]]]:
    """Give the tables of a circle the rows that hold; the last round's number, and the undefined rows.

    Args:
        tables: of every predicate; those of the stratum hold what is given, and are replaced.
        check: told how many rows are new; raises when there are too many.
    """
    given = {i: _codes(tables[i]) for i in stratum}
    possible = [replace(rule, body=tuple(x for x in rule.body if not _is_inner(x, stratum))) for rule in rules]
    solver = ColumnStratum(tables, interner, stratum, possible, check)
    solver.run(round_)
    atoms = _Atoms({i: np.sort(_codes(tables[i])) for i in sorted(stratum)})
    heads: list[Ids] = []
    needed: list[tuple[Ids, Ids]] = []
    denied: list[tuple[Ids, Ids]] = []
    count = 0
    for rule, positive in zip(rules, possible):
        frame, size = solver.solutions(positive.body, rule.head.indicator)
        if not size:
            continue
        numbers = np.arange(count, count + size)
        count += size
        heads.append(atoms.number(rule.head.indicator, solver.codes(rule.head, frame, size))[0])
        for literal in rule.body:
            if literal.needed in stratum:
                found, known = atoms.number(literal.needed, solver.codes(literal.atom, frame, size))
                (denied if literal.negated else needed).append((found[known], numbers[known]))
    ground = _ground(atoms.size, heads, needed, denied)
    for indicator, codes in given.items():
        for number in atoms.number(indicator, codes)[0].tolist():
            ground.state_true(number, -round_)  # what is given comes in round 0
    ground.run()
    return _taken(ground, atoms, tables, interner, round_)


def _is_inner(literal: Literal, stratum: frozenset[Indicator]) -> bool:
    return literal.negated and literal.needed in stratum


def _codes(table: Table) -> Ids:
    return code(table.all_rows(), table.base, len(table))


@dataclass
class _Atoms:
    """Numbers for the possible rows of a circle's predicates, by their codes."""

    codes: Mapping[Indicator, Ids]

    def __post_init__(self) -> None:
        self.begin: dict[Indicator, int] = {}
        self.size = 0
        for indicator, codes in self.codes.items():
            self.begin[indicator] = self.size
            self.size += len(codes)

    def number(self, indicator: Indicator, codes: Ids) -> tuple[Ids, Ids]:
        """The numbers of rows, and at which places there is one."""
        known = self.codes[indicator]
        at = np.searchsorted(known, codes)
        at[at == len(known)] = 0
        there = known[at] == codes if len(known) else np.zeros(len(codes), bool)
        return at + self.begin[indicator], np.flatnonzero(there)


def _ground(size: int, heads: list[Ids], needed: list[tuple[Ids, Ids]], denied: list[tuple[Ids, Ids]]) -> Ground:
    """The ground program of rules and their conditions, each given as (atoms, rules)."""
    ground = Ground()
    ground.heads = np.concatenate(heads).tolist() if heads else []
    count = len(ground.heads)
    ground.value, ground.height = [UNDECIDED] * size, [0] * size
    ground.left = np.bincount(ground.heads, minlength=size).tolist() if count else [0] * size
    ground.needing, ground.denying = [[] for _ in range(size)], [[] for _ in range(size)]
    ground.premises = [[] for _ in range(count)]
    waiting = np.zeros(count, np.int64)
    for uses, conditions in ((ground.needing, needed), (ground.denying, denied)):
        for atoms, rules in conditions:
            waiting += np.bincount(rules, minlength=count)
            for atom, rule in zip(atoms.tolist(), rules.tolist()):
                uses[atom].append(rule)
    for atoms, rules in needed:
        for atom, rule in zip(atoms.tolist(), rules.tolist()):
            ground.premises[rule].append(atom)
    ground.waiting = waiting.tolist()
    return ground


def _taken(
    ground: Ground, atoms: _Atoms, tables: dict[Indicator, Table], interner: Interner, round_: int
) -> tuple[int, dict[Indicator, list[Row]]]:
    """Put what holds into new tables, and decode what is undefined."""
    values, heights = np.array(ground.value, np.int8), np.array(ground.height, np.int64) + round_
    undefined: dict[Indicator, list[Row]] = {}
    last = round_
    for indicator, codes in atoms.codes.items():
        span = slice(atoms.begin[indicator], atoms.begin[indicator] + len(codes))
        holds, open_ = values[span] == TRUE, values[span] == UNDECIDED
        table = tables[indicator] = Table(indicator[1], tables[indicator].base)
        table.fill(codes[holds], heights[span][holds])
        last = max(last, int(heights[span][holds].max(initial=round_)))
        columns = [[interner.constants[n] for n in c.tolist()] for c in decode(codes[open_], table.base, indicator[1])]
        undefined[indicator] = list(zip(*columns))
    return last, undefined
