"""How well recognisers do on made-up days: several actions on end, movements of random length, misread steps."""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TypeAlias

from casper.engine.actions.fsm import Fsm, movements_of
from casper.engine.actions.prediction import ActionRecogniser
from casper.engine.movements.movements import Movement

Script: TypeAlias = Sequence[tuple[str | None, Sequence[str]]]
"""Actions and the movements each is made of, in order; None is movement that belongs to no action."""


@dataclass(frozen=True, slots=True)
class Step:
    """One step of a made-up day: what was done, what the classifier saw, which action happened with it."""

    true: str
    seen: str
    finished: str | None = None


@dataclass(slots=True)
class Tally:
    """What became of the actions of some days.

    right: recognised after they had happened and before the next had; early: predicted before; missed: the
    actions that are not right; extra: predictions of what did not come, or twice. faultless: days with no fault.
    delays: steps from the first of the completing movement to the recognition.
    """

    actions: int = 0
    right: int = 0
    early: int = 0
    extra: int = 0
    days: int = 0
    faultless: int = 0
    delays: list[int] = field(default_factory=list)

    @property
    def missed(self) -> int:
        """Actions that were not recognised, or too early."""
        return self.actions - self.right


def completion(fsm: Fsm, movements: Sequence[str]) -> int:
    """The number, from 0, of the movement that completes the action's cycle; -1 when they do not."""
    progress = 0
    for number, name in enumerate(movements):
        progress += name == fsm.cycle[progress]
        if progress == len(fsm.cycle):
            return number
    return -1


def simulate(
    script: Script,
    fsms: Sequence[Fsm],
    error: float,
    source: random.Random,
    *,
    lasts: tuple[int, int] = (3, 7),
    burst: int = 1,
) -> list[Step]:
    """A day of this script, a step at a time.

    error: the probability that a step begins ``burst`` misread ones. lasts: bounds of a movement's steps.
    """
    by_name = {fsm.action: fsm for fsm in fsms}
    steps: list[Step] = []
    for action, movements in script:
        last = -1 if action is None else completion(by_name[action], movements)
        for number, name in enumerate(movements):
            steps.append(Step(name, name, action if number == last else None))
            steps += [Step(name, name)] * (source.randint(*lasts) - 1)
    return _misread(steps, movements_of(tuple(fsms)), error, source, burst)


def _misread(steps: list[Step], names: Sequence[str], error: float, source: random.Random, burst: int) -> list[Step]:
    wrong, left, read = "", 0, []
    for step in steps:
        if left == 0 and source.random() < error:
            wrong, left = source.choice([name for name in names if name != step.true]), burst
        read.append(replace(step, seen=wrong) if left > 0 else step)
        left = max(left - 1, 0)
    return read


def judge(recogniser: ActionRecogniser, steps: Sequence[Step], ignored: frozenset[str]) -> Tally:
    """One day through the recogniser, everything it says accepted.

    ignored: actions that may be recognised without having been done.
    """
    recogniser.reset()
    tally = Tally(days=1)
    coming = [step.finished for step in steps if step.finished is not None]
    tally.actions, due, since = len(coming), None, 0
    for t, step in enumerate(steps):
        if step.finished is not None:
            due, since = coming.pop(0), t
        prediction = recogniser.update(Movement(float(t), step.seen))
        if prediction is None:
            continue
        recogniser.accept()
        if prediction.action == due:
            tally.right += 1
            tally.delays.append(t - since)
            due = None
        elif prediction.action not in ignored:
            early = bool(coming) and coming[0] == prediction.action
            tally.early, tally.extra = tally.early + early, tally.extra + (not early)
    tally.faultless = int(tally.right == tally.actions and not tally.early and not tally.extra)
    return tally


def compare_recognisers(
    recognisers: Mapping[str, ActionRecogniser],
    scripts: Sequence[Script],
    fsms: Sequence[Fsm],
    *,
    error: float,
    days: int,
    seed: int = 0,
    lasts: tuple[int, int] = (3, 7),
    burst: int = 1,
    ignored: frozenset[str] = frozenset(),
) -> dict[str, Tally]:
    """The same ``days`` made-up days of each script through every recogniser, one second a step."""
    totals = {name: Tally() for name in recognisers}
    source = random.Random(seed)
    for script in scripts:
        for _ in range(days):
            steps = simulate(script, fsms, error, source, lasts=lasts, burst=burst)
            for name, recogniser in recognisers.items():
                _add(totals[name], judge(recogniser, steps, ignored))
    return totals


def _add(total: Tally, day: Tally) -> None:
    total.actions, total.right = total.actions + day.actions, total.right + day.right
    total.early, total.extra = total.early + day.early, total.extra + day.extra
    total.days, total.faultless = total.days + day.days, total.faultless + day.faultless
    total.delays += day.delays
