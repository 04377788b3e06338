"""What a program means, without the knowledge base's own machinery: brute force over all values.

`model` is the well-founded model by alternation (Van Gelder, 1989): what is certain, given what may be, and back.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, TypeAlias

from casper.kb.terms.clauses import Clause, Literal
from casper.kb.terms.terms import Compound, Variable
from casper.kb.terms.unification import is_ground

Environment: TypeAlias = dict[Any, Any]
Atoms: TypeAlias = set[Any]


def match(pattern: Any, value: Any, environment: Environment | None) -> Environment | None:
    """The environment extended so that the pattern is the ground value, or None."""
    if environment is None:
        return None
    if isinstance(pattern, Variable):
        if pattern in environment:
            return environment if environment[pattern] == value else None
        return {**environment, pattern: value}
    if isinstance(pattern, tuple):
        if not isinstance(value, tuple) or len(pattern) != len(value):
            return None
        for part, other in zip(pattern, value):
            environment = match(part, other, environment)
        return environment
    return environment if pattern == value else None


def put(term: Any, environment: Environment) -> Any:
    """The term with the variables replaced that the environment knows."""
    if isinstance(term, Variable):
        return environment.get(term, term)
    return Compound([put(part, environment) for part in term]) if isinstance(term, tuple) else term


def compared(operator: str, left: Any, right: Any) -> bool | None:
    """A comparison of ground terms; None when it is undefined."""
    if operator in ("=", "=="):
        return bool(left == right)
    if operator in ("\\=", "\\=="):
        return bool(left != right)
    if not (isinstance(left, (int, float)) and isinstance(right, (int, float))):
        return None
    found: dict[str, bool] = {
        "<": left < right, ">": left > right, "=<": left <= right, ">=": left >= right, "=:=": left == right,
    }  # fmt: skip
    return found[operator]


def holds(literal: Literal, rows: Atoms, possible: Atoms | None = None) -> bool | None:
    """Whether an instantiated condition holds, where some atoms do and others may; what is left open may be anything.

    None when it is undefined. Without ``possible`` no atom is.
    """
    possible = rows if possible is None else possible
    if literal.is_comparison:
        found = compared(*literal.atom)
    else:
        found = _stands(literal.atom, rows) or (None if _stands(literal.atom, possible) else False)
    return found if found is None else found is not literal.negated


def _stands(atom: Any, rows: Atoms) -> bool:
    return atom in rows if is_ground(atom) else any(match(atom, r, {}) is not None for r in rows)


def solutions(
    body: Sequence[Literal], rows: Atoms, environment: Environment, possible: Atoms | None = None
) -> Iterator[Environment]:
    """Every way to satisfy the body: positive conditions first, then ``=``, then the tests.

    Positive conditions stand in ``rows``; a test must hold (with ``possible``: under a negation, of what may hold).
    """
    yield from (found for found, sure in _ways(body, rows, environment, rows, possible or rows) if sure)


def _ways(
    body: Sequence[Literal], rows: Atoms, environment: Environment, certain: Atoms, possible: Atoms
) -> Iterator[tuple[Environment, bool]]:
    """Ways to satisfy the body by rows, each with whether its tests hold for certain: none of them is false."""
    for at, literal in enumerate(body):
        rest = [*body[:at], *body[at + 1 :]]
        if not literal.negated and not literal.is_comparison:
            for row in rows:
                extended = match(put(literal.atom, environment), row, environment)
                if extended is not None:
                    yield from _ways(rest, rows, extended, certain, possible)
            return
    for at, literal in enumerate(body):
        if literal.atom[0] == "=" and not literal.negated:
            left, right = put(literal.atom[1], environment), put(literal.atom[2], environment)
            if is_ground(left) or is_ground(right):
                pattern, value = (right, left) if is_ground(left) else (left, right)
                extended = match(pattern, value, environment)
                if extended is not None:
                    yield from _ways([*body[:at], *body[at + 1 :]], rows, extended, certain, possible)
                return
    truths = [holds(Literal(put(x.atom, environment), x.negated), certain, possible) for x in body]
    if False not in truths:
        yield environment, None not in truths


def model(clauses: Sequence[Clause]) -> tuple[Atoms, Atoms]:
    """The atoms that hold and those that may: the well-founded model of the whole program, by alternation."""
    certain: Atoms = set()
    while True:
        possible = _least(clauses, certain, None)
        grown = _least(clauses, None, possible)
        if grown == certain:
            return certain, possible
        certain = grown


def _least(clauses: Sequence[Clause], certain: Atoms | None, possible: Atoms | None) -> Atoms:
    """The least set that the clauses give: what may hold, given what is certain; or what is certain, given what may."""
    rows: Atoms = set()
    while True:
        found = {
            put(c.head, s)
            for c in clauses
            for s, sure in _ways(list(c.body), rows, {}, rows if certain is None else certain, possible or rows)
            if sure or certain is not None
        }
        if found <= rows:
            return rows
        rows |= found
