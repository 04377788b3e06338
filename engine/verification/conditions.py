"""Conditions in plans, asked of the knowledge base: ``{vessel(V), \\+ at(V, sink)}`` (`plans.grammar.conditions`).

Answers are remembered for as long as the knowledge base stays as it is, by condition with what is known of its
parameters, and by what happened earlier where it looks at did/2. Unknown is not no: what no budget decides, what is
undefined, and what several values would satisfy stays open.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice
from typing import TypeAlias

from casper.kb.base import KnowledgeBase
from casper.kb.errors import BudgetExceeded, ProgramError, Undefined
from casper.kb.reasons.constraints import History
from casper.kb.reasons.why_not import Refusal
from casper.kb.terms.clauses import Literal
from casper.kb.terms.terms import Compound, Term, Variable
from casper.kb.terms.unification import Bindings, is_ground, substitute, unify, variables_of

MOST_REMEMBERED = 200_000  # answers; then all are forgotten
MOST_VALUES = 300  # of a condition that are compared with those of others
Answer: TypeAlias = "Compound | Refusal | None"  # as it holds, why it does not, or that this is open


class Conditions:
    """What a knowledge base says of conditions; shared by all who ask it."""

    def __init__(self, kb: KnowledgeBase) -> None:
        self.kb = kb
        self._changes, self._known = kb.changes, dict[tuple[Compound, tuple[object, ...]], Answer]()
        self._back: dict[tuple[str, int], bool] = {}

    def looks_back(self, condition: Compound) -> bool:
        """Whether the answer may depend on what happened earlier."""
        self._keep_up()
        indicator = condition.indicator
        if indicator not in self._back:
            self._back[indicator] = self.kb.looks_back_at(*indicator)
        return self._back[indicator]

    def ask(self, condition: Compound, bindings: Bindings, history: History) -> Bindings | Refusal | None:
        """The bindings after the condition: with those of its parameters for which only one value will do.

        A refusal where it does not hold; None where more must be known.
        """
        atom = substitute(condition, bindings)
        answer = self.answer(atom, history)
        if not isinstance(answer, Compound):
            return answer
        return bindings if answer == atom else unify(atom, answer, bindings)

    def answer(self, atom: Compound, history: History) -> Answer:
        """As `ask`, of the condition as it is: its only instance."""
        key = atom, tuple(history) if self.looks_back(atom) else ()
        if key not in self._known:
            if len(self._known) > MOST_REMEMBERED:
                self._known.clear()
            self._known[key] = self._answer(atom, history)
        return self._known[key]

    def hold_together(self, atoms: Sequence[Compound], history: History) -> bool | None:
        """Whether some values satisfy all of the conditions; None: that is not known."""
        try:
            solver = self.kb.solver(history=history)
            return next(solver.rows([Literal(atom) for atom in atoms], list(variables_of(*atoms))), None) is not None
        except (BudgetExceeded, Undefined, ProgramError):
            return None

    def values(self, atom: Compound, history: History) -> dict[Variable, frozenset[Term]]:
        """By variable of a condition the values under which it may hold; none of those for which that is not known."""
        found: dict[Variable, set[Term]] = {variable: set() for variable in variables_of(atom)}
        try:
            for number, instance in enumerate(self._instances(atom, history)):
                if number >= MOST_VALUES:
                    return {}
                bindings = unify(atom, instance, {}) or {}
                for variable in list(found):
                    value = substitute(variable, bindings)
                    if is_ground(value):
                        found[variable].add(value)
                    else:
                        del found[variable]
        except (BudgetExceeded, Undefined, ProgramError):
            return {}
        return {variable: frozenset(values) for variable, values in found.items()}

    def _keep_up(self) -> None:
        if self.kb.changes != self._changes:
            self._changes = self.kb.changes
            self._known.clear()
            self._back.clear()

    def _answer(self, atom: Compound, history: History) -> Answer:
        try:
            found = list(islice(self._instances(atom, history), 2))
        except (BudgetExceeded, Undefined):
            return atom if is_ground(atom) else None
        except ProgramError:  # it cannot be decided before more of its parameters are known
            return None
        if len(found) == 1:
            return found[0] if is_ground(found[0]) else None
        if found:
            return None
        return self.kb.why_not(atom, history) or Refusal(atom)

    def _instances(self, atom: Compound, history: History) -> Iterator[Compound]:
        """Every instance that holds, each once; what is undefined may hold, and counts."""
        names, seen = list(variables_of(atom)), set[Compound]()
        for row, _ in self.kb.solver(history=history).rows([Literal(atom)], names):
            instance: Compound = substitute(atom, {n: value for n, value in zip(names, row) if value is not n})
            if instance not in seen:
                seen.add(instance)
                yield instance
