"""What a partner may be seen to do: a plan's steps in an order that it allows, some unseen, needless or misread."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from hypothesis import strategies as st

from casper.engine.domain.domain import Domain
from casper.kb.errors import CasperError
from casper.plans.library import PlanLibrary
from casper.plans.trees.plan import Plan
from casper.testing.parameters import actions_of, filled_in
from casper.testing.values import text_of


@dataclass(frozen=True, slots=True)
class Pursuit:
    """A goal and what was seen of its pursuit.

    ``actions`` is what is to be observed; ``steps`` what was really done for the goal. ``unseen`` and ``misread`` are
    numbers of steps, ``needless`` numbers of actions, from 0; ``others`` are the steps that the plan leaves to somebody
    else, by(robot, …), whom nobody watches.
    """

    goal: str
    actions: tuple[str, ...]
    steps: tuple[str, ...]
    unseen: tuple[int, ...] = ()
    needless: tuple[int, ...] = ()
    misread: tuple[int, ...] = ()
    others: tuple[int, ...] = ()

    @property
    def own(self) -> tuple[str, ...]:
        """The steps that the partner does."""
        return tuple(step for number, step in enumerate(self.steps) if number not in self.others)


@dataclass(frozen=True, slots=True)
class Interleaving:
    """Several pursuits at once: ``actions`` in one row, and for each the number of the pursuit that it belongs to."""

    pursuits: tuple[Pursuit, ...]
    actions: tuple[str, ...]
    of: tuple[int, ...]

    @property
    def goals(self) -> frozenset[str]:
        """What is pursued."""
        return frozenset(pursuit.goal for pursuit in self.pursuits)


@st.composite
def observations(
    draw: st.DrawFn,
    library: PlanLibrary | Domain,
    *,
    goal: str | None = None,
    drop: float = 0.0,
    needless: float = 0.0,
    misread: float = 0.0,
) -> Pursuit:
    """A pursuit of a goal.

    Args:
        draw: hypothesis'.
        library: plans, or a domain: then parameters are filled in by what its goals' conditions and its rules allow.
        goal: the label of a goal; any by default.
        drop, needless, misread: which part of the steps may go unseen (at least one is seen), how many needless actions
            there may be for each step, and which part of what is seen may be taken for another action; from 0 to 1.

    Raises:
        CasperError: no such goal, or a part that is none.
    """
    for name, part in (("drop", drop), ("needless", needless), ("misread", misread)):
        if not 0 <= part <= 1:
            raise CasperError(f"{name} is a part from 0 to 1, not {part}")
    plans = _plans(library, goal)
    plan = plans[draw(st.integers(0, len(plans) - 1))] if len(plans) > 1 else plans[0]
    leaves = _performed(draw, plan)
    steps = [text_of(step) for step in filled_in(library, plan, leaves, draw)]
    partner = library.partner if isinstance(library, Domain) else None
    doers = [plan.actions[leaf].by for leaf in leaves]
    others = tuple(number for number, by in enumerate(doers) if isinstance(by, str) and by != partner)
    return _seen(
        draw, library, plan.label, steps, (drop, needless, misread), others if len(others) < len(steps) else ()
    )


def interleavings(*pursuits: st.SearchStrategy[Pursuit]) -> st.SearchStrategy[Interleaving]:
    """Several pursuits in one row, each in its own order; without a choice one after the other."""
    return st.tuples(*pursuits).flatmap(_merged)


def _merged(pursuits: tuple[Pursuit, ...]) -> st.SearchStrategy[Interleaving]:
    row = [number for number, pursuit in enumerate(pursuits) for _ in pursuit.actions]

    def made(order: Sequence[int]) -> Interleaving:
        left = [iter(pursuit.actions) for pursuit in pursuits]
        return Interleaving(pursuits, tuple(next(left[number]) for number in order), tuple(order))

    return st.permutations(row).map(made)


def _plans(library: PlanLibrary | Domain, goal: str | None) -> list[Plan]:
    ways = (library.library if isinstance(library, Domain) else library).ways
    chosen = [plan for plan in ways if goal is None or plan.label == goal]
    if not chosen:
        known = ", ".join(dict.fromkeys(plan.label for plan in ways)) or "none"
        raise CasperError(f"there is no goal {goal}; there are {known}")
    return chosen


def _performed(draw: st.DrawFn, plan: Plan) -> list[int]:
    """The numbers of the leaves that are done, in an order that the plan allows; optional ones may be left out."""
    chart, progress, done = plan.chart, plan.chart.start, list[int]()
    while following := chart.next_leaves(progress[0]):
        if not chart.belonging(chart.entered(progress[0])) & ~progress[0] and not draw(st.booleans()):
            break  # only optional leaves are left
        leaf = following[draw(st.integers(0, len(following) - 1))] if len(following) > 1 else following[0]
        done.append(leaf)
        progress = chart.close(progress, leaf)
    return done


def _seen(
    draw: st.DrawFn,
    library: PlanLibrary | Domain,
    goal: str,
    steps: list[str],
    parts: tuple[float, float, float],
    others_do: tuple[int, ...],
) -> Pursuit:
    drop, needless, misread = parts
    numbers = [number for number in range(len(steps)) if number not in others_do]
    unseen = _some(draw, numbers, min(int(drop * len(steps)), len(numbers) - 1))
    wrong = _some(draw, [n for n in numbers if n not in unseen], int(misread * (len(numbers) - len(unseen))))
    others = [text_of(action) for action in actions_of(library)] if needless or misread else []
    actions = [_another(draw, others, steps[n]) if n in wrong else steps[n] for n in numbers if n not in unseen]
    extra: list[int] = []
    most = int(needless * len(steps))
    for _ in range(draw(st.integers(0, most)) if most else 0):
        at = draw(st.integers(0, len(actions)))
        actions.insert(at, others[draw(st.integers(0, len(others) - 1))])
        extra = [*(n + (n >= at) for n in extra), at]
    return Pursuit(goal, tuple(actions), tuple(steps), unseen, tuple(sorted(extra)), wrong, others_do)


def _some(draw: st.DrawFn, numbers: Sequence[int], most: int) -> tuple[int, ...]:
    """Up to so many of the numbers, in order; none by preference."""
    if most <= 0:
        return ()
    return tuple(sorted(draw(st.sets(st.sampled_from(list(numbers)), max_size=most))))


def _another(draw: st.DrawFn, actions: Sequence[str], than: str) -> str:
    others = [action for action in actions if action != than]
    return others[draw(st.integers(0, len(others) - 1))] if others else than
