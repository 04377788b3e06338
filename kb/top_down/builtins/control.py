"""Goals about goals: what the machine does with them is in `kb.top_down.running.goals`."""

from __future__ import annotations

from casper.kb.terms.builtins import MOST_EXTRA
from casper.kb.terms.clauses import Indicator

CALLED, REFUTED = "call", "not"
CONTROL: dict[Indicator, str | bool] = {
    ("true", 0): True,
    ("fail", 0): False,
    ("false", 0): False,
    ("not", 1): REFUTED,
    **{("call", 1 + extra): CALLED for extra in range(MOST_EXTRA + 1)},
}
