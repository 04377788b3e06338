"""The hidden states of the action HMM and where one step leads from each.

A state is one movement of one action together with how much of the action's cycle has been made, or a movement of
no action (idle), or a movement of an action that has been accepted and may go round again. When a movement
changes, the FSM says to what; how long it lasts is the recogniser's business, since that depends on the time
between two steps.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from math import fsum
from typing import NamedTuple, TypeAlias

from casper.engine.actions.fsm import Fsm, movements_of
from casper.engine.actions.prediction import ActionSettings


class State(NamedTuple):
    """action is None when idle; progress: how much of the cycle was made, -1 behind an accepted loop."""

    action: str | None
    movement: str
    progress: int


Steps: TypeAlias = Iterator[tuple[State, float]]
"""Where one leads, with probabilities; a state may come more than once."""
Arcs: TypeAlias = tuple[tuple[int, float], ...]
"""The same by numbers, each once."""
Afresh: TypeAlias = tuple[str, str | None]
"""What something new may follow: a movement, and the accepted loop that cannot begin anew."""


class Change(NamedTuple):
    """What a change of movement leads to: along ``own`` arcs, and with the probability ``new`` to something new."""

    own: Arcs
    new: float
    afresh: Afresh


class HmmModel:
    """States by number; ``arcs[i]`` lists where a change of movement leads from state i, with its probability.

    ``changes[i]`` says the same without what many states have in common, which ``afresh`` lists once.
    What was done of ``keeps`` stays done until it is accepted, whatever follows: so that what was seen of it is not
    forgotten where no single step is sure.
    """

    def __init__(self, settings: ActionSettings, fsms: tuple[Fsm, ...], keeps: frozenset[str] = frozenset()) -> None:
        self._settings, self._fsms, self._keeps = settings, fsms, keeps
        self._movements = movements_of(fsms)
        self._index: dict[State, int] = {}
        self.states: list[State] = []
        self.initial = dict(self._numbered(self._fresh(None)))
        for fsm in fsms:
            for movement in self._movements:
                self.after(fsm, movement)
                self.after(None, movement)
        self.arcs: list[Arcs] = []
        self.changes: list[Change] = []
        self.afresh: dict[Afresh, Arcs] = {}
        while len(self.arcs) < len(self.states):  # numbering the arcs' ends may add states
            self._add_arcs(self.states[len(self.arcs)])
        lengths = {fsm.action: len(fsm.cycle) for fsm in fsms}
        self.complete = [s.action if s.progress == lengths.get(s.action or "") else None for s in self.states]

    def after(self, fsm: Fsm | None, movement: str) -> int:
        """The state behind an accepted action while this movement is going on."""
        if fsm is not None and fsm.loop and movement in fsm.cycle:
            return self._number(State(fsm.action, movement, -1))
        return self._number(State(None, movement, 0))

    def number(self, state: State) -> int | None:
        """The number of a state, of another model perhaps; None where it has none here."""
        return self._index.get(state)

    def _number(self, state: State) -> int:
        if state not in self._index:
            self._index[state] = len(self.states)
            self.states.append(state)
        return self._index[state]

    def _numbered(self, steps: Iterable[tuple[State, float]]) -> Arcs:
        arcs: dict[int, float] = {}
        for state, p in steps:
            if p > 0.0:
                arcs[self._number(state)] = arcs.get(self._number(state), 0.0) + p
        return tuple(arcs.items())

    def _add_arcs(self, state: State) -> None:
        onwards, share, barred = self._leads(state)
        own, new = list(onwards), list(self._fresh(state.movement, barred))
        self.arcs.append(self._numbered(_mixed(own, share, new)))
        afresh = state.movement, None if barred is None else barred.action
        self.changes.append(Change(self._numbered(_mixed(own, share, ())), 1.0 - share, afresh))
        if share < 1.0:
            self.afresh.setdefault(afresh, self._numbered(new))

    def _leads(self, state: State) -> tuple[Steps, float, Fsm | None]:
        """Where a change of movement leads, the share of that, and what cannot be the new that may follow else."""
        if state.action is None:
            return iter(()), 0.0, None
        fsm = next(f for f in self._fsms if f.action == state.action)
        if state.action in self._keeps and state.progress == len(fsm.cycle):
            return _mixed(self._onwards(fsm, state), 0.5 * fsm.loop, self._whatever(state)), 1.0, None
        if state.progress < 0:
            return self._again(fsm, state.movement), self._settings.again, fsm
        return self._onwards(fsm, state), 1.0 - self._settings.abandon, None

    def _fresh(self, movement: str | None, barred: Fsm | None = None) -> Steps:
        """Something new begins: an action at one of its first movements, or nothing in particular.

        ``barred`` is a loop that was just accepted: it cannot begin anew before something else happened.
        """
        others = [m for m in self._movements if m != movement]
        fsms = [fsm for fsm in self._fsms if fsm is not barred and _begins(fsm, others)]
        idle = self._settings.idle if fsms else 1.0
        for m in others:
            yield State(None, m, 0), idle / len(others)
        for fsm in fsms:
            start = _begins(fsm, others)
            for m, p in start.items():
                share = (1.0 - idle) / len(fsms) * p / fsum(start.values())
                yield State(fsm.action, m, _advance(fsm, 0, m)), share

    def _onwards(self, fsm: Fsm, state: State) -> Steps:
        row = {m: p for m, p in fsm.rows[state.movement].items() if m != state.movement}  # lasting is `stay`
        total = fsum(row.values())
        done = state.progress == len(fsm.cycle)
        for m, p in row.items():
            # whatever follows a completed action that does not loop belongs to the next time
            made = 0 if done else state.progress
            progress = state.progress if done and fsm.loop else _advance(fsm, made, m)
            yield State(fsm.action, m, progress), p / total

    def _whatever(self, state: State) -> Steps:
        """Any other movement."""
        others = [m for m in self._movements if m != state.movement]
        for m in others:
            yield state._replace(movement=m), 1.0 / len(others)

    def _again(self, fsm: Fsm, movement: str) -> Steps:
        """An accepted loop goes round: only the movements of its cycle, so that a new action soon shows."""
        row = {m: p for m, p in fsm.rows.get(movement, {}).items() if m in fsm.cycle and m != movement}
        total = fsum(row.values())
        if total == 0.0:
            yield from self._fresh(movement)
        for m, p in row.items():
            yield State(fsm.action, m, -1), p / total


def _advance(fsm: Fsm, progress: int, movement: str) -> int:
    return progress + 1 if progress < len(fsm.cycle) and fsm.cycle[progress] == movement else progress


def _begins(fsm: Fsm, movements: Sequence[str]) -> dict[str, float]:
    """With which of these movements the action may begin, and how likely (up to a factor)."""
    if fsm.start is None:
        return dict.fromkeys(movements, 1.0)
    return {m: fsm.start[m] for m in movements if fsm.start.get(m, 0.0) > 0.0}


def _mixed(main: Iterable[tuple[State, float]], share: float, rest: Iterable[tuple[State, float]]) -> Steps:
    """``share`` of the first, what is left of the second."""
    for to, p in main:
        yield to, p * share
    for to, p in rest:
        yield to, p * (1.0 - share)
