"""How a question will be answered: for each condition its turn, the index it is looked up by, and the method."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

from casper.kb.terms.clauses import Indicator, Literal
from casper.kb.terms.terms import Compound, Variable
from casper.kb.terms.unification import variables_of
from casper.kb.text.lines import Shown
from casper.kb.text.writer import literal_text
from casper.kb.top_down.compiled.code import Procedure
from casper.kb.top_down.linking import (
    ASKED,
    BUILT_IN,
    CONTROLLED,
    DOUBTFUL,
    PROVIDED,
    STORED,
    TABLED,
    Code,
    Link,
    Links,
)
from casper.kb.top_down.planning import binds, is_bound

if TYPE_CHECKING:
    from casper.kb.relations.tables.joins import Join

Asked: TypeAlias = tuple[Indicator, tuple[bool, ...]]  # a predicate, and which of its arguments are known


@dataclass(frozen=True, slots=True)
class Step:
    """One condition of a question, or of a rule behind it.

    Attributes:
        condition: as its author wrote it.
        method: how it is answered, in words.
        index: the columns that it is looked up by, from 1 on; empty where none is known, or nothing is looked up.
        depth: 0 for the question's own conditions, 1 for those of the rules behind them, and so on.
    """

    condition: str
    method: str
    index: tuple[int, ...] = ()
    depth: int = 0

    def __str__(self) -> str:
        return f"{'  ' * self.depth}{self.condition}   [{self.method}]"


@dataclass(frozen=True, slots=True)
class Plan(Shown):
    """The steps of every alternative, in the order in which they are taken; ``str()`` is one a line.

    ``columns`` says of a question with many answers whether they are joined on numpy columns, or what is in the way.
    """

    steps: tuple[Step, ...]
    columns: str = ""

    def __str__(self) -> str:
        return "\n".join([*map(str, self.steps), *filter(None, [self.columns])])


def on_columns(join: Join | str | None) -> str:
    """How a question is joined on columns, or what is in the way; nothing of one that has few answers."""
    if join is None or isinstance(join, str):
        return f"row by row, not on columns: {join}" if join else ""
    return f"many answers, so on columns: {', '.join(map(literal_text, join.body))}"


def plan_of(bodies: Iterable[Sequence[Literal]], links: Links, columns: str = "") -> Plan:
    """The plan of a question's alternatives."""
    told: set[Asked] = set()
    return Plan(tuple(step for body in bodies for step in _body(body, set(), links, 0, told)), columns)


def _body(body: Sequence[Literal], known: set[Variable], links: Links, depth: int, told: set[Asked]) -> Iterator[Step]:
    bound = set(known)
    for literal in body:
        pattern = tuple(is_bound(arg, bound) for arg in literal.atom.args)
        if literal.is_comparison:
            yield Step(literal_text(literal), "compared, once its variables are known", (), depth)
        elif literal.is_aggregate:
            yield Step(literal_text(literal), "worked out of all answers", (), depth)
            inner: Compound = literal.atom[2]
            yield from _inside(inner, tuple(is_bound(arg, bound) for arg in inner.args), links, depth, told)
        else:
            link = links[literal.atom.indicator]
            method, index = _method(link, literal, pattern, links.code)
            method = f"nothing proves it: {method}" if literal.negated else method
            yield Step(literal_text(literal), method, index, depth)
            yield from _inside(literal.atom, pattern, links, depth, told)
        bound |= binds(literal, bound)


def _inside(atom: Compound, pattern: tuple[bool, ...], links: Links, depth: int, told: set[Asked]) -> Iterator[Step]:
    """The rules behind a condition, once."""
    if isinstance(links[atom.indicator].what, Procedure) and (atom.indicator, pattern) not in told:
        told.add((atom.indicator, pattern))
        yield from _rules(atom.indicator, pattern, links, depth + 1, told)


def _rules(
    indicator: Indicator,
    pattern: tuple[bool, ...],
    links: Links,
    depth: int,
    told: set[Asked],
) -> Iterator[Step]:
    """The conditions of the rules of a predicate, for what is known of its arguments."""
    for clause in links.code.clauses.get(indicator, ()):
        known = set(variables_of(*(arg for arg, is_known in zip(clause.head.args, pattern) if is_known)))
        yield from _body(links.code.body(clause, pattern), known, links, depth, told)


def _method(link: Link, literal: Literal, pattern: tuple[bool, ...], code: Code) -> tuple[str, tuple[int, ...]]:
    """How a predicate is answered, in words, and the columns it is looked up by."""
    name, arity = literal.atom.indicator
    shown = f"{name.rpartition(': ')[2]}/{arity}"
    if link.how in (STORED, DOUBTFUL):
        return _look_up(shown, pattern, len(link.what))
    if link.how == BUILT_IN or link.how == CONTROLLED:
        return "built-in", ()
    if link.how == ASKED:
        return "computed from statements and constraints", ()
    if link.how == PROVIDED:
        return f"the best rows of {shown}, as far as they are asked for", ()
    if (name, arity) not in code.clauses:
        return "built-in, by clauses", ()
    found = len(link.what.all)
    known = ", by its first argument" if pattern and pattern[0] else ""
    if link.how == TABLED:
        return f"{found} clauses of {shown}{known}, each call worked out once (tabled)", ()
    return f"{found} clauses of {shown}{known}", ()


def _look_up(shown: str, pattern: tuple[bool, ...], rows: int) -> tuple[str, tuple[int, ...]]:
    index = tuple(column for column, is_known in enumerate(pattern, 1) if is_known)
    if len(index) == len(pattern):
        return f"looked up among the {rows:,} rows of {shown}", index
    if not index:
        return f"every one of the {rows:,} rows of {shown}", index
    columns = " and ".join(map(str, index))
    return f"index on column {columns} of the {rows:,} rows of {shown}", index
