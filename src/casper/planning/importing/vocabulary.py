"""What a problem's types, fluents, actions and tasks are called, and who does its actions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import prod
from typing import Any

from unified_planning.model import Fluent, InstantaneousAction, Problem, Type

from casper.kb.errors import CasperError
from casper.kb.terms.terms import Compound, Term
from casper.planning.importing.alternatives import Unsaid
from casper.planning.importing.names import outward

MOST = 100_000  # first values of one fluent that are not stated


@dataclass(frozen=True)
class Who:
    """Who does the actions.

    ``agent`` is a type: the first parameter of an action that is of it does the action. Without it, and of actions that
    have no such parameter, any actor may do them. ``partner`` and ``robot`` are who is watched and who helps.
    """

    agent: str | None = None
    partner: str | None = None
    robot: str | None = None


ANYBODY = Who()


@dataclass(frozen=True)
class Vocabulary:
    """A problem, seen as names."""

    problem: Problem
    who: Who = ANYBODY

    # --- who -------------------------------------------------------------------------------------------------------

    @cached_property
    def agent_type(self) -> Type | None:
        """The type of those who act.

        Raises:
            CasperError: the problem has no such type.
        """
        if self.who.agent is None:
            return None
        known = {kind.name: kind for kind in self.problem.user_types}
        if self.who.agent not in known:
            there = ", ".join(known) or "none"
            raise CasperError(f"the problem has no type {self.who.agent} of agents; its types are {there}")
        return known[self.who.agent]

    def agent_index(self, action: Any) -> int | None:
        """The number of the parameter that does the action; None: whoever it is."""
        if self.agent_type is None:
            return None
        return next((at for at, p in enumerate(action.parameters) if self._acts(p.type)), None)

    def _acts(self, kind: Type) -> bool:
        return kind.is_user_type() and self.agent_type in (kind, *kind.ancestors)

    @cached_property
    def partner(self) -> str:
        """Who is watched."""
        return self.who.partner or next(iter(self._agents), "human")

    @cached_property
    def robot(self) -> str:
        """Who helps."""
        return self.who.robot or next((name for name in self._agents if name != self.partner), "robot")

    @cached_property
    def _agents(self) -> list[str]:
        return [] if self.agent_type is None else [thing.name for thing in self.problem.objects(self.agent_type)]

    # --- actions and tasks -----------------------------------------------------------------------------------------

    def statement(self, action: Any, arguments: Sequence[Term], anybody: Term) -> Compound:
        """An action as a statement: first who does it."""
        at = self.agent_index(action)
        if at is None:
            return Compound((outward(action.name), anybody, *arguments))
        return Compound((outward(action.name), arguments[at], *arguments[:at], *arguments[at + 1 :]))

    def step(self, action: Any, arguments: Sequence[Term]) -> Term:
        """An action as it stands in a plan."""
        at = self.agent_index(action)
        others = [argument for number, argument in enumerate(arguments) if number != at]
        done = Compound((outward(action.name), *others)) if others else outward(action.name)
        return done if at is None else Compound(("by", arguments[at], done))

    def check(self, fluent: Fluent) -> None:
        """Refuse a fluent that cannot be said.

        Raises:
            Unsaid: it cannot; whatever needs it cannot either.
        """
        if fluent.name in self.unsaid:
            raise Unsaid(f"it needs the fluent {fluent.name}, which is left out")

    @cached_property
    def unsaid(self) -> dict[str, str]:
        """The fluents that cannot be said, with the reason."""
        return dict(self._unsaid())

    def _unsaid(self) -> Iterator[tuple[str, str]]:
        for fluent in self.problem.fluents:
            odd = [parameter for parameter in fluent.signature if not parameter.type.is_user_type()]
            if odd:
                yield fluent.name, f"its parameter {odd[0].name} is no object; use a type with objects"
            elif self.defaults(fluent) and prod(self._count(p.type) for p in fluent.signature) > MOST:
                yield fluent.name, f"it has more than {MOST:,} first values; give it no default but false"

    def _count(self, kind: Type) -> int:
        return len(list(self.problem.objects(kind)))

    def defaults(self, fluent: Fluent) -> bool:
        """Whether it has first values that are not stated."""
        default = self.problem.fluents_defaults.get(fluent)
        return default is not None and not default.is_false()

    # --- types and fluents -----------------------------------------------------------------------------------------

    @cached_property
    def facts(self) -> frozenset[str]:
        """Fluents that nothing changes, and that no type or action is called like: they are plain facts."""
        actions = [action for action in self.problem.actions if isinstance(action, InstantaneousAction)]
        moved = {effect.fluent.fluent().name for action in actions for effect in action.effects}
        taken = {(outward(kind.name), 1) for kind in self.problem.user_types}
        for action in self.problem.actions:
            taken.add((outward(action.name), len(action.parameters) + (self.agent_index(action) is None)))
        still = [fluent for fluent in self.problem.fluents if fluent.name not in moved]
        return frozenset(fluent.name for fluent in still if self._indicator(fluent) not in taken)

    def _indicator(self, fluent: Fluent) -> tuple[str, int]:
        return outward(fluent.name), fluent.arity + (not fluent.type.is_bool_type())

    def of_type(self, kind: Type, thing: Term) -> Compound:
        """That a thing is of a type.

        Raises:
            Unsaid: it is no type of objects.
        """
        return Compound((outward(self.type_name(kind)), thing))

    def type_name(self, kind: Type) -> str:
        """The name of a type of objects."""
        if not kind.is_user_type():
            raise Unsaid(f"a parameter of the type {kind} is no object; use a type with objects")
        return str(kind.name)


def number(value: Any) -> Term:
    """A number as it is written: fractions as decimals, where those are exact."""
    exact = Fraction(value)
    if exact.denominator == 1:
        return int(exact)
    near = float(exact)
    return near if Fraction(repr(near)) == exact else Compound(("/", exact.numerator, exact.denominator))
