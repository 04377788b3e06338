"""How instances go on from state to state: what begins, every way in which an observation is taken, what is left.

A state is a goal with what is known of its parameters, the row of its open items, and the conditions that are still
open; slots are numbered in the order in which they are met, so states that differ in names are equal. Ways that lead to
equal states are one step, with the fewest misses.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Hashable, Iterable, Iterator, Sequence
from typing import Any

from casper.engine.episodes.growing import Step
from casper.engine.episodes.networks.asking import Asking
from casper.engine.episodes.networks.growth import FREE, Growth
from casper.engine.episodes.networks.items.compiling import indicator
from casper.engine.episodes.networks.items.methods import Methods
from casper.engine.episodes.networks.items.numbering import numbered
from casper.engine.episodes.networks.items.terms import (
    CALL,
    COND,
    PAR,
    Env,
    Row,
    Slot,
    inward,
    key_of,
    outward,
    slot,
)
from casper.engine.episodes.networks.remembering import Asked, Failed
from casper.engine.episodes.networks.state import State
from casper.engine.episodes.networks.whole.derived import Done
from casper.engine.verification.observation import Observation, Seen, options_of
from casper.kb.errors import PlanError
from casper.kb.terms.clauses import Indicator
from casper.kb.terms.terms import Compound, Variable
from casper.kb.terms.unification import variables_of
from casper.plans.networks.tables import Tables

MOST_MISSED = 1  # leaves that may go unseen between two observations
MOST_KEPT = 50_000  # of anything that is remembered of states
MOST_GROWTHS = 64  # observations of which it is kept what tasks make of them


class Going:
    """Goal instances over a grammar, as they go on.

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
        self._derived: dict[tuple[State, tuple[Compound, ...]], Done | None] = {}  # for whoever tells of states

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
