"""Tables: the answers of a call, each once, and who waits for more of them.

A call that is a variant of an earlier one is not worked out again: it consumes the table's answers as they come. That
ends every recursion over finitely many terms, on whichever side the recursive condition stands.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Hashable
from typing import Any, TypeAlias

from casper.kb.terms.terms import Term
from casper.kb.top_down.compiled.cells import variant
from casper.kb.top_down.running.strands import ANSWERS, Choice, Cont, Snapshot, Strand, snapshot

Queue: TypeAlias = "deque[Strand]"


class Table:
    """The answers of one call, as frozen rows of its arguments.

    Attributes:
        answers: rows in the order in which they were found, each with what makes it doubtful (else ``""``); one that
            was doubtful first and became certain stands twice.
        known: by what a row is a variant of, whether it is certain.
        complete: whether all answers are there.
    """

    __slots__ = ("answers", "complete", "consumers", "known")

    def __init__(self) -> None:
        self.answers: list[tuple[tuple[Term, ...], str]] = []
        self.known: dict[Hashable, bool] = {}
        self.consumers: list[Consumer] = []
        self.complete = False

    @property
    def is_settled(self) -> bool:
        """Whether every answer is certain and everything else is false."""
        return all(self.known.values())

    def add(self, row: tuple[Term, ...], doubt: str, queue: Queue) -> bool:
        """Note an answer and wake who waits; False when it says nothing new."""
        key = variant(row)
        before = self.known.get(key)
        if before is not None and (before or doubt):
            return False
        self.known[key] = not doubt
        self.answers.append((row, doubt))
        for consumer in self.consumers:
            queue.append(consumer.strand())
        self.consumers.clear()
        return True


class Consumer:
    """A continuation that is to go on with every answer of a table."""

    __slots__ = ("at", "doubt", "saved", "table")

    def __init__(self, table: Table, cont: Cont, args: tuple[Any, ...], doubt: str) -> None:
        self.table, self.doubt, self.at = table, doubt, 0
        self.saved: Snapshot = snapshot(cont, args)

    def strand(self) -> Strand:
        """A strand that goes on with the answers not yet seen."""
        return Strand.of(Choice(0, 0, "", ANSWERS, self, 0, (), None))

    def next(self) -> tuple[tuple[Term, ...], str] | None:
        """The next answer; None, and the consumer waits, when there is none yet."""
        if self.at < len(self.table.answers):
            self.at += 1
            return self.table.answers[self.at - 1]
        if not self.table.complete:
            self.table.consumers.append(self)
        return None
