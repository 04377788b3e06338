"""What was seen of one agent: the last steps, and episodes with their times, bounded in memory.

In: `Relations`, step after step. Out: rows of ``qdc(T, A, O, Band)``, ``qtc(T, A, O, toward)`` (or still, away),
``mos(T, A, moving)`` (or stationary) and ``hold(T, A, O)`` at the last steps, and episodes, ``during(qdc(A, O, Band),
From, To)`` and its like. What is not known is kept beside: what was before, when the agent or a thing was not seen, and
what is forgotten. How rules ask for them is in `engine.perception.remembering.asked`.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import chain
from typing import NamedTuple

from casper.engine.perception.perception import Relations
from casper.engine.settings import Rows, read_settings, require

WORDS = {"-": "toward", "0": "still", "+": "away"}
"""QTC's symbols as a domain writes them."""
ARITIES = {"qdc": 4, "qtc": 4, "mos": 3, "hold": 3}
MOST_THINGS = 20_000  # of which it is remembered when they were seen; then the one not seen for longest is forgotten
MOST_GAPS = 50  # of one thing; before the last of them nothing is known
Said = tuple[str, ...]
"""What holds, without its time: ("qdc", "human", "plate", "near")."""
Kind = tuple[str, ...]
"""Of what a step may say something: ("qdc", "plate"), ("qtc", "plate"), ("mos",), ("hold",)."""


@dataclass(frozen=True, slots=True)
class MemorySettings:
    """``steps``: how many can be asked about by their time. ``episodes``: how many that are over are remembered."""

    steps: int = 20
    episodes: int = 1000

    def __post_init__(self) -> None:
        require(self.steps >= 1 and self.episodes >= 1, "a sensory memory keeps at least one step and one episode")


def memory_settings(rows: Rows) -> MemorySettings:
    """Settings from facts ``setting(memory, Name, Value)``.

    Raises:
        DomainError: an unknown setting, or a value that is no number from 1.
    """
    return read_settings(MemorySettings, rows, "memory")


class Lasting(NamedTuple):
    """Something that held from one step to another (seconds), at every step between."""

    said: Said
    begins: float
    ends: float


class Step(NamedTuple):
    """What was seen at one time (seconds), and of what anything was."""

    t: float
    said: tuple[Said, ...]
    seen: frozenset[Kind]


class SensoryMemory:
    """Keeps the last steps and the last episodes; what is older is forgotten.

    Args:
        steps: how many steps can be asked about by their time.
        episodes: how many that are over are remembered; what still holds is, too.

    Raises:
        DomainError: one of the numbers is below 1.
    """

    def __init__(self, steps: int = 20, episodes: int = 1000) -> None:
        settings = MemorySettings(steps, episodes)
        self.steps: deque[Step] = deque(maxlen=settings.steps)
        self._over: deque[Lasting] = deque()
        self._most = settings.episodes
        self._open: dict[Said, Lasting] = {}
        self._seen: dict[Kind, _Seen] = {}
        self._begun: float | None = None  # from when on all episodes are remembered

    def update(self, t: float, relations: Relations | None) -> None:
        """Take in the step at ``t`` (seconds); None is one at which the agent was not seen: whatever held is over."""
        said = () if relations is None else tuple(_said(relations))
        seen = frozenset() if relations is None else frozenset(_kinds(relations))
        if self._begun is None:
            self._begun = t
        self.steps.append(Step(t, said, seen))
        now = set(said)
        for each in [each for each in self._open if each not in now]:
            self._over.append(self._open.pop(each))
        for each in said:
            before = self._open.get(each)
            self._open[each] = Lasting(each, t if before is None else before.begins, t)
        while len(self._over) > self._most:
            self._begun = max(self._begun, math.nextafter(self._over.popleft().ends, math.inf))
        for kind in seen:
            self._notice(kind, t)
        for kind, found in self._seen.items():
            found.lost = None if kind in seen else found.last if found.lost is None else found.lost

    def _notice(self, kind: Kind, t: float) -> None:
        found = self._seen.pop(kind, None) or _Seen(t, t)
        if found.lost is not None:
            found.gaps.append((found.lost, t))
            if len(found.gaps) > MOST_GAPS:
                found.first = found.gaps.popleft()[1]
        found.last, found.lost = t, None
        self._seen[kind] = found  # the last ones stand behind
        if len(self._seen) > MOST_THINGS:
            del self._seen[next(iter(self._seen))]

    @property
    def since(self) -> float | None:
        """The time (seconds) of the oldest step that is remembered; None before the first."""
        return self.steps[0].t if self.steps else None

    def rows(self) -> dict[str, list[tuple[str | float, ...]]]:
        """The rows of each relation at the last steps, the time first."""
        told: dict[str, list[tuple[str | float, ...]]] = {name: [] for name in ARITIES}
        for step in self.steps:
            for name, *rest in step.said:
                told[name].append((step.t, *rest))
        return told

    def episodes(self) -> Iterator[Lasting]:
        """Those that are over, from the oldest; then those that still hold, which end at the last step."""
        yield from chain(self._over, self._open.values())

    def kinds(self, name: str) -> list[Kind]:
        """Of what something was ever said by a relation."""
        return [kind for kind in self._seen if kind[0] == name]

    def unknown(self, kind: Kind) -> list[tuple[float, float]]:
        """Between which times (seconds) there may have been episodes that are not remembered, or were not seen."""
        found = self._seen.get(kind)
        if found is None or self._begun is None:
            return [(-math.inf, math.inf)]
        spans = [(-math.inf, max(found.first, self._begun)), *found.gaps]
        if found.lost is not None:
            spans.append((found.lost, math.inf))
        return [(a, b) for a, b in spans if b > self._begun or a == -math.inf]


@dataclass
class _Seen:
    """When something was seen: from when on, the gaps since, when last, and since when it is lost (seconds)."""

    first: float
    last: float
    lost: float | None = None

    def __post_init__(self) -> None:
        self.gaps: deque[tuple[float, float]] = deque()


def kind_of(said: Said) -> Kind:
    """Of what something is said."""
    return (said[0], *said[2:-1])


def _said(relations: Relations) -> Iterator[Said]:
    agent = relations.agent
    if relations.moving is not None:
        yield "mos", agent, "moving" if relations.moving else "stationary"
    if relations.holding is not None:
        yield "hold", agent, relations.holding
    for name, label in relations.qdc.items():
        yield "qdc", agent, name, label
    symbols: Mapping[str, str | None] = relations.qtc
    for name, symbol in symbols.items():
        if symbol is not None:
            yield "qtc", agent, name, WORDS[symbol]


def _kinds(relations: Relations) -> Iterator[Kind]:
    yield ("hold",)
    if relations.moving is not None:
        yield ("mos",)
    yield from (("qdc", name) for name in relations.qdc)
    yield from (("qtc", name) for name, symbol in relations.qtc.items() if symbol is not None)
