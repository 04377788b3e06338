"""The counting kernel: Algorithm 1 without copying a tree, with all its extensions.

Marking a leaf closes every leaf that the plan puts before it; those unobserved are missed for good. So the
explanations of a plan are the ways to give the observations leaves that are open then, and all that the rest depends
on is a *state*: what is closed, which open parts were entered, how many leaves the plan has by now, how many
it missed, how many observations were needless, and what is known of the parameters. Per plan and observation a level
counts the explanations that end in each state:

    C_k[s'] = sum of C_{k-1}[s] over the states s from which observation k leads to s'

For a plan whose actions simply follow one another the closed leaves are those up to the last marked one j, and

    C_1[j] = [leaf j can be o_1]        C_k[j] = [leaf j can be o_k] * sum of C_{k-1}[i] over i < j

The score depends on the state only, so exact counts, posteriors, the best explanation, ties and a best-first stream
follow without enumerating any. ``docs/recognition.md`` says what every
extension means; `tree_copying` is the specification of the plain case, brute force that of the others (tests).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from casper.engine.recognition.kernels.kernel import Leading, Parts, Path, Plans
from casper.engine.recognition.kernels.levels import Level, Levels
from casper.engine.recognition.kernels.paths import best_first
from casper.engine.recognition.kernels.states import State, split, successors


class Counting(Levels):
    """What the counts of some plans say, whose shapes may be anything (arguments: `levels.Levels`)."""

    def alive(self, level: Level) -> set[int]:
        """The plans with an explanation; none may take all observations for needless."""
        return {p for p, states in level.counts.items() if any(_observes(level, state) for state in states)}

    def count(self, level: Level) -> int:
        """The sum of all counts."""
        return sum([level.counts[plan][state] for _, plan, state in self.groups(level)])

    def least(self, level: Level) -> int:
        """The fewest needless observations of an explanation."""
        if self.noise is None:
            return 0
        states = (state for counts in level.counts.values() for state in counts)
        return min((state[4] for state in states if _observes(level, state)), default=0)

    def groups(self, level: Level) -> list[tuple[float, int, State]]:
        """Where explanations end, best first: what the best of each weighs, plan and state."""
        if level.groups is None:
            least, weights, found = self.least(level), level.weights, list[tuple[float, int, State]]()
            for plan, counts in level.counts.items():
                for state in counts:
                    if _observes(level, state):
                        weight = self.score(state, level.k, state[4] - least)
                        weight = weight if weights is None else weight * weights[plan][state][1]
                        found.append((self.priors[plan] * weight, plan, state))
            level.groups = sorted(found, key=lambda group: (-group[0], group[1], group[2][0]))
        return level.groups

    def sums(self, level: Level, least: int = 0) -> list[float]:
        """Per plan the sum of the scores of its explanations, without the price of so many needless observations."""
        sums = [0.0] * len(self.plans)
        for plan in level.counts:
            sums[plan] = self._sum(level, plan, least)
        return sums

    def _sum(self, level: Level, plan: int, least: int) -> float:
        weights, price = level.weights, self.noise or 1.0
        exact: dict[tuple[int, int], float] = {}  # by (denominator, needless): exact integers, unless weighted
        for state, number in level.counts[plan].items():
            if _observes(level, state):
                _, _, size, missed, needless, _ = state
                above, below = self.measure(size, level.k - needless, missed)
                mass = number if weights is None else weights[plan][state][0]
                exact[below, needless] = exact.get((below, needless), 0) + mass * above
        return sum((total / below) * price ** (needless - least) for (below, needless), total in exact.items())

    def masses(self, level: Level) -> list[float]:
        """Per plan the sum of the weights of its explanations."""
        return [prior * total for prior, total in zip(self.priors, self.sums(level, self.least(level)))]

    def leading(self, level: Level) -> Leading | None:
        """The best explanation and its rivals."""
        weights = level.weights
        return self.leading_of([
            (weight, (plan,), state[3], level.counts[plan][state] if weights is None else weights[plan][state][2])
            for weight, plan, state in self.groups(level)
        ])  # fmt: skip

    def tops(self, level: Level) -> Iterator[tuple[float, Plans]]:
        """What the best explanation weighs that ends in each state."""
        return ((weight, (plan,)) for weight, plan, _ in self.groups(level))

    def ends(self, level: Level) -> Iterator[tuple[Parts, float]]:
        """By state, best first."""
        for weight, plan, state in self.groups(level):
            mass = weight * level.counts[plan][state]
            if level.weights is not None:
                total, largest, _ = level.weights[plan][state]
                mass = weight / largest * total if largest else 0.0
            yield ((plan, state[0], state[5]),), mass

    # --- single explanations ---------------------------------------------------------------------------------------

    def paths(self, level: Level, plans: Plans) -> Iterator[Path]:
        """The explanations of one plan, best first."""
        (plan,), least, levels = plans, self.least(level), list(_back(level))
        finals = {
            s: self.score(s, level.k, s[4] - least) for s in level.counts.get(plan, ()) if _observes(level, s)
        }  # fmt: skip
        before: dict[int, dict[State, list[tuple[State, int, float]]]] = {}

        def back(at: int, state: State) -> Iterable[tuple[State, int, float]]:
            if at not in before:
                before[at] = self._before(plan, levels[at])
            return before[at][state]

        for weight, marks, state in best_first(finals, back, level.k):
            likelihood = 1.0 if level.weights is None else weight / (finals[state] or 1.0)
            leaves, needless = split(marks)
            yield Path(((plan, leaves, state[5]),), needless, state[2], state[3], likelihood)

    def _before(self, plan: int, level: Level) -> dict[State, list[tuple[State, int, float]]]:
        """For every state of a level, what led to it."""
        found: dict[State, list[tuple[State, int, float]]] = {}
        assert level.before is not None
        for state in level.before.counts[plan]:
            moves = successors(self.charts[plan], state, level.edges[plan], self.noise is not None)
            for mark, following, likelihood in moves:
                found.setdefault(following, []).append((state, mark, likelihood))
        return found


def _observes(level: Level, state: State) -> bool:
    """Whether the state's explanations take anything for a leaf, or there was nothing to take."""
    return level.k > state[4] or not level.k


def _back(level: Level) -> list[Level]:
    """All levels up to this one, the first one first."""
    found = [level]
    while found[-1].before is not None:
        found.append(found[-1].before)
    return found[::-1]
