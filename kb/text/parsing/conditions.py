"""Conditions: the body of a rule, or a question, as a tree of goals with their places."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

from casper.kb.terms.operators import ARGUMENT, HIGHEST
from casper.kb.terms.terms import Compound, Term
from casper.kb.text.parsing.parser import Parser, right_fold

Shape: TypeAlias = Literal["goal", "and", "or", "then", "not"]
_CONTROL = (",", ";", "->")


@dataclass(slots=True)
class Condition:
    """A part of a body: a goal, or conditions under ``,`` ``;`` ``->`` ``\\+``.

    ``is_named``: a goal is written as a name or ``name(arguments)``, or with an operator that the text declared.
    """

    shape: Shape
    start: int
    parts: Sequence[Condition] = ()
    goal: Term = None
    is_named: bool = False

    def term(self) -> Term:
        """The condition as the term it is in ISO Prolog."""
        if self.shape == "goal":
            return self.goal
        terms = [part.term() for part in self.parts]
        if self.shape == "not":
            return Compound(("\\+", *terms))
        return right_fold({"and": ",", "or": ";", "then": "->"}[self.shape], terms)


class ConditionParser(Parser):
    """Reads one sentence that may have a body."""

    def body(self) -> Condition:
        """Conditions with ``;`` between, and ``->`` and ``,`` within."""
        return self._joined("or", ";", lambda: self._joined("then", "->", self._conjunction))

    def _conjunction(self) -> Condition:
        return self._joined("and", ",", self._condition)

    def _joined(self, shape: Shape, between: str, part: Callable[[], Condition]) -> Condition:
        first = part()
        parts = [first]
        while self.texts[self.at] == between and self.is_operator():
            self.at += 1
            parts.append(part())
        return first if len(parts) == 1 else Condition(shape, first.start, parts)

    def _condition(self) -> Condition:
        """One condition, or several in brackets."""
        start = self.starts[self.at]
        if self.takes("\\+"):
            return self._continued(Condition("not", start, [self._negated()]), 900)
        if self.takes("("):
            inner = self.body()
            inner = self._continued(inner, 1100, HIGHEST)
            self.expect(")", "','")
            return self._continued(inner, 0)
        term = self.term(ARGUMENT)
        return Condition("goal", start, (), term, self.is_named)

    def _negated(self) -> Condition:
        """What ``\\+`` stands before: a condition of no higher priority."""
        if self.texts[self.at] in ("\\+", "("):
            return self._condition()
        start = self.starts[self.at]
        return Condition("goal", start, (), self.term(900), self.is_named)

    def _continued(self, condition: Condition, priority: int, most: int = ARGUMENT) -> Condition:
        """The condition, unless an operator follows that makes a term of it: ``(a, b) = X``."""
        found = self.operators.infix.get(self.texts[self.at])
        if found is None or found[0] > most or not self.is_operator() or self.texts[self.at] in _CONTROL:
            return condition
        term = self.continued(condition.term(), priority, most)
        return Condition("goal", condition.start, (), term, self.is_named)
