"""What lazily grown states say of a row of observations: counts, shares, explanations best first (one goal at a time).

An explanation is a way through the states, one for each observation. It is scored as those of listed plans are: a plan
has as many leaves as were observed and missed, and as few as are left by the grammar's table. So the paper's score
prefers what is short for the much that speaks for it. Ways that lead to equal states in one step are one.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from heapq import nlargest
from typing import Any, NamedTuple, TypeAlias

from casper.engine.episodes.networks.networks import Networks
from casper.engine.episodes.networks.state import State
from casper.engine.episodes.networks.whole.derived import as_task
from casper.engine.explanation.explanation import Explanation
from casper.engine.recognition.kernels.paths import best_first
from casper.engine.recognition.options import Options
from casper.engine.recognition.scoring import least_tie, posterior_by
from casper.engine.recognition.standing import Standing
from casper.engine.verification.observation import Observation, Seen
from casper.kb.terms.terms import Compound
from casper.plans.trees.nodes import Action, Task
from casper.plans.trees.plan import Plan

MOST_KEPT = 500  # states after an observation
UNSEEN = Compound(("something unseen",))
End: TypeAlias = tuple[State, int, int]  # with missed leaves, and needless observations


class Back(NamedTuple):
    """What led to a state: the end before, the leaf (None: a needless observation), its misses and its likelihood."""

    before: End
    leaf: Compound | None
    missed: int
    weight: float


@dataclass
class Level:
    """The ends after some observations: how many ways lead to each, the sum and the largest of their likelihoods."""

    ends: dict[End, tuple[int, float, float]]
    back: dict[End, list[Back]] = field(default_factory=dict)
    exact: bool = True


class GrownTeller:
    """Counts explanations of a growing row of observations. Levels count from 0, before the first one."""

    def __init__(self, networks: Networks, options: Options, partner: str | None) -> None:
        self.networks, self.options, self.partner = networks, options, partner
        self.observations: list[Seen] = []
        self.pasts: list[Networks] = []  # before each observation
        begun = [networks.begin(goal) for goal in range(len(networks.goals))]
        self.levels = [Level({(state, 0, 0): (1, 1.0, 1.0) for state in begun})]
        self.priors = [1.0 if options.priors is None else options.priors[label] for label in networks.goals]

    # --- observing -------------------------------------------------------------------------------------------------

    def observe(self, seen: Seen) -> None:
        """Take in an observation; where nothing comes of it because something raised, nothing was taken in."""
        before = self.levels[-1]
        after = Level({}, exact=before.exact)
        self.networks.was_cut = False
        for end, (count, total, largest) in before.ends.items():
            for to, back in self._onward(end, seen):
                known = after.ends.get(to, (0, 0.0, 0.0))
                weights = known[1] + total * back.weight, max(known[2], largest * back.weight)
                after.ends[to] = (known[0] + count, *weights)
                after.back.setdefault(to, []).append(back)
        after.exact = after.exact and not self.networks.was_cut
        self.observations.append(seen)
        self.levels.append(after)
        self._prune(after)
        self.pasts.append(self.networks)
        self.networks = self.networks.fork()
        self.networks.observed(seen, self.partner, seen.t if isinstance(seen, Observation) else None)

    def _onward(self, end: End, seen: Seen) -> Iterator[tuple[End, Back]]:
        state, missed, needless = end
        if self.options.noise is not None:
            yield (state, missed, needless + 1), Back(end, None, 0, 1.0)
        for step in self.networks.steps(state, seen, self.partner):
            yield (step.state, missed + step.missed, needless), Back(end, step.leaf, step.missed, step.weight)

    def _prune(self, level: Level) -> None:
        most = self.options.budget or MOST_KEPT
        if len(level.ends) > most:
            kept = nlargest(most, level.ends, key=lambda end: (-end[1] - end[2], self.weight(end) * level.ends[end][2]))
            level.ends = {end: level.ends[end] for end in kept}
            level.exact = False

    def undo(self) -> None:
        """Take back the last observation."""
        self.observations.pop()
        self.levels.pop()
        self.networks = self.pasts.pop()

    def fork(self) -> GrownTeller:
        """A copy that goes its own way; what was counted so far is shared."""
        other = object.__new__(GrownTeller)
        other.__dict__.update(self.__dict__)
        other.observations, other.levels, other.pasts = [*self.observations], [*self.levels], [*self.pasts]
        other.networks = self.networks.fork()
        return other

    # --- what it says ----------------------------------------------------------------------------------------------

    def score(self, end: End) -> float:
        """The score of what ends there; 0 where everything was needless."""
        state, missed, needless = end
        observed = len(self.observations) - needless
        if observed <= 0:
            return 0.0
        above, below = self.options.measure(observed + missed + self.networks.least_left(state), observed, missed)
        return (self.options.noise or 1.0) ** needless * above / below

    def weight(self, end: End) -> float:
        """Score times prior."""
        return self.score(end) * self.priors[end[0].goal]

    @property
    def explained(self) -> Mapping[End, tuple[int, float, float]]:
        """The ends of explanations: something was observed."""
        seen = len(self.observations)
        return {end: ways for end, ways in self.levels[-1].ends.items() if end[2] < seen}

    @property
    def is_exact(self) -> bool:
        """Whether every explanation was counted that has no more misses in a row than are allowed."""
        return self.levels[-1].exact

    @property
    def count(self) -> int:
        """The number of explanations; before the first observation, of goals."""
        return sum(ways[0] for ways in self.explained.values()) if self.observations else len(self.networks.goals)

    def alive(self, level: int) -> set[int]:
        """The goals that explain the first so many observations."""
        return {end[0].goal for end in self.levels[level].ends if level == 0 or end[2] < level}

    def posterior(self) -> Mapping[str, float]:
        """Each goal's share of all weights."""
        sums = [0.0] * len(self.networks.goals)
        for end, (_, total, _) in self.explained.items():
            sums[end[0].goal] += self.weight(end) * total
        return posterior_by(self.networks.goals, sums, sum(sums))

    def standing(self) -> Standing | None:
        """The best explanation and its rivals; None when there is none."""
        tops = [(self.weight(end) * ways[2], end, ways[0]) for end, ways in self.explained.items()]
        if not tops:
            return None
        least = least_tie(max(top[0] for top in tops))
        equal = [top for top in tops if top[0] >= least]
        goal = min(end[0].goal for _, end, _ in equal)
        ours = [(end, count) for _, end, count in equal if end[0].goal == goal]
        ties, same = sum(count for _, _, count in equal), sum(count for _, count in ours)
        missed = min(end[1] for end, _ in ours)
        return Standing(self.count, self.networks.goals[goal], missed, ties - same, ties)

    def ends(self) -> Iterator[tuple[State, float]]:
        """Where explanations end, and their share."""
        masses = {end: self.weight(end) * total for end, (_, total, _) in self.explained.items()}
        whole = sum(masses.values())
        for end, mass in sorted(masses.items(), key=lambda pair: -pair[1]):
            yield end[0], mass / whole if whole else 0.0

    def first(self, goal: str | None = None) -> Explanation | None:
        """The best explanation, of all or of a goal; None for none."""
        return next(self.explanations(goal), None)

    def explanations(self, goal: str | None = None) -> Iterator[Explanation]:
        """Every explanation, best first, lazily."""
        labels = self.networks.goals
        finals = {end: self.weight(end) for end in self.explained if goal in (None, labels[end[0].goal])}
        whole = sum(self.weight(end) * total for end, (_, total, _) in self.explained.items())
        for weight, marks, end in best_first(finals, self._back, len(self.observations)):
            backs = self._path(marks, end)
            likelihood = weight / finals[end] if finals[end] else 0.0
            yield self._told(backs, end, self.score(end) * likelihood, weight / whole if whole else 0.0)

    def _back(self, level: int, end: End) -> Iterator[tuple[End, int, float]]:
        before = self.levels[level - 1].ends
        for number, back in enumerate(self.levels[level].back.get(end, ())):
            if back.before in before:
                yield back.before, number, back.weight

    def _path(self, marks: Sequence[Any], end: End) -> list[Back]:
        found: list[Back] = []
        for level in range(len(marks), 0, -1):
            back = self.levels[level].back[end][marks[level - 1]]
            found.append(back)
            end = back.before
        return found[::-1]

    def _told(self, backs: Sequence[Back], end: End, score: float, share: float) -> Explanation:
        """The explanation as of a plain plan: what was observed, what was missed and nobody knows, a smallest rest.

        Its tasks are found again (`derivation`) where nothing was missed, and it was done in the order of the plan.
        """
        actions: list[Action] = []
        marks: list[int] = []
        for back in backs:
            if back.leaf is not None:
                actions += [Action(UNSEEN)] * back.missed
                marks.append(len(actions))
                actions.append(Action(back.leaf))
        for leaf in self.networks.leaves_left(end[0]):
            actions.append(leaf)
        label = self.networks.goals[end[0].goal]
        root = Task(self.networks.goal_of(end[0]), tuple(actions))
        if not end[1]:
            found = self.networks.derived(end[0], [back.leaf for back in backs if back.leaf is not None])
            root = (found and as_task(found, actions)) or root
        plan = Plan(label, root)
        needless = tuple(at for at, back in enumerate(backs) if back.leaf is None)
        return Explanation(plan, tuple(marks), (None,) * len(plan.variables), score, share, needless)
