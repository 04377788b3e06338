"""Plans that are listed, each tried out step by step.

Each step is tried by itself, at the best moment the plan allows: once with as much done before it as possible, and once
with as little. So what is reported is impossible indeed; what only goes wrong through the order of several steps is not
found. Steps combine as the plan says: all of a sequence, one of a choice, none of an optional part.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import count, islice
from typing import TypeAlias

from casper.engine.domain.domain import Domain
from casper.engine.domain.trying.obstacle import ANYBODY, Obstacle
from casper.engine.verification.conditions import Conditions
from casper.engine.verification.history import in_plan_order
from casper.kb.checks.finding import Finding, error, note, warning
from casper.kb.errors import BudgetExceeded, CasperError
from casper.kb.reasons.why_not import Refusal
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.kb.terms.unification import Bindings, substitute, unify
from casper.plans.library import GOAL
from casper.plans.trees.chart import bits, union
from casper.plans.trees.nodes import Action, Condition, Node, Shape
from casper.plans.trees.plan import Plan

MOST_PLANS = 500  # looked at
MOST_TRIED = 2_000  # steps tried of one plan, over all values of its parameters
MOST_VALUES = 50  # of a goal's parameters
Row: TypeAlias = list[Obstacle | None]  # by leaf, or by value of the goal's parameters


@dataclass(frozen=True, slots=True)
class _Judged:
    """A node with what stands in its way, for each value of the goal's parameters."""

    node: Node
    row: Row
    children: tuple[_Judged, ...] = ()

    @property
    def kind(self) -> str:
        """How its children combine."""
        return self.node.kind if isinstance(self.node, Shape) else "sequence"

    @property
    def obstacle(self) -> Obstacle | None:
        """The first obstacle, if there is one whatever the parameters are."""
        return self.row[0] if self.row and all(self.row) else None


def listed_plans(domain: Domain) -> Iterator[Finding]:
    """Goals that cannot be pursued, parts that cannot be done, and steps at which the partner is never seen."""
    ways = domain.library.ways
    plans = ways[:MOST_PLANS]
    if len(ways) > len(plans):
        yield note(plans[0].place, f"only the first {MOST_PLANS} of {len(ways)} plans were tried out")
    tried = [_Tried(domain, plan) for plan in plans]
    possible = {each.plan.label for each in tried if each.obstacle is None}
    for each in tried:
        label, obstacle = each.plan.label, each.obstacle
        if obstacle is None:
            yield from each.impossible_parts()
            yield from each.never_seen()
        elif label in possible:
            yield warning(obstacle.place, f"one way to pursue {label} is impossible: {obstacle}")
        else:
            yield error(each.plan.place, f"the goal {label} cannot be pursued: {obstacle}")


class _Tried:
    """A plan whose steps were tried with every value of the goal's parameters."""

    def __init__(self, domain: Domain, plan: Plan) -> None:
        self.domain, self.plan = domain, plan
        self.values: list[Bindings] = []
        self.rows: list[Row] = []
        self.obstacle: Obstacle | None = None
        self.root = _Judged(plan.root, [])
        try:
            self.values = list(islice(_values(domain, plan), max(1, min(MOST_VALUES, MOST_TRIED // len(plan.leaves)))))
            self.rows = [_refusals(domain, plan, values, None) for values in self.values]
            refusing = partial(_never, Conditions(domain.kb), self.values)
            self.root = _judged(plan.root, self.rows, count(), refusing)
            self.obstacle = self.root.obstacle if self.values else _forbidden(domain, plan)
        except BudgetExceeded:
            pass  # a search without an end keeps nobody from anything
        except CasperError as mistake:
            self.obstacle = Obstacle(None, mistake.place or plan.place, (mistake.sentence,))

    def impossible_parts(self) -> Iterator[Finding]:
        """Alternatives and optional parts that nobody can do."""
        waiting = [self.root]
        while waiting:
            judged = waiting.pop(0)
            for child in judged.children:
                part = judged.kind == "choice" or child.kind == "optional"
                if part and child.obstacle is not None:
                    what = "one way to pursue" if judged.kind == "choice" else "an optional part of"
                    sentence = f"{what} {self.plan.label} is impossible: {child.obstacle}"
                    yield warning(child.obstacle.place, sentence)
                else:
                    waiting.append(child)

    def never_seen(self) -> Iterator[Finding]:
        """The first step that others can do and the partner cannot."""
        partner, plan = self.domain.partner, self.plan
        theirs = [_refusals(self.domain, plan, values, partner) for values in self.values]
        for leaf, action in enumerate(plan.actions):
            if isinstance(action.by, str) and action.by != partner:
                continue  # the plan says so itself
            obstacle = next((row[leaf] for row in theirs if all(row[leaf] for row in theirs)), None)
            if obstacle is not None and obstacle.step is not None and not all(row[leaf] for row in self.rows):
                shown, because = term_text(as_term(obstacle.step)), "; ".join(obstacle.reasons)
                sentence = f"{partner} is never seen to do {shown} of {plan.label}, because {because}"
                yield note(action.place, f"{sentence}; others can do it")
                return


def _judged(
    node: Node, rows: Sequence[Row], leaves: Iterator[int], refusing: Callable[[Condition], Row]
) -> _Judged:
    """The node with all below it; the leaves are counted from left to right."""
    if isinstance(node, Condition):
        return _Judged(node, refusing(node) if rows else [])
    if isinstance(node, Action):
        leaf = next(leaves)
        return _Judged(node, [row[leaf] for row in rows])
    children = tuple(_judged(child, rows, leaves, refusing) for child in node.children)
    if isinstance(node, Shape) and node.kind == "choice":
        found = [each[0] if all(each) else None for each in zip(*(child.row for child in children))]
    else:
        needed = [child.row for child in children if child.kind != "optional"] or [[None] * len(rows)]
        found = [next((obstacle for obstacle in each if obstacle), None) for each in zip(*needed)]
    return _Judged(node, found, children)


def _values(domain: Domain, plan: Plan) -> Iterator[Bindings]:
    """What the goal's conditions allow its parameters to be."""
    goal = Compound(("goal", as_term(plan.goal)))
    if not domain.kb.defines(*GOAL):
        yield {}
        return
    for answer in domain.kb.instances(goal):
        bindings = unify(goal, answer, {})
        if bindings is not None:
            yield bindings


def _forbidden(domain: Domain, plan: Plan) -> Obstacle:
    refusal = domain.kb.why_not(Compound(("goal", as_term(plan.goal))))
    reasons = refusal.reasons if refusal is not None else ("no value of its parameters makes it a goal",)
    return Obstacle(None, plan.place, reasons)


def _refusals(domain: Domain, plan: Plan, values: Bindings, agent: str | None) -> Row:
    """By leaf, why the agent (None: anybody) cannot do it; None where it can. What is done before, the partner did."""
    steps = [substitute(action.term, values) for action in plan.actions]
    done = [Compound((step.functor, domain.partner, *step.args)) for step in steps]
    found: Row = []
    for leaf, step in enumerate(steps):
        claim, refusal = Compound((step.functor, agent or ANYBODY, *step.args)), None
        for before in _moments(plan, leaf) if domain.kb.depends_on_history else [0]:
            verdict = domain.kb.verify(claim, in_plan_order(done, before, plan.chart.before))
            if verdict.valid is not False:
                refusal = None
                break
            refusal = refusal or Obstacle(step, plan.actions[leaf].place, verdict.reasons)
        found.append(refusal)
    return found


def _never(conditions: Conditions, values: Sequence[Bindings], condition: Condition) -> Row:
    """By value of the goal's parameters why a condition can never hold; one that looks back may hold some time."""
    found: Row = []
    for bindings in values:
        answer = None if conditions.looks_back(condition.term) else conditions.ask(condition.term, bindings, ())
        told = answer.reasons if isinstance(answer, Refusal) else None
        found.append(None if told is None else Obstacle(None, condition.place, told, condition.term.functor))
    return found


def _moments(plan: Plan, leaf: int) -> list[int]:
    """Masks of what may be done before a leaf: what must be, and all that can be."""
    chart = plan.chart
    after = union(1 << other for other in range(chart.leaves) if chart.before[other] >> leaf & 1)
    rivals = union(chart.parts[at].rivals for at in bits(chart.inside[leaf]))
    everything = (1 << chart.leaves) - 1
    least = chart.before[leaf] & chart.belonging(chart.inside[leaf])
    return [least, everything & ~(after | rivals | 1 << leaf)]
