"""A plan's steps with their parameters filled in, by what a domain says of its goals and its statements."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

from hypothesis import strategies as st

from casper.engine.domain.domain import Domain
from casper.kb.errors import CasperError
from casper.kb.terms.terms import Compound, Term, Variable
from casper.kb.terms.unification import Bindings, is_ground, substitute, unify
from casper.plans.library import GOAL, PlanLibrary
from casper.plans.trees.plan import Plan

MOST_VALUES = 200  # instances of a goal or a step that are drawn from


def filled_in(library: PlanLibrary | Domain, plan: Plan, leaves: Sequence[int], draw: st.DrawFn) -> list[Compound]:
    """The leaves of a plan, in that order; what nothing settles stays a variable.

    With a domain: a goal's parameters are such as its conditions allow, those of each step such as make it valid for
    the partner after the steps before, where some do.
    """
    known: Bindings = {}
    if not isinstance(library, Domain):
        return [plan.leaves[leaf] for leaf in leaves]
    if library.verifies and library.kb.defines(*GOAL):
        known = _one_of(draw, plan.goal, _goals(library), known)
    steps: list[Compound] = []
    for leaf in leaves:
        step = substitute(plan.leaves[leaf], known)
        if not is_ground(step) and library.verifies:
            known = _one_of(draw, step, _valid(library, step.functor, step.arity), known)
            step = substitute(plan.leaves[leaf], known)
        steps.append(step)
    return steps


def actions_of(library: PlanLibrary | Domain) -> list[Compound]:
    """Actions that anybody might do: the valid ones of a domain, else the leaves of the plans."""
    if isinstance(library, Domain):
        names = library.library.actions if library.verifies else ()
        found = [action for name, arity in names for action in _valid(library, name, arity)]
        return found or actions_of(library.library)
    return list(dict.fromkeys(leaf for plan in library.ways for leaf in plan.leaves))


def _one_of(draw: st.DrawFn, wanted: Compound, instances: Sequence[Compound], known: Bindings) -> Bindings:
    """The bindings extended so that the term is one of the instances, where it can be one."""
    fitting = [b for b in (unify(substitute(wanted, known), instance, {}) for instance in instances) if b is not None]
    if not fitting:
        return known
    chosen = fitting[draw(st.integers(0, len(fitting) - 1))] if len(fitting) > 1 else fitting[0]
    return {**{v: substitute(value, chosen) for v, value in known.items()}, **chosen}


@lru_cache(maxsize=64)
def _goals(domain: Domain) -> tuple[Compound, ...]:
    """The goals that the domain's conditions allow."""
    return tuple(_terms(answer["G"]) for answer in domain.kb.query("goal(G)", MOST_VALUES))


@lru_cache(maxsize=1024)
def _valid(domain: Domain, name: str, arity: int) -> tuple[Compound, ...]:
    """Actions of a name that are valid for the partner, without the partner."""
    variables = [Variable(f"A{at}") for at in range(arity)]
    statement = Compound((name, domain.partner, *variables))
    found: list[Compound] = []
    try:
        for instance in domain.kb.instances(Compound(("valid", statement))):
            inner = instance[1]
            assert isinstance(inner, Compound)
            if is_ground(inner):
                found.append(Compound((name, *inner.args[1:])))
            if len(found) >= MOST_VALUES:
                break
    except CasperError:  # undefined, or too far to search for: what was found stands
        pass
    return tuple(found)


def _terms(term: Term) -> Compound:
    return term if isinstance(term, Compound) else Compound((term,))
