"""Goal instances whose plans are grown lazily, as days and readings use them (`engine.episodes.growing.Growing`).

    >>> networks = Networks(library.tables, goals, Asking(kb))
    >>> [step.state for step in networks.steps(networks.begin(0), Observation("drive", ("van", "home")), "ann")]

How they go on is `going`; here is what is told of their states, and what they know of the past.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from casper.engine.collaboration.collaboration import CollaborativePlan, longest_run
from casper.engine.episodes.growing import Taken
from casper.engine.episodes.networks.going import Going
from casper.engine.episodes.networks.items.compiling import indicator
from casper.engine.episodes.networks.items.methods import Methods
from casper.engine.episodes.networks.items.terms import Slot, inward, moved, outward, slots_of
from casper.engine.episodes.networks.state import State
from casper.engine.episodes.networks.whole.derivation import derivation
from casper.engine.episodes.networks.whole.derived import Done, drawn
from casper.engine.episodes.networks.whole.frontier import Frontier, Leaf
from casper.engine.verification.matching import ROBOT
from casper.engine.verification.observation import Seen, options_of
from casper.kb.terms.clauses import Indicator
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Variable, as_term
from casper.kb.terms.unification import is_ground
from casper.plans.trees.nodes import Action

if TYPE_CHECKING:
    import networkx as nx

MOST_TOLD = 1_000  # derivations


class Networks(Going):
    """Goal instances over a grammar, with what is told of them; how it is made is `Going`'s."""

    # --- what is told ----------------------------------------------------------------------------------------------

    def goal_of(self, state: State) -> Compound:
        """The goal with its parameters as far as they are known."""
        goal: Compound = outward(state.term)
        return goal

    def coming(self, state: State) -> Sequence[Leaf]:
        """A smallest rest: leaves with who does each, and the masks of what comes before."""
        return Frontier(self.methods, self.asking, state.rest, state.open).leaves

    def rest(self, state: State) -> Sequence[Compound]:
        """A smallest rest in an order that the plan allows, bound as far as is known."""
        return [outward(leaf.action) for leaf in self.coming(state)]

    def leaves_left(self, state: State) -> Sequence[Action]:
        """As `rest`, with who does each leaf."""
        coming = self.coming(state)
        return [Action(outward(leaf.action), by=None if leaf.by is None else outward(leaf.by)) for leaf in coming]

    def next_leaves(self, state: State) -> Sequence[Compound]:
        """What could come next without a miss; of what a task may begin with the name, with open arguments."""
        found: set[Any] = set()
        names: set[Indicator] = set()
        self.methods.add_first(state.rest, found, names)
        others = names - {indicator(action) for action in found}
        general = [Compound((name, *(Variable("_#1") for _ in range(arity)))) for name, arity in sorted(others)]
        return [*sorted(map(outward, found), key=_text), *general]

    def part(self, state: State, agent: str) -> CollaborativePlan | None:
        """What the agent can do of the rest, and what it waits for; None where nothing is left.

        A leaf counts as possible when the knowledge base lets the agent do it as things are: what comes before it is
        not yet done, so where rules look at did/2 it is asked again when its turn comes.
        """
        coming = self.coming(state)
        if not coming:
            return None
        label, before = self._goals[state.goal][0], [leaf.before for leaf in coming]
        able = [at for at, leaf in enumerate(coming) if self._may(leaf, agent)]
        run = longest_run(able, [at for at in range(len(coming)) if at not in able], before)
        needed = -1 if not run else 0
        for at in run:
            needed |= before[at]
        awaited = tuple(at for at in range(len(coming)) if needed >> at & 1 and at not in run)
        actions = [outward(leaf.action) for leaf in coming]
        waiting, theirs = tuple(actions[at] for at in awaited), tuple(actions[at] for at in run)
        return CollaborativePlan(agent, label, waiting, theirs, run, awaited)

    def _may(self, leaf: Leaf, agent: str) -> bool:
        """Whether a leaf is the agent's to do, and the knowledge base knows that it can; without one nobody can."""
        who = self.robot if leaf.by == ROBOT and self.robot is not None else leaf.by
        others = who is not None and who.__class__ is not Slot and who != agent
        return not others and self.asking.may(leaf.action, agent)

    def tree(self, goal: int, history: Sequence[Taken[State]]) -> nx.DiGraph:
        """The goal with its tasks, the leaves that were observed and a smallest rest (attributes: `plans.trees.tree`).

        Which tasks lie between is found again (`derivation`); where that takes too long, or leaves were missed, none
        are shown. Missed leaves have no node.
        """
        state = history[-1].step.state if history else self.begin(goal)
        rows = [(taken.step.leaf, "observed", taken.agent if taken.step.is_theirs else None) for taken in history]
        rows += [(outward(leaf.action), "unobserved", leaf.by and outward(leaf.by)) for leaf in self.coming(state)]
        told = None
        if not any(taken.step.missed for taken in history):
            told = self.derived(state, [taken.step.leaf for taken in history])
        return drawn(told or Done(state.term, tuple(range(len(rows)))), rows)

    def derived(self, state: State, done: Sequence[Compound]) -> Done | None:
        """The tasks of a goal that these leaves brought to the state, and of a smallest rest; None: none were found."""
        key = state, tuple(done)
        if key not in self._derived:
            if len(self._derived) > MOST_TOLD:
                self._derived.clear()
            self._derived[key] = self._derive(*key)
        return self._derived[key]

    def _derive(self, state: State, done: Sequence[Compound]) -> Done | None:
        rest = [leaf.action for leaf in self.coming(state)]
        first = 1 + max(map(int, slots_of((state.term, tuple(rest)), {})), default=-1)
        free: dict[Variable, Slot] = {}
        seen = [moved(inward(leaf, free), first) for leaf in done]
        return derivation(self.methods, self.asking, state.term, [*seen, *rest])

    def reasons(self, state: State, seen: Seen, agent: str | None) -> Sequence[str]:
        """Why the instance cannot take the observation."""
        label, noted = self._goals[state.goal][0], list[str]()
        names = [option.action for option, _ in options_of(seen)]
        task = self._goals[state.goal][1]
        mask = self.tables.contained[task[0], len(task) - 1]
        known = {action[0] for action, bit in self.tables.bit.items() if mask & bit}
        if not known.intersection(names):
            return (f"{label} has no {' or '.join(names)}",)
        for option, _ in options_of(seen):
            for _ in self._option_steps(state, option, agent or self.partner, noted):
                pass
        return tuple(dict.fromkeys(noted)) or (f"no {' or '.join(names)} is left in {label} after what was observed",)

    # --- the past --------------------------------------------------------------------------------------------------

    def observed(self, seen: Seen, agent: str | None, t: float | None) -> None:
        """Told once an observation is settled: what is possible later may depend on it."""
        options = options_of(seen)
        option = options[0][0]
        certain = len(options) == 1 and options[0][1] == 1.0
        args = option.args if certain else None
        who = agent or self.partner
        known = who is not None and args is not None and all(map(is_ground, args))
        self.asking.observed(Compound((option.action, who, *args)) if known and args is not None else None, t)
        self._forget()

    def forget(self) -> None:
        """Told when the last observation is taken back."""
        self.asking.forget()
        self._forget()

    def _forget(self) -> None:
        if self.looks_back:
            self._growths = {}

    def fork(self) -> Networks:
        """One with the same past that goes its own way; what was worked out is shared as far as it holds for both."""
        other = object.__new__(Networks)
        other.__dict__.update(self.__dict__)
        if self.looks_back:
            other.asking = self.asking.forked()
            other._growths = {}
        return other

    def __getstate__(self) -> dict[str, Any]:
        """What it was made of: what was worked out is worked out anew where it arrives."""
        return {**self.__dict__, "_growths": {}, "_choices": {}, "_least": {}, "_derived": {}, "methods": None}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self.methods = Methods(self.tables)


def _text(action: Compound) -> str:
    return term_text(as_term(action))
