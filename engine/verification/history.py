"""What happened earlier today, as did/2 sees it: true for good, and bounded.

Rules ask whether something was done, and when. What is kept answers that for as long as there is room: of what was done
again and again the earliest times are forgotten first, then what was done longest ago, which is said (`History.lost`).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from casper.engine.settings import Rows, read_settings, require
from casper.kb.terms.terms import Compound

Done: TypeAlias = tuple[Compound, float]
"""A statement, and when it was done (seconds)."""


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

    def remember(self, statement: Compound, seconds: float) -> None:
        """It was done; the least telling row goes where there are too many."""
        self.append((statement, seconds))
        if len(self) > self.most:
            at = self._repeated()
            if at is None:
                self.lost = self[0][0]
            del self[at or 0]

    def _repeated(self) -> int | None:
        """The oldest row whose statement was done again since."""
        last = {statement: at for at, (statement, _) in enumerate(self)}
        return next((at for at, (statement, _) in enumerate(self) if last[statement] != at), None)
