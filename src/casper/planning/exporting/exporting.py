"""The whole way back: a domain that says what its actions change becomes a problem of Unified Planning.

    >>> problem = to_problem(domain)                                        # doctest: +SKIP
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from typing import Any

from unified_planning.environment import get_environment
from unified_planning.model import Fluent, Object, Problem
from unified_planning.model.htn import HierarchicalProblem

from casper.engine.domain.domain import Domain
from casper.kb.errors import CasperError
from casper.kb.terms.clauses import Clause
from casper.kb.terms.terms import Compound, Term, predication
from casper.kb.text.reader import read_text
from casper.planning.exporting.actions import EFFECTS, any_of, make_action
from casper.planning.exporting.expressions import Scope
from casper.planning.exporting.methods import by_name, is_impossible, make_method, make_network, make_task
from casper.planning.exporting.target import Target, Unplanned, body_terms, number_of, shown
from casper.planning.importing.files import lenient_names
from casper.planning.importing.importing import MOMENTS, LeftOut
from casper.planning.importing.names import ACHIEVE, ACT, GOAL_STATE, NETWORK, inward
from casper.plans.relations import plan_clauses

_CHANGING = frozenset({("initially", 1), ("initial_value", 2)})
_SAID = frozenset(
    {
        *EFFECTS,
        *_CHANGING,
        *(("problem", 1), ("type", 1), ("subtype", 2), ("fluent", 2), ("changes", 3), ("method", 1), ("goal", 1)),
        *(("compound_task", 1), ("actor", 1), ("agent_parameter", 2), ("setting", 3), (GOAL_STATE, 0)),
    }
)


def to_problem(domain: Domain) -> Problem:
    """A problem of a domain; whatever has no place in it is told as a warning (`LeftOut`).

    Raises:
        CasperError: the domain does not say what its actions change (`importing` does), or a clause that is needed has
            no place in a problem, with its place.
    """
    with lenient_names():  # a type and a fluent may share one, in files and in domains
        export = _Export(domain)
    for sentence in export.left_out():
        warnings.warn(sentence, LeftOut, stacklevel=2)
    return export.target.problem


class _Export:
    def __init__(self, domain: Domain) -> None:
        self.domain, self.clauses = domain, domain.kb.clauses
        if not self._of("fluent", 2) and not self._of("problem", 1):
            needed = "state fluent/2, initially/1, initiates/3 and terminates/3 (docs/planning.md)"
            raise CasperError(f"the domain {domain.name} does not say what its actions change: {needed}")
        names = [str(clause.head[1]) for clause in self._of("problem", 1)] or [domain.name]
        make = HierarchicalProblem if self._of("compound_task", 1) or self._is_network() else Problem
        self.target = Target(make(names[0], get_environment()))
        self.taken: set[tuple[str, int]] = set(_SAID)
        self._types()
        self._objects()
        self._fluents()
        self._initial()
        self._actions()
        self._goal()
        if isinstance(self.target.problem, HierarchicalProblem):
            self._hierarchy()

    def left_out(self) -> Iterator[str]:
        """What the domain says besides."""
        calculus = {clause.head.indicator for clause in read_text(MOMENTS) if isinstance(clause, Clause)}
        relations = {clause.head.indicator for clause in plan_clauses(self.domain.library)}
        told: set[tuple[str, int]] = set()
        for clause in self.clauses:
            head = clause.head.indicator
            if head in self.taken | calculus | relations or head in told or clause.head.functor.startswith("{"):
                continue
            told.add(head)
            yield f"{clause.place}: {head[0]}/{head[1]} has no place in a problem of planning, and is left out"

        if not isinstance(self.target.problem, HierarchicalProblem):
            for production in self.domain.library.productions:
                if production.head.functor not in (ACHIEVE, ACT):
                    yield f"{production.place}: {production.head.functor} has no compound_task(…), and is left out"

    def _of(self, name: str, arity: int) -> list[Clause]:
        return [clause for clause in self.clauses if clause.head.indicator == (name, arity)]

    def _is_network(self) -> bool:
        return any(p.head.functor == NETWORK for p in self.domain.library.productions)

    # --- what there is ---------------------------------------------------------------------------------------------

    def _types(self) -> None:
        manager = self.target.problem.environment.type_manager
        parents = {str(clause.head[1]): str(clause.head[2]) for clause in self._of("subtype", 2)}
        for clause in self._of("type", 1):
            self._type(manager, str(clause.head[1]), parents, ())
        self.taken |= {(clause.head.functor, 1) for clause in self.clauses if self._is_type(clause)}

    def _type(self, manager: Any, name: str, parents: dict[str, str], below: tuple[str, ...]) -> Any:
        if name in below:
            raise CasperError(f"the types run in a circle: {' < '.join((*below, name))}")
        if name not in self.target.types:
            parent = parents.get(name)
            above = None if parent is None else self._type(manager, parent, parents, (*below, name))
            self.target.types[name] = manager.UserType(name, above)
            self.target.problem._add_user_type(self.target.types[name])
        return self.target.types[name]

    def _is_type(self, clause: Clause) -> bool:
        return clause.head.arity == 1 and inward(clause.head.functor) in self.target.types

    def _objects(self) -> None:
        for clause in self.clauses:
            if self._is_type(clause) and not clause.body:
                name, kind = clause.head[1], self.target.types[inward(clause.head.functor)]
                if self.target.problem.has_object(name):
                    raise Unplanned(f"{shown(name)} has two types; a problem gives it one", clause.place)
                self.target.problem.add_object(Object(str(name), kind, self.target.problem.environment))

    def _fluents(self) -> None:
        for clause in self._of("fluent", 2):
            name, *types = predication(clause.head[1])
            signature = {f"x{n}": self.target.type_named(t, clause.place) for n, t in enumerate(types, 1)}
            kind = self._value_type(clause, clause.head[2])
            fluent = Fluent(name, kind, environment=self.target.problem.environment, **signature)
            default = False if kind.is_bool_type() else None
            self.target.problem.add_fluent(fluent, default_initial_value=default)
            self.target.fluents[name] = fluent

    def _value_type(self, clause: Clause, said: Term) -> Any:
        manager = self.target.problem.environment.type_manager
        if said == "boolean":
            return manager.BoolType()
        name, *bounds = predication(said)
        if name not in ("integer", "real"):
            return self.target.type_named(said, clause.place)
        least, most = (number_of(bound) for bound in bounds) if len(bounds) == 2 else (None, None)
        if name == "real":
            return manager.RealType(least, most)
        return manager.IntType(None if least is None else int(least), None if most is None else int(most))

    def _initial(self) -> None:
        for clause in self.clauses:
            if clause.body:
                continue
            found = self._first_value(clause)
            if found is not None:
                scope = Scope(self.target, {}, clause.place)
                fluent, value = found
                first = True if value is None else scope.value(value)
                self.target.problem.set_initial_value(scope.fluent(fluent), first)

    def _first_value(self, clause: Clause) -> tuple[Term, Term | None] | None:
        """The fluent that a fact is about, and its value; None of what is true."""
        head = clause.head
        if head.indicator in _CHANGING:
            return head[1], head[2] if head.arity == 2 else None
        fluent = self.target.fluents.get(inward(head.functor))
        if fluent is None or self._is_type(clause) or head.indicator in _SAID:
            return None
        is_valued = not fluent.type.is_bool_type()
        if head.arity != fluent.arity + is_valued:
            return None
        self.taken.add(head.indicator)
        name = inward(head.functor)
        return (Compound((name, *head[1:-1])), head[-1]) if is_valued else (Compound((name, *head[1:])), None)

    # --- what can be done ------------------------------------------------------------------------------------------

    def _actions(self) -> None:
        for clause in self._of("agent_parameter", 2):
            self.target.agents[inward(str(clause.head[1]))] = int(clause.head[2])
        rules: dict[tuple[str, int], list[Clause]] = {}
        for clause in self.clauses:
            if clause.body and self._is_action(clause):
                rules.setdefault(clause.head.indicator, []).append(clause)
        effects: dict[tuple[str, int], list[Clause]] = {}
        for clause in self.clauses:
            if clause.head.indicator in EFFECTS:
                effects.setdefault(predication(clause.head[1]).indicator, []).append(clause)
        for indicator, clauses in rules.items():
            action = make_action(self.target, clauses, effects.pop(indicator, ()))
            self.target.problem.add_action(action)
            self.target.actions[action.name] = action
        for indicator, (clause, *_) in effects.items():
            told = f"{indicator[0]}/{indicator[1]} changes something, but no rule says when it is valid"
            raise Unplanned(told, clause.place)
        self.taken |= set(rules)

    def _is_action(self, clause: Clause) -> bool:
        """A rule whose first argument acts: that any actor may be, or that a parameter is said to be."""
        head = clause.head
        if head.indicator in _SAID or self._is_type(clause) or not head.args:
            return False
        if inward(head.functor) in self.target.agents:
            return True
        return any(predication(term) == ("actor", head[1]) for term in body_terms(clause))

    def _goal(self) -> None:
        rows = []
        for clause in self._of(GOAL_STATE, 0):
            rows.append(Scope(self.target, {}, clause.place).conditions(body_terms(clause)))
        for condition in any_of(self.target, rows) if rows else ():
            if not condition.is_true():
                self.target.problem.add_goal(condition)

    def _hierarchy(self) -> None:
        productions: Sequence[Any] = self.domain.library.productions
        conditions = dict(by_name(self._of("method", 1)))
        for clause in self._of("compound_task", 1):
            task = make_task(self.target, clause, productions)
            self.target.problem.add_task(task)
            self.target.tasks[task.name] = task
        for production in productions:
            if production.head.functor == NETWORK:
                make_network(self.target, production, conditions)
            elif not is_impossible(production):
                self.target.problem.add_method(make_method(self.target, production, conditions))
