"""Actions as Markov chains over movements (paper, section Action Prediction, figure fsm)."""

from __future__ import annotations

import random
from collections.abc import Mapping
from dataclasses import dataclass
from math import fsum

from casper.engine.settings import Rows, number, require

_ROUNDING = 0.02  # the paper's rows add up to .999


@dataclass(frozen=True, slots=True)
class Fsm:
    """One action's chain: ``rows[movement][next]`` is a probability above 0; the order is the facts'.

    cycle: the movements that must have been made, in this order, for the action to have happened; the last
    one completes it. start: how likely it begins with each movement. loop: going round again is the same
    action.
    """

    action: str
    rows: Mapping[str, Mapping[str, float]]
    cycle: tuple[str, ...] = ()
    start: Mapping[str, float] | None = None
    loop: bool = False


def read_fsms(rows: Rows) -> tuple[Fsm, ...]:
    """The ensemble, from facts ``transition(Action, From, To, P)``, in the order of the actions' first facts.

    Optional: ``cycle(Action, N, Movement)``, ``start(Action, Movement, P)``, ``loop(Action)``.

    Raises:
        DomainError: a probability outside 0…1, a row that does not add up to 1, a movement nothing leads
        from,
            or facts about an action without transitions.
    """
    tables: dict[str, dict[str, dict[str, float]]] = {}
    for action, origin, to, p in rows("transition", 4):
        chance = _probability(p, f"transition({action}, {origin}, {to}, {p})")
        row = tables.setdefault(action, {}).setdefault(origin, {})
        require(to not in row, f"transition({action}, {origin}, {to}, …) is there twice")
        if chance > 0.0:
            row[to] = chance
    for action, table in tables.items():
        _check_table(action, table)
    cycles, starts = _cycles(rows, tables), _starts(rows, tables)
    loops = {action for (action,) in rows("loop", 1)}
    return tuple(
        Fsm(action, table, cycles.get(action, ()), starts.get(action), action in loops)
        for action, table in tables.items()
    )


def movements_of(fsms: tuple[Fsm, ...]) -> tuple[str, ...]:
    """Every movement the chains know, in the order of the facts."""
    return tuple(dict.fromkeys(name for fsm in fsms for name in fsm.rows))


def likeliest_chain(fsm: Fsm, first: str, length: int) -> tuple[str, ...]:
    """``length`` movements from ``first`` on, each the likeliest next (of equals the first)."""
    chain = [first]
    while len(chain) < length and (row := fsm.rows.get(chain[-1])):
        chain.append(max(row, key=row.__getitem__))
    return tuple(chain)


def sampled_chain(fsm: Fsm, first: str, length: int, source: random.Random) -> tuple[str, ...]:
    """``length`` movements from ``first`` on, drawn from the chain."""
    chain = [first]
    while len(chain) < length and (row := fsm.rows.get(chain[-1])):
        chain.append(source.choices(tuple(row), tuple(row.values()))[0])
    return tuple(chain)


def _probability(value: object, where: str) -> float:
    p = number(value, where)
    require(0.0 <= p <= 1.0, f"{where}: a probability lies between 0 and 1")
    return p


def _check_table(action: str, table: Mapping[str, Mapping[str, float]]) -> None:
    for origin, row in table.items():
        total = fsum(row.values())
        require(abs(total - 1.0) <= _ROUNDING, f"transition({action}, {origin}, …) adds up to {total:g}, not 1")
        for to in row:
            require(
                to in table,
                f"transition({action}, {origin}, {to}, …) leads to {to}, which nothing leads from",
            )


def _cycles(rows: Rows, tables: Mapping[str, Mapping[str, object]]) -> dict[str, tuple[str, ...]]:
    steps: dict[str, dict[int, str]] = {}
    for action, n, movement in rows("cycle", 3):
        require(movement in tables.get(action, {}), f"cycle({action}, {n}, {movement}) is about no transition")
        require(n not in steps.setdefault(action, {}), f"cycle({action}, {n}, …) is there twice")
        steps[action][n] = movement
    return {action: tuple(step[n] for n in sorted(step)) for action, step in steps.items()}


def _starts(rows: Rows, tables: Mapping[str, Mapping[str, object]]) -> dict[str, dict[str, float]]:
    starts: dict[str, dict[str, float]] = {}
    for action, movement, p in rows("start", 3):
        where = f"start({action}, {movement}, {p})"
        require(movement in tables.get(action, {}), f"{where} is about no transition")
        starts.setdefault(action, {})[movement] = _probability(p, where)
    for action, row in starts.items():
        total = fsum(row.values())
        require(abs(total - 1.0) <= _ROUNDING, f"start({action}, …) adds up to {total:g}, not 1")
    return starts
