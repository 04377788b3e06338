"""What rules on did/2 no longer see, since there is no room for it, is said; once for each statement."""

from __future__ import annotations

from collections.abc import Iterator

from casper.engine.events import Event
from casper.engine.verification.history import History
from casper.kb.base import KnowledgeBase
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term


class Forgetting:
    """Of a history on which rules of a knowledge base may depend."""

    def __init__(self, history: History, kb: KnowledgeBase) -> None:
        self.history, self.kb = history, kb
        self._told: Compound | None = None

    def told(self, t: float) -> Iterator[Event]:
        """A ``warning`` where a statement was lost that was not told of yet."""
        lost = self.history.lost
        if lost is not None and lost != self._told and self.kb.depends_on_history:
            self._told = lost
            room = f"setting(verification, remembered, {self.history.most}) leaves no room for it"
            yield Event("warning", t, {"message": f"did/2 no longer has {term_text(as_term(lost))}: {room}"})
