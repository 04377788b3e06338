"""Every exception of the project: each is one sentence, with the place where there is one."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class Place:
    """Where a clause or a mistake stands: file, line and column (both from 1; 0 = unknown).

    ``citation`` is what the author says it comes from, in a comment ``%: …`` on its line; proofs show it.
    """

    file: str = "<text>"
    line: int = 0
    column: int = 0
    citation: str = field(default="", compare=False)

    def __str__(self) -> str:
        return ":".join(str(part) for part in (self.file, self.line, self.column) if part != 0)

    @property
    def brief(self) -> str:
        """The file's name without its folder, and the line: ``ontology.pl:41``; empty where the line is unknown."""
        return f"{self.file.rsplit('/', 1)[-1]}:{self.line}" if self.line else ""


class CasperError(Exception):
    """Something the user can mend; ``str()`` is the sentence a person is shown.

    ``place`` says where (None when there is no text behind the mistake); ``sentence`` is the message without it.
    """

    def __init__(self, sentence: str, place: Place | None = None) -> None:
        super().__init__(sentence if place is None else f"{place}: {sentence}")
        self.sentence = sentence
        self.place = place


class DomainError(CasperError):
    """A domain that cannot be loaded: an unknown name, a missing or unreadable file, a contradiction in it."""


class ReadError(CasperError):
    """Text that is not a clause of the language; ``excerpt`` shows the line with a caret under the mistake.

    ``quoted`` is what the sentence repeats of the text, if anything.
    """

    place: Place

    def __init__(self, sentence: str, place: Place, excerpt: str = "", quoted: str = "") -> None:
        super().__init__(sentence, place)
        self.excerpt, self.quoted = excerpt, quoted

    def __str__(self) -> str:
        return super().__str__() + (f"\n{self.excerpt}" if self.excerpt else "")


class ProgramError(CasperError):
    """A program with no meaning: a predicate nobody defines, negation through recursion, an unsafe clause."""


class PlanError(CasperError):
    """A plan library with a mistake: an unknown action, a task without production, an empty plan."""


class WorldStateError(CasperError):
    """A world state that cannot be used: a missing or NaN coordinate, time running backwards."""


class TraceError(CasperError):
    """A trace that qualitative relations cannot be taken of, or a calculus with settings that make no sense."""


class BudgetExceeded(CasperError):
    """A search stopped at its budget: the answer is unknown, not no."""


class Undefined(CasperError):
    """A statement that is neither true nor false: negation runs in a circle, or an evaluation failed."""


class NotOnColumns(CasperError):
    """Something cannot be worked out on numpy columns, and has to be on rows; the sentence says what is in the way."""
