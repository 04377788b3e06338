"""Plans that are not listed: which tasks can be finished at all, as the least fixpoint over their methods.

A method can be finished when the knowledge base lets somebody do each of its steps, by whatever values, when its
conditions may hold, each and together, and when every task it needs has a method that fits and can be finished. What
looks back at what was done may still come, and is taken for possible; so are values that pass from task to task. So
what is reported is impossible indeed, and of the rest it is not known.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import NamedTuple

from casper.engine.domain.domain import Domain
from casper.engine.domain.trying.obstacle import ANYBODY, Obstacle
from casper.engine.verification.conditions import Conditions
from casper.kb.checks.finding import Finding, error, note, warning
from casper.kb.errors import CasperError, Place
from casper.kb.reasons.why_not import Refusal
from casper.kb.terms.clauses import Indicator
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.kb.terms.unification import Bindings, renamed, substitute, unify
from casper.plans.library import GOAL
from casper.plans.networks.grammar import Call, Grammar, Item, Method
from casper.plans.trees.nodes import Action, Condition


class _Way(NamedTuple):
    """A method of a task, by its number."""

    task: Indicator
    number: int


def grown_plans(domain: Domain) -> Iterator[Finding]:
    """Goals that can never be finished, ways to do a task that nobody can, and that of the rest it is not known."""
    trial = _Trial(domain)
    for goal, place in domain.library.goal_terms:
        obstacle = trial.of_goal(goal, place)
        if obstacle is not None:
            sentence = f"the goal {goal.functor} can never be finished: {obstacle}"
            yield error(place, f"{sentence}; mend that, or give {goal.functor} another way")
    yield from trial.impossible_ways()
    sentence = "these plans have no end or are too many to be listed: whether anybody can do them was tried of each"
    yield note(domain.library.productions[0].place, f"{sentence} step by itself, not of whole plans")


class _Trial:
    """The methods of a grammar, and what keeps them from being finished."""

    def __init__(self, domain: Domain) -> None:
        self.domain, self.conditions = domain, Conditions(domain.kb)
        self.grammar: Grammar = domain.library.tables.grammar
        self._steps: dict[Action | Condition, Obstacle | None] = {}
        self._serial = 0

    def _methods(self, task: Indicator) -> Sequence[Method]:
        return self.grammar.methods(task)

    @cached_property
    def possible(self) -> frozenset[_Way]:
        """The methods that can be finished, for all that is known."""
        found: frozenset[_Way] = frozenset()
        ways = [_Way(task, at) for task in self.grammar.tasks for at in range(len(self._methods(task)))]
        while True:
            left = [way for way in ways if way not in found]
            more = [way for way in left if self._obstacle(self._method(way), found) is None]
            if not more:
                return found
            found = found.union(more)

    def _method(self, way: _Way) -> Method:
        return self._methods(way.task)[way.number]

    # --- what stands in the way --------------------------------------------------------------------------------------

    def of_goal(self, goal: Compound, place: Place) -> Obstacle | None:
        """What keeps a goal from being finished in its first way; None where some way may be."""
        first: Obstacle | None = None
        for way in self._fitting(goal):
            method = self._method(way)
            found = self._told(way, ()) if way not in self.possible else self._together(method, goal)
            if found is None:
                return None
            first = first or found
        return first or Obstacle(None, place, (f"no way to do {goal.functor} fits it",))

    def impossible_ways(self) -> Iterator[Finding]:
        """Methods that can never be finished of tasks that can."""
        for task in self.grammar.tasks:
            ways = [_Way(task, at) for at in range(len(self._methods(task)))]
            for way in ways if self.possible.intersection(ways) else ():
                obstacle = None if way in self.possible else self._told(way, ())
                if obstacle is not None:
                    head = term_text(as_term(self._method(way).head))
                    yield warning(self._method(way).place, f"this way to do {head} can never be finished: {obstacle}")

    def _told(self, way: _Way, above: tuple[_Way, ...]) -> Obstacle:
        """What keeps a method from being finished, told of the step or condition where it begins."""
        method = self._method(way)
        found = self._obstacle(method, self.possible)
        if isinstance(found, Obstacle):
            return found
        around = (*above, way)
        for below in self._fitting(found.term) if found is not None else ():
            if below not in around:
                return self._told(below, around)
        shown = " needs ".join(name for (name, _), _ in (*around, around[0]))
        return Obstacle(None, method.place, (f"it goes on for ever ({shown})",))

    def _obstacle(self, method: Method, possible: frozenset[_Way]) -> Obstacle | Call | None:
        return self._of_item(method.body, possible) or self._together(method)

    def _of_item(self, item: Item, possible: frozenset[_Way]) -> Obstacle | Call | None:
        """What keeps an item from being done: a step, a condition, or a task of which no method is possible."""
        if isinstance(item, Call):
            return None if possible.intersection(self._fitting(item.term)) else item
        if isinstance(item, (Action, Condition)):
            if item not in self._steps:
                self._steps[item] = self._of_step(item) if isinstance(item, Action) else self._of_condition(item)
            return self._steps[item]
        if item.kind == "optional" or (item.kind == "repeat" and not item.least):
            return None
        found = [self._of_item(each, possible) for each in item.items]
        if item.kind == "choice":
            return None if None in found else found[0]
        return next((each for each in found if each is not None), None)

    def _fitting(self, term: Compound) -> list[_Way]:
        """The methods whose head fits a task."""
        found: list[_Way] = []
        for number, method in enumerate(self._methods(term.indicator)):
            self._serial += 1
            (head,) = renamed([method.head], self._serial)
            if unify(term, head, {}) is not None:
                found.append(_Way(term.indicator, number))
        return found

    # --- what the knowledge base says ---------------------------------------------------------------------------------

    def _of_step(self, action: Action) -> Obstacle | None:
        """Why nobody can do a step, whatever its open arguments are."""
        kb, step = self.domain.kb, action.term
        claim = Compound((step.functor, ANYBODY, *step.args))
        if not kb.defines(step.functor, step.arity + 1):
            return None
        try:
            if kb.depends_on_history:  # what was done before may allow it: only a rule that never looks there is a no
                answer = None if self.conditions.looks_back(claim) else self.conditions.answer(claim, ())
                reasons = answer.reasons if isinstance(answer, Refusal) else None
            else:
                verdict = kb.verify(claim, ())
                reasons = verdict.reasons if verdict.valid is False else None
        except CasperError:
            return None
        return None if reasons is None else Obstacle(step, action.place, reasons)

    def _of_condition(self, condition: Condition) -> Obstacle | None:
        """Why a condition never holds, whatever its open arguments are."""
        if self.conditions.looks_back(condition.term):
            return None
        answer = self.conditions.answer(condition.term, ())
        if not isinstance(answer, Refusal):
            return None
        return Obstacle(None, condition.place, answer.reasons, condition.term.functor)

    def _together(self, method: Method, goal: Compound | None = None) -> Obstacle | None:
        """That the conditions a method cannot do without, and the goal's own, never hold together."""
        terms = [condition.term for condition in _needed(method.body)]
        if goal is not None and self.domain.kb.defines(*GOAL):
            bindings: Bindings | None = unify(goal, method.head, {})
            terms = [Compound(("goal", as_term(goal))), *terms]
            terms = [substitute(term, bindings) for term in terms] if bindings is not None else terms
        atoms = [term for term in terms if not self.conditions.looks_back(term)]
        if not atoms or self.conditions.hold_together(atoms, ()) is not False:
            return None
        shown = " and ".join(term.functor if term.functor.startswith("{") else term_text(term) for term in atoms)
        return Obstacle(None, method.place, (f"nothing is {shown} at once",))


def _needed(item: Item) -> Iterator[Condition]:
    """The conditions that every way to do an item has."""
    if isinstance(item, Condition):
        yield item
    elif not isinstance(item, (Action, Call)) and (item.kind in ("sequence", "unordered", "steps") or item.least):
        for each in item.items if item.kind not in ("choice", "optional") else ():
            yield from _needed(each)
