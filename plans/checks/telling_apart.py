"""Telling goals apart: which cannot be, and how many observations it takes at worst.

Two goals are *inseparable* when their plans are the same: whatever is observed, one explains it as well as the other.
The *worst-case distinctiveness* of a library (Keren, Gal and Karpas, 2014) is the largest number of observations after
which two goals can both still explain all of them. It is told for partners of whom every step is seen, and for those
of whom steps may be missed, as the paper allows.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, islice

from casper.kb.checks.finding import Finding, note, warning
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Variable, as_term
from casper.kb.terms.unification import substitute, unify, variables_of
from casper.plans.library import PlanLibrary, goal_of
from casper.plans.trees.chart import Chart
from casper.plans.trees.plan import Plan
from casper.plans.trees.spelling import spelled_out

MOST_PAIRS = 5_000
MOST_WAYS = 64
MOST_STATES = 20_000


@dataclass(frozen=True, slots=True)
class Distinctiveness:
    """Two goals that a row of observations leaves both possible, and such a row of greatest length.

    ``is_exact`` is False when the search stopped at its budget: there may be a longer one.
    """

    goals: tuple[str, str]
    observations: tuple[Compound, ...]
    is_exact: bool = True

    @property
    def length(self) -> int:
        """After so many observations the goals may still not be told apart."""
        return len(self.observations)

    def __str__(self) -> str:
        shown = ", ".join(term_text(as_term(action)) for action in self.observations)
        return f"{self.goals[0]} and {self.goals[1]} may both be pursued after {self.length} observations: {shown}"


def findings(library: PlanLibrary) -> Iterator[Finding]:
    """What ``casper check`` has to say: inseparable goals as warnings, worst-case distinctiveness as a note.

    Of plans that cannot be listed nothing is said.
    """
    if not library.is_listed:
        return
    yield from inseparable_goals(library)
    for missing in (False, True):
        worst = worst_case_distinctiveness(library, missing)
        if worst is not None and worst.length:
            place = next(plan.place for plan in library.ways if plan.label == worst.goals[0])
            how = "even if steps go unseen" if missing else "if every step is seen"
            least = "" if worst.is_exact else " (at least; the search was cut short)"
            yield note(place, f"worst case before a goal is certain, {how}: {worst}{least}")


def inseparable_goals(library: PlanLibrary) -> Iterator[Finding]:
    """A warning for every goal that no observations can separate from an earlier one.

    Goals whose parameters have conditions may be told apart by the values, so they are left alone.
    """
    first: dict[frozenset[object], str] = {}
    conditional = {goal_of(clause).functor for clause in library.goal_clauses if clause.body}
    for label, plans in _by_goal(library.ways).items():
        signature = frozenset(_signature(way) for plan in plans for way in _ways(plan))
        if plans[0].goal.functor in conditional and any(plan.variables for plan in plans):
            continue
        earlier = first.setdefault(signature, label)
        if earlier != label:
            sentence = f"no observations can tell {label} from {earlier}: their plans have the same actions"
            yield warning(plans[0].place, sentence)


def worst_case_distinctiveness(library: PlanLibrary, missing: bool = False) -> Distinctiveness | None:
    """The longest row of observations that two goals can both explain; None when no two goals have one.

    Actions are told as far as both goals have them: arguments that only their sequence would settle are left open.

    Args:
        library: the plans.
        missing: whether steps may go unseen.
    """
    worst: Distinctiveness | None = None
    exact = True
    pairs = ((a, b) for a, b in combinations(library.ways, 2) if a.label != b.label)
    for a, b in islice(pairs, MOST_PAIRS):
        search = _Common(a, b, missing)
        row = search.longest()
        exact = exact and not search.is_cut_short
        if row and (worst is None or len(row) > worst.length):
            worst = Distinctiveness((a.label, b.label), row)
    if worst is None:
        return None
    return Distinctiveness(worst.goals, worst.observations, exact and next(pairs, None) is None)


class _Common:
    """The longest row of actions that two plans can both explain: a search through pairs of closed leaves."""

    def __init__(self, a: Plan, b: Plan, missing: bool) -> None:
        self.charts, self.missing = (a.chart, b.chart), missing
        self.is_cut_short = False
        apart = {v: Variable(v.name, v.serial - 1_000_000) for v in variables_of(*b.leaves)}
        theirs = [substitute(leaf, dict(apart)) for leaf in b.leaves]
        self.same = [
            (i, j, mine) for i, mine in enumerate(a.leaves) for j, other in enumerate(theirs)
            if unify(mine, other, {}) is not None
        ]  # fmt: skip
        self._known: dict[tuple[int, int], tuple[int, tuple[int, int] | None, Compound | None]] = {}

    def longest(self) -> tuple[Compound, ...]:
        """The actions of such a row."""
        self._search((0, 0))
        row: list[Compound] = []
        at = (0, 0)
        while True:
            _, following, action = self._known.get(at, (0, None, None))
            if following is None or action is None:
                return tuple(row)
            row.append(action)
            at = following

    def _search(self, start: tuple[int, int]) -> None:
        """Depth first with a stack of its own: plans may be long."""
        stack = [start]
        while stack:
            at = stack[-1]
            if at in self._known:
                stack.pop()
                continue
            steps = list(self._steps(at))
            waiting = [following for following, _ in steps if following not in self._known]
            if waiting and len(self._known) + len(stack) < MOST_STATES:
                stack.extend(waiting)
                continue
            self.is_cut_short = self.is_cut_short or bool(waiting)
            best: tuple[int, tuple[int, int] | None, Compound | None] = (0, None, None)
            for following, action in steps:
                length = 1 + self._known.get(following, (0, None, None))[0]
                if length > best[0]:
                    best = (length, following, action)
            self._known[at] = best
            stack.pop()

    def _steps(self, at: tuple[int, int]) -> Iterator[tuple[tuple[int, int], Compound]]:
        for i, j, action in self.same:
            if not (at[0] >> i & 1 or at[1] >> j & 1):
                first, second = _close(self.charts[0], at[0], i), _close(self.charts[1], at[1], j)
                if self.missing or not (first[1] or second[1]):
                    yield (first[0], second[0]), action


def _close(chart: Chart, closed: int, leaf: int) -> tuple[int, int]:
    """Closed leaves after the leaf, and how many were missed."""
    after, _, _, missed = chart.close((closed, chart.entered(closed), 0, 0), leaf)
    return after, missed


def _by_goal(plans: Sequence[Plan]) -> dict[str, list[Plan]]:
    goals: dict[str, list[Plan]] = {}
    for plan in plans:
        goals.setdefault(plan.label, []).append(plan)
    return goals


def _ways(plan: Plan) -> list[Plan]:
    """The plan spelled out, so that it does not matter how it is written; as it is, where that is too long."""
    ways = list(islice(spelled_out(plan), MOST_WAYS + 1))
    return ways if len(ways) <= MOST_WAYS else [plan]


def _signature(plan: Plan) -> object:
    """Equal for plans that differ in the names of their goal, tasks and parameters only."""
    names = {v: Variable("Parameter", at) for at, v in enumerate(variables_of(*plan.leaves))}
    chart = plan.chart
    leaves = tuple(substitute(leaf, dict(names)) for leaf in plan.leaves)
    return leaves, chart.before, chart.parts, chart.inside
