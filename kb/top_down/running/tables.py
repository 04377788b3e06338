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
        answers: rows in the order in which they were found, each with whether it is certain; one that was uncertain
            first and became certain stands twice.
        doubtful: whether an evaluation failed on the way, so that what is not there may not be false.
        complete: whether all answers are there.
    """

    __slots__ = ("answers", "complete", "consumers", "doubtful", "known")

    def __init__(self) -> None:
        self.answers: list[tuple[tuple[Term, ...], bool]] = []
        self.known: dict[Hashable, bool] = {}
        self.consumers: list[Consumer] = []
        self.doubtful = self.complete = False

    @property
    def is_settled(self) -> bool:
        """Whether every answer is certain and everything else is false."""
        return not self.doubtful and all(self.known.values())

    def add(self, row: tuple[Term, ...], certain: bool, queue: Queue) -> bool:
        """Note an answer and wake who waits; False when it says nothing new."""
        key = variant(row)
        before = self.known.get(key)
        if before is not None and (before or not certain):
            return False
        self.known[key] = certain
        self.answers.append((row, certain))
        for consumer in self.consumers:
            queue.append(consumer.strand())
        self.consumers.clear()
        return True


class Consumer:
    """A continuation that is to go on with every answer of a table."""

    __slots__ = ("at", "certain", "saved", "table")

    def __init__(self, table: Table, cont: Cont, args: tuple[Any, ...], certain: bool) -> None:
        self.table, self.certain, self.at = table, certain, 0
        self.saved: Snapshot = snapshot(cont, args)

    def strand(self) -> Strand:
        """A strand that goes on with the answers not yet seen."""
        return Strand.of(Choice(0, 0, True, ANSWERS, self, 0, (), None))

    def next(self) -> tuple[tuple[Term, ...], bool] | None:
        """The next answer; None, and the consumer waits, when there is none yet."""
        if self.at < len(self.table.answers):
            self.at += 1
            return self.table.answers[self.at - 1]
        if not self.table.complete:
            self.table.consumers.append(self)
        return None
