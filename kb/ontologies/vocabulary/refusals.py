"""What no clause can say: a reason, raised or handed on among the clauses that could be made."""

from __future__ import annotations

from typing import TypeAlias

from casper.kb.terms.clauses import Clause


class Beyond(Exception):
    """Part of an axiom that is beyond what rules can say; the message is the reason and what to do."""


Said: TypeAlias = Clause | Beyond
