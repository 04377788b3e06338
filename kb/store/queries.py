"""Queries and their answers: conditions in any direction, each answer once, the undefined ones told apart."""

from __future__ import annotations

import time
from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import islice
from typing import TYPE_CHECKING, TypeAlias

from casper.kb.errors import BudgetExceeded, NotOnColumns, Undefined
from casper.kb.program.control import plain_query
from casper.kb.program.refusals import check_computable, check_defined
from casper.kb.reasons.doubt import Doubt, doubt_of
from casper.kb.relations.relation import Row
from casper.kb.terms.clauses import Clause, Indicator, Literal
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, Variable
from casper.kb.terms.unification import Bindings, is_ground, substitute, variables_of
from casper.kb.terms.unknown import closed
from casper.kb.text.reader import read_query
from casper.kb.top_down.answering import Answering
from casper.kb.top_down.compiled.cells import variant
from casper.kb.top_down.joining import join_on_columns
from casper.kb.top_down.linking import Links
from casper.kb.top_down.plan import Plan, on_columns, plan_of

if TYPE_CHECKING:
    from casper.kb.relations.tables.answers import Answers
    from casper.kb.relations.tables.joins import Join

Clauses: TypeAlias = Mapping[Indicator, tuple[Clause, ...]]
Doubted: TypeAlias = tuple[tuple[Variable, ...], Row, str]  # what is asked for, an undefined answer, and the reason
MOST_REMEMBERED = 1024  # texts of queries
AT_FIRST = 1_000  # answers that come row by row, at once, before many are joined on columns
MOST_ANSWERS = 5_000_000  # that are told apart row by row: a GB
conditions_of = lru_cache(maxsize=MOST_REMEMBERED)(read_query)


@dataclass(frozen=True, slots=True)
class Query:
    """The alternatives of a query, each with what it asks for, and the clauses of goals inside it."""

    alternatives: tuple[tuple[tuple[Variable, ...], tuple[Literal, ...]], ...]
    inner: Clauses


def query_of(goal: str, clauses: Clauses) -> Query:
    """A query of text, checked against the program's clauses.

    Raises:
        ReadError, ProgramError: with the place of the mistake.
    """
    known: dict[Indicator, tuple[Clause, ...]] = {}
    alternatives: list[tuple[tuple[Variable, ...], tuple[Literal, ...]]] = []
    asked = conditions_of(goal)
    everyone = dict.fromkeys(v for body in asked for x in body for v in x.variables())
    for number, written in enumerate(asked):
        here = {v for x in written for v in x.variables()}
        named = [v for v in everyone if v in here and not v.name.startswith("_")]
        bodies, made = plain_query(written, f"asked {number} ")
        alternatives.extend((tuple(named), body) for body in bodies)
        for clause in made:
            known[clause.head.indicator] = (*known.get(clause.head.indicator, ()), clause)
    everything = {**clauses, **known} if known else clauses
    for body in (*(body for _, body in alternatives), *(c.body for found in known.values() for c in found)):
        for literal in body:
            check_defined(literal, everything)
            check_computable(literal)
    return Query(tuple(alternatives), known)


def join_of_query(query: Query, links: Links) -> Join | str | None:
    """A query that has many answers as a join on columns; what is in the way of it, or None where it has few."""
    if len(query.alternatives) != 1 or query.inner:
        return None
    [(variables, body)] = query.alternatives
    return join_on_columns(body, variables, links)


def plan_of_query(query: Query, links: Links) -> Plan:
    """How a query would be answered."""
    columns = on_columns(join_of_query(query, links))
    if query.inner:
        links = Links(links.relations, links.code.extended(query.inner), links.computed)
    return plan_of([links.code.query(body) for _, body in query.alternatives], links, columns)


def answers(
    query: Query, solver: Answering, limit: int | None = None, timeout: float | None = None, undefined: bool = False
) -> Iterator[dict[str, Term]]:
    """The answers that hold, each once, lazily, by the names of what is asked for; or those that are undefined.

    Args:
        solver: a fresh search over the state that is asked; it must keep that state as it is.
        limit: stop after so many answers.
        timeout: seconds from now on, after which the rest is unknown.
        undefined: give the answers that are neither true nor false instead.

    Raises:
        BudgetExceeded, ProgramError: as the solver.
        Undefined: after the last true answer, when there are undefined ones.
    """
    if limit is not None and limit <= 0:
        return
    solver.deadline = None if timeout is None else time.monotonic() + timeout
    seen: set[Hashable] = set()
    doubts: dict[Hashable, Doubted] = {}
    solver = solver.with_inner(query.inner)
    early: list[Row] = []
    asked: dict[tuple[Variable, ...], int] = {}  # a number is faster than names in a key
    for variables, body in query.alternatives:
        names, number = [variable.name for variable in variables], asked.setdefault(variables, len(asked))
        for row, doubt in solver.rows(body, variables):
            key = number, variant(row)
            if doubt:
                doubts.setdefault(key, (variables, row, doubt))
            elif key not in seen:
                seen.add(key)
                if len(seen) <= AT_FIRST:
                    early.append(row)
                if not undefined:
                    yield dict(zip(names, row))
                    if len(seen) == limit:  # the next answer may be far away
                        return
                if len(seen) == AT_FIRST and not undefined:
                    given = set(early)
                    try:
                        beyond = islice(_beyond(query, given, solver), limit and limit - AT_FIRST)
                        yield from (dict(zip(names, row)) for row in beyond)
                        return
                    except NotOnColumns:  # so the rest comes row by row
                        seen.update((number, variant(row)) for row in given)
                elif len(seen) > MOST_ANSWERS:
                    raise BudgetExceeded(f"there are more than {MOST_ANSWERS:,} answers, too many to tell apart")
    left = [doubt for key, doubt in doubts.items() if key not in seen]
    if undefined:
        yield from ({v.name: value for v, value in zip(variables, row)} for variables, row, _ in islice(left, limit))
    elif left and (limit is None or len(seen) < limit):
        raise Undefined(_undefined_answers(left))


def _beyond(query: Query, given: set[Row], solver: Answering) -> Iterator[Row]:
    """The answers to a query that has many, but for those that were given.

    Raises:
        NotOnColumns: it cannot be worked out on columns; what came is among those given.
    """
    join = join_of_query(query, solver.links)
    if join is None or isinstance(join, str):
        raise NotOnColumns(join or "there are few answers")
    from casper.kb.relations.tables.joins import rows_beyond  # numpy is loaded when there are many

    look = solver.meter(join.body)
    return rows_beyond(join, given, lambda: look(0))


def table_of(query: Query, solver: Answering, timeout: float | None = None) -> Answers | None:
    """The answers to a query that has many, joined on columns; None where they have to come row by row.

    Raises:
        BudgetExceeded: there are too many for a table, or the ``timeout`` (in seconds from now on) is over.
    """
    join = join_of_query(query, solver.links)
    if join is None or isinstance(join, str):
        return None
    from casper.kb.relations.tables.answers import of_join  # numpy is loaded when there are many

    solver.deadline = None if timeout is None else time.monotonic() + timeout
    look = solver.meter(join.body)
    try:
        return of_join(join, lambda: look(0))
    except NotOnColumns:
        return None


def _undefined_answers(left: Sequence[Doubted]) -> str:
    """The sentence for answers that are undefined."""
    variables, row, reason = left[0]
    shown = ", ".join(f"{v.name} = {term_text(closed(value))}" for v, value in zip(variables, row)) or "the answer"
    more = f" and {len(left) - 1} more" if len(left) > 1 else ""
    return f"{shown}{more} {'are' if more else 'is'} undefined: {reason}"


def instances(atom: Compound, search: Callable[[], Answering]) -> Iterator[Compound]:
    """Every instance of one atom that holds, lazily, each once; a part that may be anything stays a variable.

    Args:
        search: makes a fresh search over the state that is asked.

    Raises:
        Undefined: after the last one, when some other instance is undefined.
    """
    seen: set[Hashable] = set()
    doubts: dict[Hashable, Compound] = {}
    names = list(variables_of(atom))
    parts = [(part, is_ground(part)) for part in atom]  # a long list is not copied for every answer
    for row, doubt in search().rows([Literal(atom)], names):
        values: Bindings = {name: value for name, value in zip(names, row) if value is not name}
        instance = Compound([part if is_closed else substitute(part, values) for part, is_closed in parts])
        key = variant(row)
        if doubt:
            doubts.setdefault(key, instance)
        elif key not in seen:
            seen.add(key)
            yield instance
    doubtful = next((instance for key, instance in doubts.items() if key not in seen), None)
    if doubtful is not None:
        raise Undefined((doubt_of(doubtful, search()) or Doubt(doubtful)).sentence)
