"""How the instances of goals go on whose plans are grown lazily (`engine.episodes.growing.Growing`).

    >>> networks = Networks(library.tables, goals, Asking(kb))
    >>> [step.state for step in networks.steps(networks.begin(0), Observation("drive", ("van", "home")), "ann")]

A state is a goal with what is known of its parameters, the row of its open items, and the conditions that are still
open; slots are numbered in the order in which they are met, so states that differ in names are equal. Ways that lead to
equal states are one step, with the fewest misses.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Hashable, Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from casper.engine.collaboration.collaboration import CollaborativePlan, longest_run
from casper.engine.episodes.growing import Step, Taken
from casper.engine.episodes.networks.asking import Asked, Asking, Failed
from casper.engine.episodes.networks.derivation import Done, derivation, drawn
from casper.engine.episodes.networks.frontier import Frontier, Leaf
from casper.engine.episodes.networks.growth import FREE, Growth
from casper.engine.episodes.networks.items.compiling import indicator
from casper.engine.episodes.networks.items.methods import Methods
from casper.engine.episodes.networks.items.terms import (
    CALL,
    COND,
    PAR,
    Env,
    Row,
    Slot,
    interned,
    inward,
    key_of,
    moved,
    numbered,
    outward,
    slot,
    slots_of,
)
from casper.engine.verification.matching import ROBOT
from casper.engine.verification.observation import Observation, Seen, options_of
from casper.kb.errors import PlanError
from casper.kb.terms.clauses import Indicator
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Variable, as_term
from casper.kb.terms.unification import is_ground, variables_of
from casper.plans.networks.tables import Tables
from casper.plans.trees.nodes import Action

if TYPE_CHECKING:
    import networkx as nx

MOST_MISSED = 1  # leaves that may go unseen between two observations
MOST_KEPT = 50_000  # of anything that is remembered of states
MOST_TOLD = 1_000  # derivations
MOST_GROWTHS = 64  # observations of which it is kept what tasks make of them


class State(NamedTuple):
    """A goal's number, its term, the row of its open items, the conditions that wait; and how many slots it has."""

    goal: int
    term: Any
    rest: Row
    open: tuple[Asked, ...]
    slots: int

    def __reduce__(self) -> tuple[Any, ...]:
        return _state, tuple(self)


def _state(goal: int, *parts: Any) -> State:
    """A state that came from another process."""
    return State(goal, *map(interned, parts))


class Networks:
    """Goal instances over a grammar.

    Args:
        tables: the grammar's.
        goals: label and term of each goal, in the author's order.
        asking: the knowledge base; without one conditions hold.
        partner: who acts where nobody is named.
        robot: who is meant by ``robot`` in ``by(robot, Action)``.
        by_name: whether only the names of actions count.
        most_missed: how many leaves may go unseen between two observations.
    """

    def __init__(
        self,
        tables: Tables,
        goals: Sequence[tuple[str, Compound]],
        asking: Asking | None = None,
        partner: str | None = None,
        robot: str | None = None,
        *,
        by_name: bool = False,
        most_missed: int = MOST_MISSED,
    ) -> None:
        self.tables, self.methods = tables, Methods(tables)
        self.asking = asking or Asking(None)
        self.partner, self.robot, self.by_name = partner, robot, by_name
        self.most_missed = most_missed
        self._goals = [(label, inward(term, {})) for label, term in goals]
        self.was_cut = False
        self._growths: dict[tuple[str, Any, str | None, int], Growth] = {}
        self._choices: dict[Hashable, tuple[tuple[Indicator, int], ...]] = {}  # by rest
        self._least: dict[Hashable, int] = {}
        self._derived: dict[tuple[State, tuple[Compound, ...]], Done | None] = {}

    # --- what there is ---------------------------------------------------------------------------------------------

    @property
    def goals(self) -> Sequence[str]:
        """The goals' labels, in the author's order."""
        return [label for label, _ in self._goals]

    @property
    def looks_back(self) -> bool:
        """Whether what is possible may depend on what was observed before."""
        return self.asking.looks_back

    def leaves(self) -> Sequence[Compound]:
        """The actions of the plans, each once, with variables where parameters stand."""
        found = self.tables.reached(tuple([indicator(term) for _, term in self._goals]))
        return [Compound((name, *(Variable(f"X{at + 1}") for at in range(arity)))) for name, arity in found]

    def begins_with(self, seen: Seen) -> Iterable[int]:
        """The goals that may take the observation first."""
        growths = [self._growth(option, None) for option, _ in options_of(seen)]
        for number, (_, term) in enumerate(self._goals):
            if any(growth.reach((CALL, term), self.most_missed) for growth in growths):
                yield number

    # --- states ----------------------------------------------------------------------------------------------------

    def begin(self, goal: int) -> State:
        """The state of a goal of which nothing was seen."""
        term = self._goals[goal][1]
        asks = self.asking.asks_goals
        due = (self.asking.due(("goal", term if len(term) > 1 else term[0])),) if asks else ()
        settled = self.asking.settled(due, {})
        env, still = ({}, due) if isinstance(settled, Failed) else settled  # a goal that nothing allows takes nothing
        names: dict[Slot, Slot] = {}
        term, rest, still = numbered((term, ((CALL, term),), still), env, names)
        return State(goal, term, rest, still, len(names))

    def steps(self, state: State, seen: Seen, agent: str | None) -> Sequence[Step[State]]:
        """Every way in which the instance can take the observation, each state once."""
        found: list[Step[State]] = []
        try:
            for option, likelihood in options_of(seen):
                ways: dict[State, Step[State]] = {}
                for step in self._option_steps(state, option, agent or self.partner):
                    if step.state not in ways or ways[step.state].missed > step.missed:
                        ways[step.state] = step
                found += self._shared_out(state, option, likelihood, ways.values())
        except RecursionError:
            label = self._goals[state.goal][0]
            raise PlanError(f"the plans of {label} are nested too deeply to be grown") from None
        return found

    def _shared_out(
        self, state: State, option: Observation, likelihood: float, ways: Collection[Step[State]]
    ) -> Iterator[Step[State]]:
        """The ways, each with its part of the chance of the leaves that `choices` counts for them."""
        counted = sum([count for (name, _), count in self._next(state) if name == option.action])
        alike = Counter([step.missed for step in ways])
        for step in ways:
            yield step._replace(weight=likelihood, part=min(1.0, max(1, counted) / alike[step.missed]))

    def _option_steps(
        self, state: State, option: Observation, agent: str | None, noted: list[str] | None = None
    ) -> Iterable[Step[State]]:
        growth = self._growth(option, agent, noted)
        growth.fresh = state.slots
        statement = Compound((option.action, agent or "", *(option.args or ())))
        doing = statement if option.t is None else (statement, option.t)
        for taken in growth.row(state.rest, {}, self.most_missed, FREE):
            due = (*state.open, *taken.due, *self._tail(taken.rest, taken.env))
            settled = self.asking.settled(due, taken.env, doing) if due else (taken.env, ())
            if isinstance(settled, Failed):
                if noted is not None:
                    noted.extend(settled.reasons)
                continue
            env, still = settled
            names: dict[Slot, Slot] = {}
            term, rest = numbered((state.term, taken.rest), env, names)
            needed = self.asking.needed(still, env, names)
            if isinstance(needed, Failed):
                if noted is not None:
                    noted.extend(needed.reasons)
                continue
            after = State(state.goal, term, rest, numbered(needed, env, names), len(names))
            if not self._can_close(after, growth):
                continue
            leaf = numbered(taken.leaf, env, names)
            yield Step(after, taken.missed, outward(leaf), 1.0, taken.is_theirs, taken.settled)
        self.was_cut = self.was_cut or growth.was_cut

    def _can_close(self, state: State, growth: Growth) -> bool:
        """Whether what is open may still be done."""
        known, key = self.asking.closing, key_of((state.rest, state.open))
        if key not in known:
            if len(known) > MOST_KEPT:
                known.clear()
            known[key] = growth.can_close(state.rest, {}, state.open)
        return known[key]

    def _growth(self, option: Observation, agent: str | None, noted: list[str] | None = None) -> Growth:
        """What is known of how tasks take an observation now."""
        key = option.action, option.args, agent, self.asking.now if self.looks_back else self.asking.changes
        growth = self._growths.get(key)
        if growth is None or noted is not None:
            args = None if self.by_name else option.args
            unknown: dict[Variable, Slot] = {}
            for variable in variables_of(*(args or ())):
                unknown[variable] = slot(-1 - len(unknown))
            action = (option.action, *(inward(arg, unknown) for arg in args or ()))
            arity = None if args is None else len(args)
            growth = Growth(self.methods, self.asking, action, arity, agent, self.robot, noted)
            if noted is None:
                if len(self._growths) >= MOST_GROWTHS:
                    del self._growths[next(iter(self._growths))]  # the oldest
                self._growths[key] = growth
        return growth

    def _tail(self, rest: Row, env: Env) -> list[Asked]:
        """The conditions with nothing to be done before or after them: they are due now."""
        if self.asking.kb is None:
            return []
        if all(item[0] is COND for item in rest):
            return [self.asking.due(item[1], 1) for item in rest]
        if len(rest) == 1 and rest[0][0] is PAR:
            _, items, before = rest[0]
            needed = 0
            for mask in before:
                needed |= mask
            free = [at for at in range(len(items)) if not before[at] and not needed >> at & 1]
            return [asked for at in free for asked in self._tail((items[at],), env)]
        return []

    def choices(self, state: State) -> int:
        """How many leaves could come next without a miss: open actions, and names that open tasks begin with."""
        return sum([count for _, count in self._next(state)])

    def _next(self, state: State) -> tuple[tuple[Indicator, int], ...]:
        """By name and arity how many leaves could come next: a name that open tasks begin with is one leaf."""
        key = key_of(state.rest)
        known = self._choices.get(key)
        if known is None:
            if len(self._choices) > MOST_KEPT:
                self._choices.clear()
            found: set[Any] = set()
            names: set[Indicator] = set()
            self.methods.add_first(state.rest, found, names)
            counted = Counter(map(indicator, found))
            counted.update(names.difference(counted))
            known = self._choices[key] = tuple(counted.items())
        return known

    def is_done(self, state: State) -> bool:
        """Whether nothing that is mandatory is left, as things are."""
        if not state.rest:
            return True
        if self.methods.least_of_row(state.rest):
            return False
        growth = self._growth(Observation("", ()), None)
        growth.fresh = state.slots
        passed = growth.passing_row(state.rest, {}, 0)
        return any(not isinstance(self.asking.settled((*state.open, *due), env), Failed) for env, _, due in passed)

    def least_left(self, state: State) -> int:
        """The fewest leaves that must still be done, by the grammar's table: conditions and parameters are left out."""
        key = key_of(state.rest)
        known = self._least.get(key)
        if known is None:
            if len(self._least) > MOST_KEPT:
                self._least.clear()
            known = self._least[key] = int(self.methods.least_of_row(state.rest))
        return known

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

    def __getstate__(self) -> dict[str, Any]:
        """What it was made of: what was worked out is worked out anew where it arrives."""
        return {**self.__dict__, "_growths": {}, "_choices": {}, "_least": {}, "_derived": {}, "methods": None}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self.methods = Methods(self.tables)

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


def _text(action: Compound) -> str:
    return term_text(as_term(action))
