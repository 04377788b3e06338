"""Plans as relations, so that they can be queried like everything else.

    step(Goal, Number, Action)   the goal's plan has this action as its leaf number (from 1)
    uses(Goal, Thing)            some action of the goal's plan names the thing: "which goals use the plate?"
    before(Goal, N, M)           its leaf number N is the last, or one of the last, that must come before number M
    optional(Goal, Number)       this leaf of the goal's plan may be left out
    alternative(Goal, C, A, N)   its leaf N stands in alternative A of its choice C (from 1); one alternative is done
    task(Task)                   the task is done by a production

Each holds for the goals that the knowledge base allows: ``goal(breakfast(F)) :- biscuits(F)`` makes F the biscuits.
Of a library whose plans have no end, or are too many to be listed, all but task/1 are undefined, and say so.
Of goals without parameters ``plan_step`` and its like hold the same rows whatever the knowledge base says of the goal.
"""

from __future__ import annotations

from collections.abc import Iterator

from casper.kb.errors import Place
from casper.kb.terms.clauses import Clause, Literal
from casper.kb.terms.terms import Compound, Term, Variable, as_term
from casper.kb.terms.unification import is_ground, variables_of
from casper.plans.library import PlanLibrary
from casper.plans.trees.chart import bits
from casper.plans.trees.plan import Plan

RELATIONS = (
    *(("step", 3), ("uses", 2), ("before", 3), ("optional", 2), ("alternative", 4), ("task", 1)),
    *(("plan_step", 3), ("plan_uses", 2), ("plan_before", 3), ("plan_optional", 2), ("plan_alternative", 4)),
)


UNLISTED = "unlisted_plans"


def plan_clauses(library: PlanLibrary) -> Iterator[Clause]:
    """The clauses of step/3, uses/2, before/3, optional/2, alternative/4 and task/1 for a library, each once."""
    if not library.is_listed:
        yield from _undefined()
        yield from _task_clauses(library)
        return
    seen: set[Compound] = set()
    general: set[Term] = set()  # relations that have their rule for all goals without parameters
    for plan in library.ways:
        condition = (Literal(Compound(("goal", as_term(plan.goal)))),)
        for row in _rows(plan):
            if row in seen:
                continue
            seen.add(row)
            if plan.variables and not is_ground(row):
                yield Clause(row, condition, plan.place)
                continue
            if row[0] not in general:
                general.add(row[0])
                yield _general(row)
            yield Clause(Compound((f"plan_{row[0]}", *row[1:])), (), plan.place)
    yield from _task_clauses(library)


def _undefined() -> Iterator[Clause]:
    """Rules by which the relations are neither true nor false: what they need has no value, and says why."""
    why = Variable("Why")
    yield Clause(Compound((UNLISTED, "the plans have no end or are too many, so their steps are not listed")))
    body = (Literal(Compound((UNLISTED, why))), Literal(Compound(("<", why, 1))))
    for name, arity in RELATIONS[:5]:
        yield Clause(Compound((name, *(Variable(f"_#{at}") for at in range(1, arity + 1)))), body)


def _rows(plan: Plan) -> Iterator[Compound]:
    """What holds of a plan, if its goal does."""
    goal, chart = as_term(plan.goal), plan.chart
    parameters, used = set(variables_of(goal)), set[Term]()
    for number, leaf in enumerate(plan.leaves, 1):
        yield Compound(("step", goal, number, as_term(leaf)))
        for thing in leaf.args:
            if thing not in used and (not isinstance(thing, Variable) or thing in parameters):
                used.add(thing)
                yield Compound(("uses", goal, thing))
        for earlier in chart.directly_before(number - 1):
            yield Compound(("before", goal, earlier + 1, number))
        if not chart.mandatory >> number - 1 & 1:
            yield Compound(("optional", goal, number))
        for choice, alternative in (chart.choices[at] for at in bits(chart.inside[number - 1]) if at in chart.choices):
            yield Compound(("alternative", goal, choice + 1, alternative + 1, number))


def _general(row: Compound) -> Clause:
    """One rule for all goals without parameters: their rows are facts, so that large libraries stay small programs."""
    names = [Variable(name) for name in ("Goal", "Number", "What", "Leaf")[: row.arity]]
    body = (Literal(Compound((f"plan_{row.functor}", *names))), Literal(Compound(("goal", names[0]))))
    return Clause(Compound((row.functor, *names)), body)


def _task_clauses(library: PlanLibrary) -> Iterator[Clause]:
    places: dict[str, Place] = {}
    for production in library.productions:
        places.setdefault(production.head.functor, production.place)
    return (Clause(Compound(("task", task)), (), place) for task, place in places.items())
