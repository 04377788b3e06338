"""Lazily grown plans, as tests use them: every state, nothing dropped."""

from __future__ import annotations

from casper.engine.episodes.networks.asking import Asking
from casper.engine.episodes.networks.networks import Networks
from casper.engine.episodes.networks.state import State
from casper.engine.verification.observation import Observation, observation_of
from casper.kb.base import KnowledgeBase
from casper.plans.library import PlanLibrary


def networks(text: str, kb: KnowledgeBase | None = None, **options) -> Networks:
    """How the goals of a text go on."""
    library = PlanLibrary.from_text(text)
    goals = list(zip(library.goals, [goal for goal, _ in library.goal_terms]))
    return Networks(library.tables, goals, Asking(kb), **options)


def states_after(grown: Networks, seen: list[Observation | str], agent: str | None = None) -> dict[State, int]:
    """Every state after the observations, with the fewest leaves that were missed on the way."""
    states = {grown.begin(goal): 0 for goal in range(len(grown.goals))}
    actions = [(leaf.functor, leaf.arity) for leaf in grown.leaves()]
    for number, one in enumerate(seen):
        observation = one if isinstance(one, Observation) else observation_of(one, actions)
        after: dict[State, int] = {}
        for state, missed in states.items():
            for step in grown.steps(state, observation, agent):
                total = missed + step.missed
                after[step.state] = min(total, after.get(step.state, total))
        grown.observed(observation, agent, float(number))
        states = after
    return states
