"""The answers to a question as data that shows itself: a table in a notebook, a line an answer elsewhere."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice
from typing import Any

from casper.kb.base import KnowledgeBase
from casper.kb.errors import BudgetExceeded, Undefined
from casper.kb.terms.syntax import term_text
from casper.kb.text.lines import Line, Shown, Span, line, one_line, text_of

MOST = 20  # answers that are shown


@dataclass(frozen=True, slots=True, repr=False)
class Asked(Shown):
    """A question with its first answers.

    ``rows`` have a text for each of the ``names``; a question without open parts has no names, and one row when it
    holds. ``more`` tells that there are others, ``doubt`` why it is not known whether there are: "no" is only said
    where there is none.
    """

    question: str
    names: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    more: bool = False
    doubt: str = ""

    def to_json(self) -> dict[str, Any]:
        """``{"question", "answers": [{name: text}], "more", "doubt"}``."""
        answers = [dict(zip(self.names, row)) for row in self.rows]
        return {"question": self.question, "answers": answers, "more": self.more, "doubt": self.doubt or None}

    def lines(self) -> Iterator[Line]:
        """An answer a line."""
        for row in self.rows:
            yield line(", ".join(f"{name} = {value}" for name, value in zip(self.names, row)) or "yes")
        yield from self.closing()

    def closing(self) -> Iterator[Line]:
        """What there is to say behind the answers."""
        if self.more:
            yield line(Span("… and more", "faint"))
        if self.doubt:
            yield line(Span(self.doubt, "warning"))
        elif not self.rows:
            yield line("no")

    def __str__(self) -> str:
        return text_of(self.lines())

    def __repr__(self) -> str:
        return one_line(f"Answers to {self.question}: {'; '.join(str(self).splitlines())}")


def asked(kb: KnowledgeBase, question: str, most: int = MOST) -> Asked:
    """The first answers to a question.

    Raises:
        ReadError, ProgramError: the text is no question, or nothing defines its predicate.
    """
    found: list[dict[str, str]] = []
    doubt = ""
    try:
        for answer in islice(kb.query(question), most + 1):
            found.append({name: term_text(value) for name, value in answer.items()})
    except Undefined as mistake:
        doubt = mistake.sentence
    except BudgetExceeded as mistake:
        doubt = f"unknown: {mistake.sentence}"
    names = tuple(found[0]) if found else ()
    rows = tuple(tuple(answer[name] for name in names) for answer in found[:most])
    return Asked(question, names, rows, len(found) > most, doubt)
