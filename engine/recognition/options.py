"""What may be switched on in a recogniser: everything off is the paper's."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from casper.engine.recognition.scoring import Score, paper
from casper.kb.errors import CasperError


@dataclass(frozen=True, slots=True)
class Options:
    """What a reading may be told.

    ``noise`` is the factor on a score for each needless or misread observation (None: there are none), ``goals`` how
    many goals may be pursued at once, ``priors`` each goal's prior by label, ``measure`` the score, ``budget`` how many
    states may be kept (None: 20,000; of two goals at once 50,000, of more 3,000).
    """

    noise: float | None = None
    goals: int = 1
    priors: Mapping[str, float] | None = None
    measure: Score = paper
    budget: int | None = None

    def check(self) -> None:
        """Refuse what makes no sense.

        Raises:
            CasperError: a price that is no number above 0 and at most 1, or no whole number of goals above 0.
        """
        noise: Any = self.noise
        if noise is not None and (not _is_number(noise) or not 0 < noise <= 1):
            raise CasperError(f"the price of a needless observation is a factor above 0 and at most 1, not {noise}")
        if isinstance(self.goals, bool) or not isinstance(self.goals, int) or self.goals < 1:
            raise CasperError(f"the number of goals pursued at once is a whole number from 1, not {self.goals}")
        budget: Any = self.budget
        if budget is not None and (isinstance(budget, bool) or not isinstance(budget, int) or budget < 1):
            raise CasperError(f"a budget is a whole number of states from 1, not {budget}")


PAPER = Options()


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)
