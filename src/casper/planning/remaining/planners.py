"""Planners of Unified Planning: one of them asked, and its plan as steps with their order."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from unified_planning.engines import PlanGenerationResultStatus as Status
from unified_planning.environment import get_environment
from unified_planning.model import Problem
from unified_planning.plans import ActionInstance, PlanKind

from casper.kb.errors import CasperError

KNOWN = {"pyperplan": "up-pyperplan", "fast-downward": "up-fast-downward", "aries": "up-aries"}
_FOUND = (Status.SOLVED_SATISFICING, Status.SOLVED_OPTIMALLY)
_NONE = (Status.UNSOLVABLE_PROVEN,)


@dataclass(frozen=True)
class Found:
    """Steps in an order that can be done; ``order`` holds the pairs of step numbers of which one must come first."""

    planner: str
    steps: tuple[ActionInstance, ...]
    order: frozenset[tuple[int, int]]


def find_plan(problem: Problem, planner: str | None = None, timeout: float | None = None) -> Found:
    """Ask a planner for a plan.

    Args:
        problem: what is to be reached.
        planner: its name (``pyperplan``, ``fast-downward``, ``aries``, or any that is registered with the framework);
            None: the first that can do such a problem.
        timeout: seconds.

    Raises:
        CasperError: there is no such planner, it cannot do such a problem, it found nothing in time, or it proved that
            there is nothing to find.
    """
    with _quiet(problem.environment), _opened(problem, planner) as engine:
        try:
            result = engine.solve(problem, timeout=timeout)
        except Exception as mistake:  # of a foreign program
            raise CasperError(f"{engine.name} failed: {_sentence(mistake)}; try another planner") from None
    if result.status in _NONE:
        raise CasperError(f"{engine.name} proved that nothing leads from here to the goal")
    if result.status not in _FOUND or result.plan is None:
        raise CasperError(f"{engine.name} found no plan ({result.status.name}): whether there is one is not known")
    steps, order = _steps(problem, result.plan)
    return Found(str(engine.name), steps, order)


def installed() -> list[str]:
    """The names of the planners that come with the extra and are there."""
    return [name for name in KNOWN if name in get_environment().factory.engines]


@contextmanager
def _opened(problem: Problem, planner: str | None) -> Iterator[Any]:
    factory = problem.environment.factory
    if planner is not None and planner not in factory.engines:
        way = KNOWN.get(planner)
        add = f": pip install {way}" if way else f"; there are {', '.join(installed()) or 'none'}"
        raise CasperError(f"there is no planner {planner}{add}")
    chosen = {"problem_kind": problem.kind} if planner is None else {"name": planner}
    try:
        engine = factory.OneshotPlanner(**chosen)
    except Exception as mistake:
        raise CasperError(f"no planner can do such a problem: {_sentence(mistake)}") from None
    with engine:
        if not type(engine).supports(problem.kind):
            beyond = sorted(problem.kind.features - type(engine).supported_kind().features)
            raise CasperError(f"{engine.name} cannot do a problem with {', '.join(beyond)}; try another planner")
        yield engine


@contextmanager
def _quiet(environment: Any) -> Iterator[None]:
    """No credits and no warnings meanwhile; afterwards the framework is as it was."""
    before = environment.credits_stream
    environment.credits_stream = None
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    finally:
        environment.credits_stream = before


def _steps(problem: Problem, plan: Any) -> tuple[tuple[ActionInstance, ...], frozenset[tuple[int, int]]]:
    if plan.kind == PlanKind.HIERARCHICAL_PLAN:
        plan = plan.action_plan
    if plan.kind == PlanKind.TIME_TRIGGERED_PLAN:
        steps = tuple(action for _, action, _ in sorted(plan.timed_actions, key=lambda timed: timed[0]))
        return steps, frozenset((at, at + 1) for at in range(len(steps) - 1))
    if plan.kind == PlanKind.SEQUENTIAL_PLAN:
        plan = plan.convert_to(PlanKind.PARTIAL_ORDER_PLAN, problem)
    graph = plan.get_adjacency_list
    steps = tuple(next(iter(plan.all_sequential_plans())).actions)
    number = {id(step): at for at, step in enumerate(steps)}
    pairs = ((number[id(a)], number[id(b)]) for a, after in graph.items() for b in after)
    return steps, frozenset(pairs)


def _sentence(mistake: Exception) -> str:
    return " ".join(str(mistake).split()).rstrip(".")[:300] or type(mistake).__name__
