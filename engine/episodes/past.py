"""What happened earlier, for ``did/2``, in bounded memory.

The last so many statements are kept as they are. Of what lies further back each statement is kept once, with the last
time it was done: that it happened, and when last, stays true for good; how often is known of the recent past only.
"""

from __future__ import annotations

from typing import TypeAlias

from casper.engine.verification.history import Done
from casper.kb.terms.terms import Compound
from casper.kb.terms.values.moments import Moment

Past: TypeAlias = tuple[Done, ...]
RECENT = 200  # statements kept as they are
MOST = 2000  # statements kept in all


def with_statement(past: Past, statement: Compound, t: float | Moment) -> Past:
    """The past after something was done."""
    longer = (*past, (statement, t))
    if len(longer) <= RECENT:
        return longer
    at = len(longer) - RECENT - 1  # what has just become long ago; what lies before it is there once
    aged, is_done_later = longer[at], any(longer[at][0] == later for later, _ in longer[at + 1 :])
    earlier = tuple(done for done in longer[:at] if done[0] != aged[0])
    kept = earlier if is_done_later else (*earlier, aged)
    return (*kept[max(0, len(kept) + RECENT - MOST) :], *longer[at + 1 :])
