"""Plans as relations, so that they can be queried like everything else.

    step(Goal, Number, Action)   the goal's plan has this action as its leaf number (from 1)
    uses(Goal, Thing)            some action of the goal's plan names the thing: "which goals use the plate?"
    before(Goal, N, M)           its leaf number N is the last, or one of the last, that must come before number M
    optional(Goal, Number)       this leaf of the goal's plan may be left out
    alternative(Goal, N, M)      where its leaf N is done, leaf M never is
    task(Task)                   the task is done by a production

Each holds for the goals that the knowledge base allows: ``goal(breakfast(F)) :- biscuits(F)`` makes F the biscuits.
Of goals without parameters ``plan_step`` and its like hold the same rows whatever the knowledge base says of the goal.
"""

from __future__ import annotations

from collections.abc import Iterator

from casper.kb.clauses import Clause, Literal
from casper.kb.terms import Compound, Variable, as_term, is_ground, variables_of
from casper.plans.chart import bits
from casper.plans.library import PlanLibrary
from casper.plans.plan import Plan

RELATIONS = (
    *(("step", 3), ("uses", 2), ("before", 3), ("optional", 2), ("alternative", 3), ("task", 1)),
    *(("plan_step", 3), ("plan_uses", 2), ("plan_before", 3), ("plan_optional", 2), ("plan_alternative", 3)),
)


def plan_clauses(library: PlanLibrary) -> Iterator[Clause]:
    """The clauses of step/3, uses/2, before/3, optional/2, alternative/3 and task/1 for a library."""
    seen: set[Clause] = set()
    for plan in library.ways:
        for row in _rows(plan):
            if is_ground(row):
                yield from _once(seen, _general(row))
                yield from _once(seen, Clause(Compound((f"plan_{row.functor}", *row.args)), (), plan.place))
            else:
                yield from _once(seen, Clause(row, (Literal(Compound(("goal", row[1]))),), plan.place))
    for production in library.productions:
        yield from _once(seen, Clause(Compound(("task", production.head.functor)), (), production.place))


def _rows(plan: Plan) -> Iterator[Compound]:
    """What holds of a plan, if its goal does."""
    goal, chart = as_term(plan.goal), plan.chart
    parameters = set(variables_of(goal))
    for number, leaf in enumerate(plan.leaves, 1):
        yield Compound(("step", goal, number, as_term(leaf)))
        for thing in leaf.args:
            if not isinstance(thing, Variable) or thing in parameters:
                yield Compound(("uses", goal, thing))
        for earlier in chart.directly_before(number - 1):
            yield Compound(("before", goal, earlier + 1, number))
        if not chart.mandatory >> number - 1 & 1:
            yield Compound(("optional", goal, number))
        for rival in bits(chart.rivals(number - 1)):
            yield Compound(("alternative", goal, number, rival + 1))


def _general(row: Compound) -> Clause:
    """One rule for all goals without parameters: their rows are facts, so that large libraries stay small programs."""
    names = [Variable(name) for name in ("Goal", "Number", "What")[: row.arity]]
    body = (Literal(Compound((f"plan_{row.functor}", *names))), Literal(Compound(("goal", names[0]))))
    return Clause(Compound((row.functor, *names)), body)


def _once(seen: set[Clause], clause: Clause) -> Iterator[Clause]:
    if clause not in seen:
        seen.add(clause)
        yield clause
