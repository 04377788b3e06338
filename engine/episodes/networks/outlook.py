"""What lazily grown plans have ahead of them: what may come next, what is certain to come, and what to ask.

A state knows its open items, not the plans that they will become. So of a step it is known that it will be done, that
no way of going on has it, or neither; what some explanation does not know is not asked.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from math import inf

from casper.engine.episodes.networks.items.terms import ACT, PAR, SEQ, Row, outward
from casper.engine.episodes.networks.networks import Networks
from casper.engine.episodes.networks.state import State
from casper.engine.reading.outlook import shown
from casper.engine.reading.questions import Kind, Question, ranked
from casper.kb.terms.terms import Compound
from casper.kb.terms.unification import is_ground

MOST_ASKED = 300  # states that are asked; those beyond are the lightest


def next_actions(networks: Networks, state: State) -> list[str | None]:
    """What may come next without a miss (of a task that is not begun names with open arguments); None: nothing need."""
    coming: list[str | None] = [shown(leaf) for leaf in networks.next_leaves(state)]
    return [*coming, None] if networks.is_done(state) else coming


def certain(row: Row) -> Iterator[Compound]:
    """The actions of a row that will be done whatever else is, and of which every argument is known."""
    for item in row:
        if item[0] is ACT:
            action = outward(item[1])
            if is_ground(action):
                yield action
        elif item[0] is PAR or item[0] is SEQ:
            yield from certain(item[1])


def questions(networks: Networks, ends: Iterable[tuple[State, float]]) -> list[Question]:
    """What to find out, most telling first: is it this goal, will this still be done, is it next?

    Args:
        networks: how the goals go on.
        ends: where explanations end, and their share, the likeliest first.
    """
    kept = [end for end, _ in zip(ends, range(MOST_ASKED))]
    goals: dict[str, float] = {}
    told: dict[tuple[Kind, str], dict[str, float]] = {}

    def note(kind: Kind, about: str, goal: str, share: float) -> None:
        by_goal = told.setdefault((kind, about), {})
        by_goal[goal] = by_goal.get(goal, 0.0) + share

    steps = {action for state, _ in kept for action in certain(state.rest)}
    asked = [action for action in steps if _is_known(networks, kept, action)]
    for state, share in kept:
        goal = networks.goals[state.goal]
        goals[goal] = goals.get(goal, 0.0) + share
        note("goal", goal, goal, share)
        sure = set(certain(state.rest))
        for action in asked:
            if action in sure:
                note("step", shown(action), goal, share)
        coming = networks.next_leaves(state)
        for action in coming:
            if is_ground(action):
                note("next", shown(action), goal, share / len(coming))
    return ranked(goals, told)


def _is_known(networks: Networks, ends: Sequence[tuple[State, float]], action: Compound) -> bool:
    """Whether of every explanation it is known if the action will still be done."""
    name = action.functor, action.arity
    return all(
        action in certain(state.rest) or networks.methods.row_distance(state.rest, name) == inf for state, _ in ends
    )
