"""What happened earlier today, as did/2 sees it: true for good, and bounded.

Rules ask whether something was done, and when. What is kept answers that for as long as there is room: of what was done
again and again the earliest times are forgotten first, then what was done longest ago, which is said (`History.lost`).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from casper.engine.settings import Rows, read_settings, require
from casper.kb.terms.terms import Compound
from casper.kb.terms.values.moments import Moment, moment_after

Done: TypeAlias = tuple[Compound, float | Moment]
"""A statement, and when it was done: seconds, or where there was no clock the moment (only the order is known)."""


@dataclass(frozen=True, slots=True)
class HistorySettings:
    """``remembered``: how many rows of did/2 are kept at most."""

    remembered: int = 1000

    def __post_init__(self) -> None:
        require(self.remembered >= 1, f"setting(verification, remembered, {self.remembered}) starts at 1")


def history_settings(rows: Rows) -> HistorySettings:
    """Settings from facts ``setting(verification, Name, Value)``.

    Raises:
        DomainError: an unknown setting, or a value that is no number from 1.
    """
    return read_settings(HistorySettings, rows, "verification")


class History(list[Done]):
    """The rows of did/2, oldest first; all who watch one world share it. ``most`` is how many there may be."""

    def __init__(self, most: int = HistorySettings().remembered) -> None:
        super().__init__()
        self.most = most
        self.lost: Compound | None = None  # the last statement of which nothing is known any more

    def remember(self, statement: Compound, seconds: float | Moment) -> None:
        """It was done; the least telling row goes where there are too many."""
        self.append((statement, seconds))
        if len(self) > self.most:
            at = self._repeated()
            if at is None:
                self.lost = self[0][0]
            del self[at or 0]

    def forget(self, statement: Compound) -> None:
        """It was not done, the last time that it was said to be."""
        at = next((at for at in reversed(range(len(self))) if self[at][0] == statement), None)
        if at is not None:
            del self[at]

    def _repeated(self) -> int | None:
        """The oldest row whose statement was done again since."""
        last = {statement: at for at, (statement, _) in enumerate(self)}
        return next((at for at, (statement, _) in enumerate(self) if last[statement] != at), None)


def in_order(done: Iterable[Compound | Done], after: Iterable[Done] = ()) -> tuple[Done, ...]:
    """A history in which each thing was done after those before it: at the time it comes with, or at its moment.

    A time after moments is one, too: how long before it they were is not known.
    """
    rows = list(after)
    for each in done:
        if isinstance(each, Compound):
            rows.append((each, moment_after(rows)))
        else:
            rows.append(each if not rows or not isinstance(rows[-1][1], Moment) else (each[0], moment_after(rows)))
    return tuple(rows)


def in_plan_order(
    statements: Sequence[Compound], done: int, before: Sequence[int], earlier: Sequence[Done] = ()
) -> tuple[Done, ...]:
    """A history in which the leaves of a plan whose bits are set in ``done`` were done, in any order it allows.

    Args:
        statements: by leaf, what was done then.
        done: the mask of the leaves.
        before: by leaf, the mask of those that come before it (`plans.trees.chart.Chart`).
        earlier: what was done before all of them.
    """
    first = moment_after(earlier)
    rows = list(earlier)
    for leaf, statement in enumerate(statements):
        if done >> leaf & 1:
            moment = Moment(first.number + leaf, first.earlier | before[leaf] << first.number, first.since)
            rows.append((statement, moment))
    return tuple(rows)
