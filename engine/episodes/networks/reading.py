"""A reading of plans that are not listed: what `engine.reading.reading.Reading` says, from lazily grown states.

Several goals at once it refuses: a day reads those.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import Any

from casper.engine.collaboration.collaboration import Capability, CollaborativePlan, collaborative_plan
from casper.engine.episodes.networks.networks import Networks
from casper.engine.episodes.networks.outlook import next_actions, questions
from casper.engine.episodes.networks.telling import GrownTeller
from casper.engine.explanation.explanation import Explanation, Interleaved
from casper.engine.reading.policy import Policy
from casper.engine.reading.questions import Question
from casper.engine.reading.reading import Reading
from casper.engine.recognition.options import Options
from casper.engine.verification.matching import Agents
from casper.engine.verification.observation import Seen
from casper.engine.verification.vocabulary import Vocabulary
from casper.kb.errors import CasperError
from casper.kb.reasons.says import Words
from casper.kb.terms.terms import Compound
from casper.plans.library import PlanLibrary

MOST_ASKED = 20  # states of a goal that are asked for reasons


class GrownReading(Reading):
    """Explanations of a growing row of observations, of one goal each.

    Args:
        library: the plans.
        networks: how their goals go on, before anything was observed.
        policy: when to commit to a goal.
        capability: what an agent can do of a plan's leaves.
        options: noise, priors, another score, a budget.

    Raises:
        CasperError: options that make no sense, or several goals at once.
    """

    _engine: GrownTeller  # type: ignore[assignment]

    def __init__(
        self, library: PlanLibrary, networks: Networks, policy: Policy, capability: Capability, options: Options
    ) -> None:
        options.check()
        if options.goals > 1:
            sentence = "plans that are not listed are read one goal at a time here"
            raise CasperError(f"{sentence}: several at once are read by domain.day(), or casper explain --changes")
        self.library, self.policy, self.options = library, policy, options
        self._actions = list(library.actions)
        self._capability = capability
        self._fresh = networks
        self._engine = GrownTeller(networks.fork(), options, networks.partner)
        self._read = {}
        self._numbers = {label: [number] for number, label in enumerate(networks.goals)}
        self._rejected = []

    @cached_property
    def _vocabulary(self) -> Vocabulary:
        """The plans' actions; they are not listed, so the grammar has them."""
        return Vocabulary(self._fresh.leaves())

    @property
    def agents(self) -> Agents:
        """Who is watched, and who helps."""
        return Agents(self._fresh.partner, self._fresh.robot)

    def __reduce__(self) -> tuple[Any, ...]:
        """By what it was made of and what was observed, which is observed again where it arrives."""
        made = self.library, self._fresh, self.policy, self._capability, self.options
        return _resumed, (*made, self.observations, self.words)

    def plan_for(self, agent: str, explanation: Explanation | Interleaved | None = None) -> CollaborativePlan | None:
        """What the agent can do for the goal of the best explanation; None when there is none to help with."""
        chosen = explanation or self.first
        if chosen is None:
            return None
        return collaborative_plan(agent, chosen.parts[0].situation, self._capability)

    @property
    def next_actions(self) -> dict[str | None, float]:
        """The probability of each action to be the next step; of a task that is not begun by name and arity."""
        found: dict[str | None, float] = {}
        for state, share in self._engine.ends() if self.observations else ():
            coming = next_actions(self._engine.networks, state)
            for action in coming:
                found[action] = found.get(action, 0.0) + share / len(coming)
        return dict(sorted(found.items(), key=lambda item: -item[1]))

    @property
    def frontiers(self) -> dict[tuple[Compound, ...], float]:
        """The probability of each frontier, over all explanations."""
        found: dict[tuple[Compound, ...], float] = {}
        for state, share in self._engine.ends() if self.observations else ():
            frontier = tuple(self._engine.networks.rest(state))
            found[frontier] = found.get(frontier, 0.0) + share
        return dict(sorted(found.items(), key=lambda item: -item[1]))

    def plans_for(self, agent: str) -> dict[CollaborativePlan, float]:
        """The probability of each collaborative plan of the agent, over all explanations."""
        found: dict[CollaborativePlan, float] = {}
        for explanation in self.explanations() if self.observations else ():
            plan = collaborative_plan(agent, explanation.parts[0].situation, self._capability)
            found[plan] = found.get(plan, 0.0) + explanation.share
        return dict(sorted(found.items(), key=lambda item: -item[1]))

    def questions(self) -> list[Question]:
        """What to find out, most telling first; nothing is asked that some explanation does not know (`outlook`)."""
        return questions(self._engine.networks, self._engine.ends()) if self.observations else []

    def _reasons(self, label: str, level: int) -> tuple[str, ...]:
        """Why a goal fell: what its states before the observation say of it."""
        if not level:
            return ()
        goal, engine = self._numbers[label][0], self._engine
        states = dict.fromkeys(end[0] for end in engine.levels[level - 1].ends if end[0].goal == goal)
        seen, past = self.observations[level - 1], engine.pasts[level - 1]
        found: dict[str, None] = {}
        for state in list(states)[:MOST_ASKED]:
            found.update(dict.fromkeys(past.reasons(state, seen, engine.partner)))
        return tuple(found)

    def _reject(self, level: int) -> dict[str, tuple[str, ...]]:
        """The goals without an explanation: those that fell earlier keep their reasons, new ones get theirs."""
        alive = {self._engine.networks.goals[goal] for goal in self._engine.alive(level)}
        before = self._rejected[level - 1] if level else {}
        return {x: before.get(x) or self._reasons(x, level) for x in self._numbers if x not in alive}


def _resumed(
    library: PlanLibrary,
    networks: Networks,
    policy: Policy,
    capability: Capability,
    options: Options,
    observations: Sequence[Seen],
    words: Words,
) -> GrownReading:
    """A reading in which everything is observed again."""
    reading = GrownReading(library, networks, policy, capability, options)
    reading.words = words
    for seen in observations:
        reading.observe(seen)
    return reading
