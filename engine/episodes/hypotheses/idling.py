"""How likely a goal that was left alone is still pursued.

With chance ``abandon`` a goal is given up once it was touched; otherwise its turn comes again. People stay with what
they do, so among n open goals it comes after each observation with half of an even chance, 1 / (2 n). After k
observations that passed it by the odds that it is still pursued are (1 - abandon) / abandon * (1 - 1 / (2 n)) ** k.
With no other goal open what passes it by is needless, and says less: (9 / 10) ** k.
"""

from __future__ import annotations

ALONE = 0.9
BOUND = 0.02  # an instance that is less likely to be taken up again is closed
SOON = 3  # observations after which an instance closes of which only optional leaves are left


class Idling:
    """Tables of the odds for one price of giving up."""

    def __init__(self, abandon: float) -> None:
        self._odds = (1 - abandon) / abandon
        self._tables: list[tuple[float, ...]] = [(), self._table(ALONE)]

    def alive(self, together: int) -> tuple[float, ...]:
        """By how often a goal was passed by, the probability that it is still pursued: of so many open ones.

        The table ends where that falls below the bound.
        """
        while len(self._tables) <= together:
            self._tables.append(self._table(1 - 1 / (2 * len(self._tables))))
        return self._tables[together]

    def _table(self, passes: float) -> tuple[float, ...]:
        odds, found = self._odds, list[float]()
        while not found or odds / (1 + odds) >= BOUND:
            found.append(odds / (1 + odds))
            odds *= passes
        return tuple(found)
