"""Actions as they stand in a body: ``wash(Plate, sink)``, and with who does it ``by(Who, wash(Plate, sink))``."""

from __future__ import annotations

from collections.abc import Callable

from casper.kb.errors import Place, PlanError
from casper.kb.terms.clauses import Indicator, Literal
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import NIL, Compound, Variable, as_term, predication
from casper.kb.terms.unification import renamed
from casper.plans.grammar.conditions import is_condition
from casper.plans.grammar.shapes import SHAPES
from casper.plans.trees.nodes import Action

NO_ACTIONS = frozenset({"{}", NIL, "by"})
ONLY_NAMES = "an item of a plan is an action or a task, such as wash(Plate, sink)"


def checked_action(term: Compound, place: Place) -> Action:
    """The action that a term names.

    Raises:
        PlanError: it is no name, or a comparison.
    """
    named = term.functor[:1].isalpha() or term.functor[:1] == "_"
    if not named or Literal(term).is_comparison:
        shown = term_text(renamed([as_term(term)], 0)[0], sequences=True)
        raise PlanError(f"{shown} cannot stand in a plan: {ONLY_NAMES}", place)
    return Action(term, place)


def checked_step(term: Compound, place: Place, is_task: Callable[[Indicator], bool]) -> Action:
    """The action of ``by(Who, Action)``, with who does it.

    Raises:
        PlanError: who is nobody, or what is no action.
    """
    who, what = term.args
    done = predication(what) if isinstance(what, (str, Compound)) else None
    if done is None or done.functor in SHAPES or done.functor in NO_ACTIONS or is_condition(done):
        shown = term_text(renamed([term], 0)[0])
        raise PlanError(f"{shown} cannot stand in a plan: by takes who, and an action", place)
    if is_task(done.indicator):
        fix = f"put by into the productions of {done.functor}"
        raise PlanError(f"by says whose step an action is, and {done.functor} is a task: {fix}", place)
    if not isinstance(who, (str, Variable)):
        shown = term_text(renamed([who], 0)[0])
        raise PlanError(f"{shown} does nothing: by takes an agent, a variable or robot", place)
    return Action(checked_action(done, place).term, place, who)
