"""The executable specification of answers: resolution in three truth values that knows the built-in predicates, too.

Each built-in is worked out by itself. Questions are answered by the machine (`kb.top_down.answering`).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from casper.kb.errors import BudgetExceeded, ProgramError, Undefined
from casper.kb.terms.builtins import BUILTINS
from casper.kb.terms.clauses import CALLING, Indicator, Literal
from casper.kb.terms.syntax import COMPARISONS, term_text
from casper.kb.terms.terms import NIL, Compound, Term, Variable, list_items, predication
from casper.kb.terms.unification import Bindings, substitute, unify
from casper.kb.terms.unknown import DOUBT
from casper.kb.terms.values.arithmetic import EvaluationFailed
from casper.kb.top_down.builtins import COMPUTING
from casper.kb.top_down.compiled.cells import Cell, deref, fresh_variable, inward
from casper.kb.top_down.search import Search
from casper.kb.top_down.solve import Solver, next_ready


@dataclass
class PlainSolver(Solver):
    """The solver, with built-in predicates where the program defines none of that name."""

    def next_of(self, body: Sequence[Literal], bindings: Bindings) -> int | None:
        """The first condition that can be decided now; a built-in waits for what it needs."""
        waits = [self._waits(literal, bindings) for literal in body]
        left = [literal for literal, is_waiting in zip(body, waits) if not is_waiting]
        at = next_ready(left, bindings)
        return None if at is None else [i for i, is_waiting in enumerate(waits) if not is_waiting][at]

    def _waits(self, literal: Literal, bindings: Bindings) -> bool:
        if literal.is_comparison or literal.is_strict or not self._is_built_in(literal.atom.indicator):
            return False
        args = [substitute(arg, bindings) for arg in literal.atom.args]
        if literal.atom.functor in ("call", "maplist"):
            return isinstance(args[0], Variable)
        found = COMPUTING.get(literal.atom.indicator)
        cells: dict[Variable, Cell] = {}
        return found is not None and not found.ready(*(deref(inward(arg, cells)) for arg in args))

    def _is_built_in(self, indicator: Indicator) -> bool:
        if indicator not in BUILTINS or indicator in self.clauses or indicator in self.computed:
            return False
        return self.relations.get(indicator) is None

    def _positive(self, literal: Literal, bindings: Bindings, depth: int) -> Iterator[Bindings]:
        if not self._is_built_in(literal.atom.indicator):
            yield from super()._positive(literal, bindings, depth)
        elif literal.atom.functor in ("call", "not", "maplist"):
            atom: Compound = substitute(literal.atom, bindings)
            yield from self._solve(list(self._goals(atom, literal)), bindings, depth + 1)
        elif literal.atom.indicator in CALLING:
            raise _not_followed(literal.atom)
        else:
            yield from self._computed_by_itself(literal, bindings)

    def _computed_by_itself(self, literal: Literal, bindings: Bindings) -> Iterator[Bindings]:
        atom: Compound = substitute(literal.atom, bindings)
        search = Search({}, {}, {}, self.budget - self.steps, deadline=self.deadline, cancelled=self.cancelled)
        try:
            for answer in search.solve([Literal(atom)]):
                extended = unify(substitute(atom, answer), atom, bindings)
                if extended is not None:
                    yield extended
        except (Undefined, EvaluationFailed) as doubt:
            yield {**bindings, DOUBT: doubt.sentence}
        finally:
            self.steps += search.steps

    def _goals(self, atom: Compound, literal: Literal) -> Iterator[Literal]:
        """What a goal about goals asks for.

        Raises:
            BudgetExceeded: it is made of goals in a way that is not followed here.
            ProgramError: its goal is not known, or is none.
        """
        if atom.functor == "maplist":
            lists = [list_items(arg) for arg in atom.args[1:]]
            length = next((len(items) for items, tail in lists if tail == NIL), None)
            if length is None:
                raise _not_followed(atom)
            columns: list[list[Term]] = [[fresh_variable() for _ in range(length)] for _ in lists]
            for arg, column in zip(atom.args[1:], columns):
                yield Literal(Compound(("=", arg, _listed(column))))
            for extra in zip(*columns):
                yield self._goal(atom[1], extra, atom, literal)
        else:
            yield self._goal(atom[1], atom.args[1:], atom, literal)

    def _goal(self, goal: Term, extra: Sequence[Term], atom: Compound, literal: Literal) -> Literal:
        if isinstance(goal, Variable):
            raise ProgramError(f"{term_text(atom)} cannot be decided: its goal is not known", literal.place)
        try:
            plain = predication(goal)
        except TypeError:
            return Literal(Compound(("=", "true", "fail")))  # a number is no goal
        called = Compound((*plain, *extra))
        negated = atom.functor == "not"
        if called.indicator in (("\\+", 1), ("not", 1)) and isinstance(called[1], (str, Compound)):
            called, negated = predication(called[1]), not negated
        is_comparison = called.arity == 2 and called.functor in COMPARISONS
        known = called.indicator in self.clauses or self.relations.get(called.indicator) is not None
        if not (is_comparison or known or called.indicator in self.computed or called.indicator in BUILTINS):
            raise _not_followed(atom)
        return Literal(called, negated, literal.place)


def _listed(items: Sequence[Term]) -> Term:
    found: Term = NIL
    for item in reversed(items):
        found = Compound((".", item, found))
    return found


def _not_followed(atom: Compound) -> BudgetExceeded:
    return BudgetExceeded(f"{term_text(atom)} beside something undefined is not followed: the answer is unknown")
