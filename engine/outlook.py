"""What is likely to come: the next action, the frontier, collaborative plans, and the question that would tell most.

All of it is read off where explanations end (`Recogniser.ends`), so nothing is enumerated.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import log2
from typing import Any, Literal, TypeAlias

from casper.engine.collaboration import Capability, CollaborativePlan, collaborative_plan
from casper.engine.matching import Binding, bindings_of
from casper.engine.recognisers import Recogniser
from casper.engine.situation import Situation
from casper.kb.terms import Compound, as_term, substitute
from casper.kb.writer import term_text
from casper.plans.chart import bits
from casper.plans.plan import Plan

Kind: TypeAlias = Literal["goal", "done", "step", "next"]
ASKED = {"goal": "is the goal {}?", "done": "was {} done?", "step": "will {} still be done?", "next": "is {} next?"}


@dataclass(frozen=True, slots=True)
class Question:
    """Something to find out: ``gain`` is how many bits of the uncertainty about the goal the answer takes on average.

    ``kind`` is ``goal`` (is it this goal?), ``done`` (was this action done, seen or unseen?), ``step`` (is it still to
    be done?) or ``next`` (is it the next one? it may be asked, or simply be watched for). ``yes`` is the probability of
    that answer.
    """

    kind: Kind
    about: str
    yes: float
    gain: float

    def __str__(self) -> str:
        return ASKED[self.kind].format(self.about)

    def to_json(self) -> dict[str, Any]:
        """``{"question", "kind", "about", "yes", "gain"}``."""
        return {"question": str(self), "kind": self.kind, "about": self.about, "yes": self.yes, "gain": self.gain}


def entropy(shares: Sequence[float]) -> float:
    """The entropy of a distribution in bits; it need not be normalised."""
    whole = sum(shares)
    return -sum(share / whole * log2(share / whole) for share in shares if share > 0) if whole else 0.0


class Outlook:
    """What the engine's explanations have ahead of them.

    Args:
        plans: the engine's plans.
        engine: the engine, as it stands.
    """

    def __init__(self, plans: Sequence[Plan], engine: Recogniser) -> None:
        self.plans, self.engine = plans, engine

    def next_actions(self) -> dict[str | None, float]:
        """The probability of each action to be the next one of a plan; None: all plans pursued are complete.

        Where a plan leaves open what comes next, its explanations' share is split evenly.
        """
        found: dict[str | None, float] = {}
        for parts, share in self.engine.ends():
            candidates: list[str | None] = [action for part in parts for action in self._next(*part)]
            for action in candidates or [None]:
                found[action] = found.get(action, 0.0) + share / max(len(candidates), 1)
        return _falling(found)

    def frontiers(self) -> dict[tuple[Compound, ...], float]:
        """The probability of each frontier: what is yet to be done, with what is known of the parameters."""
        found: dict[tuple[Compound, ...], float] = {}
        for parts, share in self.engine.ends():
            frontier = tuple(action for part in parts for action in self._frontier(*part))
            found[frontier] = found.get(frontier, 0.0) + share
        return _falling(found)

    def collaborative_plans(self, agent: str, capability: Capability) -> dict[CollaborativePlan, float]:
        """The probability that each is the agent's part (of several goals, the one where it can do most)."""
        known: dict[tuple[int, int, Binding], CollaborativePlan] = {}
        found: dict[CollaborativePlan, float] = {}
        for parts, share in self.engine.ends():
            for part in parts:
                if part not in known:
                    known[part] = collaborative_plan(agent, self._situation(*part), capability)
            best = max((known[part] for part in parts), key=lambda plan: len(plan.actions))
            found[best] = found.get(best, 0.0) + share
        return _falling(found)

    def questions(self) -> list[Question]:
        """What to find out, most telling first: about goals, steps done or still to come, and the next action."""
        goals: dict[str, float] = {}
        told: dict[tuple[Kind, str], dict[str, float]] = {}
        for parts, share in self.engine.ends():
            pursued = " + ".join(self.plans[part[0]].label for part in parts)
            goals[pursued] = goals.get(pursued, 0.0) + share
            coming = {a for part in parts for a in map(_shown, self._frontier(*part))}
            candidates = [action for part in parts for action in self._next(*part)]
            answers: dict[tuple[Kind, str], float] = {}
            answers.update((("step", action), share) for action in coming)
            answers.update((("done", action), share) for part in parts for action in self._done(*part))
            answers.update((("goal", self.plans[part[0]].label), share) for part in parts)
            for action in candidates:
                answers["next", action] = answers.get(("next", action), 0.0) + share / len(candidates)
            for question, mass in answers.items():
                by_goal = told.setdefault(question, {})
                by_goal[pursued] = by_goal.get(pursued, 0.0) + mass
        found = [_question(kind, about, yes, goals) for (kind, about), yes in told.items()]
        order = {"goal": 0, "done": 1, "step": 2, "next": 3}
        return sorted(found, key=lambda q: (-round(q.gain, 12), order[q.kind], q.about))

    def _next(self, plan: int, closed: int, binding: Binding) -> Iterator[str]:
        known = bindings_of(self.plans[plan], binding) if binding else {}
        for leaf in self.plans[plan].chart.next_leaves(closed):
            yield _shown(substitute(self.plans[plan].leaves[leaf], known))

    def _frontier(self, plan: int, closed: int, binding: Binding) -> tuple[Compound, ...]:
        return self._situation(plan, closed, binding).frontier

    def _done(self, plan: int, closed: int, binding: Binding) -> Iterator[str]:
        """What was observed, or missed and so done unseen; not what was passed over."""
        situation = self._situation(plan, closed, binding)
        for leaf in bits(closed & self.plans[plan].chart.mandatory):
            yield _shown(situation.leaves[leaf])

    def _situation(self, plan: int, closed: int, binding: Binding) -> Situation:
        return Situation(self.plans[plan], closed, binding)


def _question(
    kind: Kind, about: str, yes: dict[str, float], goals: dict[str, float]
) -> Question:
    whole, positive = sum(goals.values()), sum(yes.values())
    no = [max(share - yes.get(goal, 0.0), 0.0) for goal, share in goals.items()]
    left = positive * entropy(list(yes.values())) + sum(no) * entropy(no)
    gain = entropy(list(goals.values())) - left / whole if whole else 0.0
    return Question(kind, about, positive / whole if whole else 0.0, max(gain, 0.0))


def _shown(action: Compound) -> str:
    return term_text(as_term(action))


def _falling(shares: dict[Any, float]) -> dict[Any, float]:
    return dict(sorted(shares.items(), key=lambda item: -item[1]))
