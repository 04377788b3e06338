"""Observations: the partner's actions as they reach the explainer, with or without their arguments."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from difflib import get_close_matches
from typing import TypeAlias

from casper.kb.errors import PlanError
from casper.kb.reader import read_statement
from casper.kb.terms import Compound, Term, Variable, as_term, predication
from casper.kb.writer import term_text


@dataclass(frozen=True, slots=True)
class Observation:
    """An action of the partner: its name, and its arguments where they are known.

    ``args`` is None when only the name was seen; an argument that was not made out is a `Variable`.
    """

    action: str
    args: tuple[Term, ...] | None = None

    @property
    def known_args(self) -> int:
        """How many arguments are known."""
        return sum(not isinstance(arg, Variable) for arg in self.args or ())

    def __str__(self) -> str:
        return self.action if self.args is None else term_text(as_term(Compound((self.action, *self.args))))


Observed: TypeAlias = "str | Compound | tuple[Term, ...] | Observation"


def observation_of(observed: Observed, actions: Iterable[tuple[str, int]]) -> Observation:
    """Make an observation of text (``eat`` or ``eat(biscuits, plate)``), a term, or an observation.

    Args:
        observed: what was seen; the agent is left out, it is the partner.
        actions: the library's terminals by name and arity.

    Raises:
        ReadError: the text is no action.
        PlanError: no plan has the action, or not with this many arguments; the sentence says what may be meant.
    """
    if isinstance(observed, Observation):
        seen = observed
    else:
        term = read_statement(observed) if isinstance(observed, str) else predication(observed)
        seen = Observation(term.functor, term.args if len(term) > 1 else None)
    arities = sorted({arity for name, arity in actions if name == seen.action})
    if not arities:
        names = sorted({name for name, _ in actions})
        close = get_close_matches(seen.action, names, n=1)
        hint = f"did you mean {close[0]}?" if close else f"the plans have {', '.join(names)}"
        raise PlanError(f"no plan has the action {seen.action}; {hint}")
    if seen.args is not None and len(seen.args) not in arities:
        takes = " or ".join(map(str, arities))
        raise PlanError(f"{seen.action} takes {takes} arguments here (the agent is left out), not {len(seen.args)}")
    if seen.args is None and arities == [0]:
        return Observation(seen.action, ())
    return seen
