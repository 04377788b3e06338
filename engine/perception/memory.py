"""What was seen, as relations that can be asked: the last steps, and episodes with their times, bounded in memory.

In: `Relations`, step after step. Out: a knowledge base above a domain's, in which ``qdc(T, A, O, Band)``,
``qtc(T, A, O, toward)`` (or still, away), ``mos(T, A, moving)`` (or stationary) and ``hold(T, A, O)`` tell of the last
steps, and ``during(qdc(A, O, Band), From, To)`` and its like of episodes. Of what is forgotten there are no rows: that
something was not so is said of the time from `SensoryMemory.since` on only.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Mapping
from itertools import chain
from typing import NamedTuple

from casper.engine.perception.perception import Relations
from casper.engine.settings import require
from casper.kb.base import KnowledgeBase
from casper.kb.terms.terms import Compound

WORDS = {"-": "toward", "0": "still", "+": "away"}
"""QTC's symbols as a domain writes them."""
ARITIES = {"qdc": 4, "qtc": 4, "mos": 3, "hold": 3}
Said = tuple[str, ...]
"""What holds, without its time: ("qdc", "human", "plate", "near")."""


class Lasting(NamedTuple):
    """Something that held from one step to another (seconds), at every step between."""

    said: Said
    begins: float
    ends: float


class SensoryMemory:
    """Keeps the last steps and the last episodes; what is older is forgotten.

    Args:
        steps: how many steps can be asked about by their time.
        episodes: how many that are over are remembered; what still holds is, too.

    Raises:
        DomainError: one of the numbers is below 1.
    """

    def __init__(self, steps: int = 20, episodes: int = 1000) -> None:
        require(steps >= 1 and episodes >= 1, "a sensory memory keeps at least one step and one episode")
        self._steps: deque[tuple[float, tuple[Said, ...]]] = deque(maxlen=steps)
        self._over: deque[Lasting] = deque(maxlen=episodes)
        self._open: dict[Said, Lasting] = {}

    def update(self, relations: Relations | None) -> None:
        """Take in one step; None is one at which the agent was not seen: whatever held is over."""
        said = () if relations is None else tuple(_said(relations))
        now = set(said)
        for each in [each for each in self._open if each not in now]:
            self._over.append(self._open.pop(each))
        if relations is None:
            return
        for each in said:
            before = self._open.get(each)
            self._open[each] = Lasting(each, relations.t if before is None else before.begins, relations.t)
        self._steps.append((relations.t, said))

    @property
    def since(self) -> float | None:
        """The time (seconds) of the oldest step that is remembered; None before the first."""
        return self._steps[0][0] if self._steps else None

    def rows(self) -> dict[str, list[tuple[str | float, ...]]]:
        """The rows of each relation at the last steps, the time first."""
        told: dict[str, list[tuple[str | float, ...]]] = {name: [] for name in ARITIES}
        for t, said in self._steps:
            for name, *rest in said:
                told[name].append((t, *rest))
        return told

    def episodes(self) -> Iterator[Lasting]:
        """Those that are over, from the oldest; then those that still hold, which end at the last step."""
        yield from chain(self._over, self._open.values())

    def known(self, kb: KnowledgeBase) -> KnowledgeBase:
        """The knowledge base with what is remembered, as an overlay: ``kb`` stays as it is.

        Rules that ask for these relations need ``:- dynamic qdc/4, qtc/4, mos/3, hold/3, during/3.`` in their text.
        """
        lasting = [Compound(("during", Compound(each.said), each.begins, each.ends)) for each in self.episodes()]
        seen = [Compound((name, *row)) for name, rows in self.rows().items() for row in rows]
        return kb.assume(*seen, *lasting)


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
