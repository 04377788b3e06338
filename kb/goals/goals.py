"""Relations as kanren goals: usable in ``run``, ``lall``, ``conde`` with anyone's goals, in every mode.

Unlike kanren's own ``Relation`` they look the index up with the arguments *walked through the state*, answer a ground
call by a set test, and keep the state's constraints (``neq`` and its kin), because a constrained state only ever grows
through ``unify``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager
from itertools import count
from typing import Any, Protocol, TypeAlias

from unification import Var, isvar, reify, unify, var
from unification.core import _reify, _reify_Iterable_ctor

from casper.kb.errors import Undefined
from casper.kb.goals.occurs import State, unified
from casper.kb.relations.relation import Relation, Row
from casper.kb.terms.clauses import Indicator
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, Variable, as_term
from casper.kb.terms.unknown import opened

Goal: TypeAlias = Callable[[State], Iterator[State]]


def _reify_compound(term: Compound, state: State) -> Any:
    return _reify_Iterable_ctor(Compound, term, state)


_reify.add((Compound, dict), _reify_compound)  # a reified compound stays one, and prints as one
_reify.add((Compound, object), _reify_compound)


class Answering(Protocol):
    """What a predicate asks of its knowledge base."""

    @property
    def lock(self) -> AbstractContextManager[object]:
        """Held while stored rows are looked up: other threads may change them."""

    def stored(self, indicator: Indicator, /) -> Relation | None:
        """The rows of a stored predicate; None for one that is answered top-down."""

    def check_known(self, indicator: Indicator, /) -> None:
        """Refuse a predicate that nothing defines."""

    def instances(self, statement: Compound, /) -> Iterator[Compound]:
        """Every answer, lazily."""


class Predicate:
    """A name of the knowledge base, callable with kanren terms: ``kb.eat(x, "biscuits", "plate")`` is a goal."""

    __slots__ = ("base", "name")

    def __init__(self, base: Answering, name: str) -> None:
        self.base, self.name = base, name

    def __call__(self, *args: Any) -> Goal:
        """A goal that holds for every row (or proof) the arguments can be.

        After the last of them the goal raises `Undefined` when the arguments can be an undefined row as well.

        Raises:
            ProgramError: the name is not defined with this many arguments.
        """
        base, indicator = self.base, (self.name, len(args))
        if base.stored(indicator) is None:
            base.check_known(indicator)
        plain = all(type(arg) in _PLAIN for arg in args)

        def goal(state: State) -> Iterator[State]:
            found = args if plain else tuple([_walked(arg, state) for arg in args])
            with base.lock:
                relation = base.stored(indicator)
                if relation is not None:
                    if plain and (found in relation or relation.undefined is None):
                        return iter((state,)) if found in relation else iter(())
                    if relation.undefined is not None:
                        return _then_doubts(relation, found, state)
                    return stored_goal(relation, found, state)
            return _derived(base, indicator[0], found, state)

        return goal

    def __repr__(self) -> str:
        return f"<predicate {self.name}>"


_PLAIN = frozenset((str, int, float))


def _walked(term: Any, state: State) -> Any:
    """What an argument stands for in the state."""
    while isinstance(term, Var):
        value = state.get(term, term)
        if value is term:
            return term
        term = value
    return reify(term, state) if isinstance(term, tuple) else term


def stored_goal(relation: Relation, args: Row, state: State) -> Iterator[State]:
    """The states in which the (walked) arguments are a row of the relation; its rows are looked up at once."""
    open_ = [(at, arg) for at, arg in enumerate(args) if type(arg) is not str and not _is_closed(arg)]
    if not _is_hashable(args):
        return iter(())  # a Python list or set is no term: it stands in no row
    if not open_:
        return iter((state,)) if args in relation else iter(())
    free = {at for at, _ in open_}
    columns = tuple([at for at in range(len(args)) if at not in free])
    return _extended(state, open_, list(relation.matching(columns, tuple([args[at] for at in columns]))))


def _extended(state: State, open_: list[tuple[int, Any]], rows: list[Row]) -> Iterator[State]:
    """The state with its open arguments as in each of the rows."""
    if type(state) is dict and len({arg for _, arg in open_}) == len(open_) and all(isvar(arg) for _, arg in open_):
        for row in rows:
            extended = state.copy()
            for at, variable in open_:
                extended[variable] = row[at]
            yield extended
    else:  # constraints, repeated variables and compound terms go through unify
        left = tuple([arg for _, arg in open_])
        for row in rows:
            extended = unify(left, tuple([row[at] for at, _ in open_]), state)
            if extended is not False:
                yield extended


def _then_doubts(relation: Relation, args: Row, state: State) -> Iterator[State]:
    """As `stored_goal`; raises `Undefined` after the last state when the arguments can be an undefined row."""
    yield from stored_goal(relation, args, state)
    assert relation.undefined is not None
    for row in relation.undefined if _is_hashable(args) and args not in relation else ():
        fresh = tuple(_to_kanren(opened(value, count()), {}) for value in row)
        if unify(args, fresh, state) is not False:
            sentence = f"{term_text(as_term(Compound((relation.name, *row))))} is undefined"
            raise Undefined(sentence)


def _is_hashable(args: Row) -> bool:
    try:
        hash(args)
    except TypeError:
        return False
    return True


def _is_closed(term: Any) -> bool:
    if isinstance(term, tuple):
        return all(_is_closed(part) for part in term)
    return not isvar(term)


def _derived(base: Answering, name: str, args: Row, state: State) -> Iterator[State]:
    """A predicate that is answered top-down: kanren's variables become the solver's, and its answers come back."""
    names: dict[Var, Variable] = {}
    atom = Compound([name, *(_to_solver(arg, names) for arg in args)])
    for answer in base.instances(atom):
        fresh: dict[Variable, Var] = {}
        extended = unified(tuple(args), tuple(_to_kanren(part, fresh) for part in answer.args), state)
        if extended is not False:
            yield extended


def _to_solver(term: Any, names: dict[Var, Variable]) -> Term:
    if isvar(term):
        return names.setdefault(term, Variable(f"K{len(names)}"))
    if isinstance(term, tuple):
        return Compound([_to_solver(part, names) for part in term])
    return term


def _to_kanren(term: Term, fresh: dict[Variable, Var]) -> Any:
    if isinstance(term, Variable):
        return fresh.setdefault(term, var())
    if isinstance(term, Compound):
        return Compound([_to_kanren(part, fresh) for part in term])
    return term


__all__ = ["Goal", "Predicate", "State", "stored_goal"]
