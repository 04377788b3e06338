"""How well recognisers do on made-up days: several actions on end, movements of random length, wrong movements."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from casper.engine.actions import ActionRecogniser
from casper.engine.movements import Movement

Script = Sequence[tuple[str | None, Sequence[str]]]
"""Actions and the movements each is made of, in order; None is movement that belongs to no action."""


@dataclass(frozen=True, slots=True)
class Step:
    """One step of a made-up day: what was done, what the classifier saw, which action was finished by it."""

    true: str
    seen: str
    finished: str | None = None


@dataclass(slots=True)
class Tally:
    """What became of the actions of some days.

    right: recognised, when they had happened and before the next did; early: before the last movement of their
    cycle; missed; extra: predictions of what did not happen, or twice. faultless: days without any fault.
    delays: steps from the first of the last movement to the recognition.
    """

    actions: int = 0
    right: int = 0
    early: int = 0
    missed: int = 0
    extra: int = 0
    days: int = 0
    faultless: int = 0
    delays: list[int] = field(default_factory=list)


def simulate(
    script: Script,
    error: float,
    source: random.Random,
    *,
    completes: Callable[[str, Sequence[str]], int],
    lasts: tuple[int, int] = (3, 7),
    burst: int = 1,
) -> list[Step]:
    """A day of this script, a step at a time.

    error: probability that a step starts ``burst`` wrongly classified steps. completes: the number of the
    movement, from 0, that makes this action have happened. lasts: bounds of a movement's steps.
    """
    names = sorted({name for _, movements in script for name in movements})
    steps: list[Step] = []
    for action, movements in script:
        last = completes(action, movements) if action is not None else -1
        for number, name in enumerate(movements):
            for k in range(source.randint(*lasts)):
                steps.append(Step(name, name, action if number == last and k == 0 else None))
    wrong, left = "", 0
    for i, step in enumerate(steps):
        if left == 0 and source.random() < error:
            wrong, left = source.choice([name for name in names if name != step.true]), burst
        if left > 0:
            steps[i], left = Step(step.true, wrong, step.finished), left - 1
    return steps


def judge(recogniser: ActionRecogniser, steps: Sequence[Step], ignored: frozenset[str], tally: Tally) -> None:
    """Run a day through the recogniser, accept whatever it says, and add what came out to the tally.

    ignored: actions that may be recognised or not.
    """
    recogniser.reset()
    due: list[tuple[str, int]] = []
    coming = [(step.finished, t) for t, step in enumerate(steps) if step.finished is not None]
    before = tally.right
    early = extra = 0
    for t, step in enumerate(steps):
        if step.finished is not None:
            due.append((coming.pop(0)[0], t))
        prediction = recogniser.update(Movement(float(t), step.seen))
        if prediction is None:
            continue
        recogniser.accept()
        if due and due[-1][0] == prediction.action:
            tally.right += 1
            tally.delays.append(t - due.pop()[1])
        elif prediction.action not in ignored:
            early += bool(coming) and coming[0][0] == prediction.action
            extra += not (bool(coming) and coming[0][0] == prediction.action)
    actions = sum(step.finished is not None for step in steps)
    tally.actions += actions
    tally.early += early
    tally.extra += extra
    tally.missed += actions - (tally.right - before)
    tally.days += 1
    tally.faultless += tally.right - before == actions and not early and not extra


def compare_recognisers(
    recognisers: dict[str, ActionRecogniser],
    scripts: Sequence[Script],
    *,
    completes: Callable[[str, Sequence[str]], int],
    error: float,
    days: int,
    seed: int = 0,
    lasts: tuple[int, int] = (3, 7),
    burst: int = 1,
    ignored: frozenset[str] = frozenset(),
) -> dict[str, Tally]:
    """The same ``days`` made-up days of each script through every recogniser."""
    tallies = {name: Tally() for name in recognisers}
    source = random.Random(seed)
    for script in scripts:
        for _ in range(days):
            steps = simulate(script, error, source, completes=completes, lasts=lasts, burst=burst)
            for name, recogniser in recognisers.items():
                judge(recogniser, steps, ignored, tallies[name])
    return tallies
