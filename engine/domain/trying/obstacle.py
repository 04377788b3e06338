"""What keeps anybody from doing a step, a condition or a task of a plan."""

from __future__ import annotations

from dataclasses import dataclass

from casper.kb.errors import Place
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Variable, as_term

ANYBODY = Variable("Anybody", -1)


@dataclass(frozen=True, slots=True)
class Obstacle:
    """A step that is not valid, or a condition that never holds, and why; without both it is the goal itself."""

    step: Compound | None
    place: Place
    reasons: tuple[str, ...]
    condition: str = ""

    def __str__(self) -> str:
        shown = "" if self.step is None else f"nobody can do {term_text(as_term(self.step))}, because "
        shown = f"{self.condition} never holds, because " if self.condition else shown
        return f"{shown}{'; '.join(self.reasons)}"
