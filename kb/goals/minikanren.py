"""miniKanren with the knowledge base's relations and streams: the same names as kanren's, to be imported instead.

    from casper.kb.goals.minikanren import Relation, conde, eq, fact, facts, lall, neq, run, var

    parent = Relation("parent")
    facts(parent, ("homer", "bart"), ("homer", "lisa"))
    child = var()
    run(0, child, parent("homer", child))

Unlike kanren's: a lookup goes through an index of every bound column, bound by an earlier goal too; a ground "no" is a
set test; disequalities are kept; conjunctions are linear and long ones no RecursionError (`streams`); ``eq((x,), x)``
fails where kanren goes on forever. A relation that calls itself is marked with ``@defrel``, or takes the state and
hands on a composed goal, as kanren's own do (``return goal(state)``).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import count
from typing import Any

from kanren.constraints import neq
from kanren.core import fail, succeed
from unification import Var, isvar, reify, unifiable, unify, variables, vars

from casper.kb.goals.goals import stored_goal
from casper.kb.goals.lists import (
    appendo,
    conso,
    heado,
    itero,
    membero,
    nullo,
    permuteo,
    permuteq,
    rembero,
    tailo,
)
from casper.kb.goals.streams import Goal, State, conde, defrel, delay, eq, lall, lany, run, var
from casper.kb.relations.relation import Relation as Rows

Zzz = delay
_numbers = count()


class Relation:
    """Facts that can be asked in every direction; callable with terms to make a goal."""

    def __init__(self, name: str | None = None) -> None:
        self.name = name or f"relation_{next(_numbers)}"
        self._by_arity: dict[int, Rows] = {}

    def add_fact(self, *row: Any) -> None:
        """Add one fact."""
        self._rows(len(row)).add(row)

    def _rows(self, arity: int) -> Rows:
        found = self._by_arity.get(arity)
        if found is None:
            found = self._by_arity[arity] = Rows(self.name, arity)
        return found

    @property
    def facts(self) -> set[tuple[Any, ...]]:
        """Every fact, as kanren's relation shows them."""
        return {row for rows in self._by_arity.values() for row in rows}

    def __call__(self, *args: Any) -> Goal:
        """A goal that holds for every fact the arguments can be."""
        rows = self._rows(len(args))

        def goal(state: State) -> Iterator[State]:
            return stored_goal(rows, reify(args, state), state)

        return goal

    def __repr__(self) -> str:
        return f"<relation {self.name}>"


def fact(relation: Relation, *row: Any) -> None:
    """Declare one fact of a relation."""
    relation.add_fact(*row)


def facts(relation: Relation, *rows: Iterable[Any]) -> None:
    """Declare several facts of a relation."""
    for row in rows:
        relation.add_fact(*row)


__all__ = ["Goal", "Relation", "Var", "Zzz", "appendo", "conde", "conso", "defrel", "delay", "eq", "fact", "facts"]
__all__ += ["fail", "heado", "isvar", "itero", "lall", "lany", "membero", "neq", "nullo", "permuteo", "permuteq"]
__all__ += ["reify", "rembero", "run", "succeed", "tailo", "unifiable", "unify", "var", "variables", "vars"]
