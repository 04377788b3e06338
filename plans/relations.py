"""Plans as relations, so that they can be queried like everything else.

    step(Goal, Number, Action)   the goal's plan has this action as its leaf number (from 1)
    uses(Goal, Thing)            some action of the goal's plan names the thing: "which goals use the plate?"
    before(Goal, N, M)           its leaf number N is the last, or one of the last, that must come before number M
    optional(Goal, Number)       this leaf of the goal's plan may be left out
    task(Task)                   the task is done by a production

Each holds for the goals that the knowledge base allows: ``goal(breakfast(F)) :- biscuits(F)`` makes F the biscuits.
"""

from __future__ import annotations

from collections.abc import Iterator

from casper.kb.clauses import Clause, Literal
from casper.kb.terms import Compound, Variable, as_term, variables_of
from casper.plans.chart import chart_of
from casper.plans.library import PlanLibrary

RELATIONS = (("step", 3), ("uses", 2), ("before", 3), ("optional", 2), ("task", 1))


def plan_clauses(library: PlanLibrary) -> Iterator[Clause]:
    """The clauses of step/3, uses/2, before/3, optional/2 and task/1 for a library."""
    seen: set[Clause] = set()
    for plan in library.ways:
        goal = as_term(plan.goal)
        condition = (Literal(Compound(("goal", goal))),)
        parameters = set(variables_of(goal))
        for number, leaf in enumerate(plan.leaves, 1):
            yield from _once(seen, Clause(Compound(("step", goal, number, as_term(leaf))), condition, plan.place))
            for thing in leaf.args:
                if not isinstance(thing, Variable) or thing in parameters:
                    yield from _once(seen, Clause(Compound(("uses", goal, thing)), condition, plan.place))
        chart = chart_of(plan)
        for number in range(chart.leaves):
            for earlier in chart.directly_before(number):
                pair = Compound(("before", goal, earlier + 1, number + 1))
                yield from _once(seen, Clause(pair, condition, plan.place))
            if not chart.mandatory >> number & 1:
                yield from _once(seen, Clause(Compound(("optional", goal, number + 1)), condition, plan.place))
    for production in library.productions:
        yield from _once(seen, Clause(Compound(("task", production.head.functor)), (), production.place))


def _once(seen: set[Clause], clause: Clause) -> Iterator[Clause]:
    if clause not in seen:
        seen.add(clause)
        yield clause
