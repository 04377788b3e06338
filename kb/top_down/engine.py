"""What a search has in hand: its engines, one for the question and one for each negated goal under way, and its tables."""

from __future__ import annotations

from collections import deque
from collections.abc import Hashable

from casper.kb.top_down.code import Frame
from casper.kb.top_down.linking import Links
from casper.kb.top_down.strands import Strand
from casper.kb.top_down.tables import Table

ROOT, NEGATION = object(), object()  # what an answer of the question, and of a negated goal, goes to


class Engine:
    """One search to the end.

    Attributes:
        queue: strands that wait for their turn.
        tables: of the calls that are being worked out.
        goal: the negated goal that is searched for; None for the question.
        waiting: who goes on when it is decided.
        low: the lowest engine on the stack whose goal was met again under a negation; its own place if none.
        uncertain: whether the goal was proved by way of something undefined.
        doubtful: whether an evaluation failed on the way.
    """

    __slots__ = ("doubtful", "goal", "low", "queue", "tables", "uncertain", "waiting")

    def __init__(self, first: Strand, goal: Hashable = None, waiting: Strand | None = None, low: int = 0) -> None:
        self.queue: deque[Strand] = deque([first])
        self.tables: dict[Hashable, Table] = {}
        self.goal, self.waiting, self.low = goal, waiting, low
        self.uncertain = self.doubtful = False


class Workspace:
    """Everything that lives as long as one search.

    Attributes:
        serial: how many choice points there have been.
        done: complete tables.
        verdicts: of negated goals: True (provable), False (refuted), None (undefined).
        in_progress: the place on the stack of every goal that is being refuted.
    """

    def __init__(self, links: Links, floundering_fails: bool) -> None:
        self.links, self.floundering_fails = links, floundering_fails
        self.serial = 0
        self.engines: list[Engine] = []
        self.done: dict[Hashable, Table] = {}
        self.verdicts: dict[Hashable, bool | None] = {}
        self.in_progress: dict[Hashable, int] = {}
        self.doubtful = False  # an evaluation failed, so an answer that is not there may not be false
        self.answer: tuple[Frame, bool] = ([], True)

    def push(self, goal: Hashable, strand: Strand, waiting: Strand) -> None:
        """Begin to refute a goal."""
        place = self.in_progress[goal] = len(self.engines)
        self.engines.append(Engine(strand, goal, waiting, place))

    def finish(self, engine: Engine) -> None:
        """An engine with nothing left to do: its tables are complete, and its goal is decided."""
        for key, table in engine.tables.items():
            table.complete, table.doubtful = True, engine.doubtful
            if table.is_settled or engine.low >= len(self.engines) - 1:
                self.done[key] = table
        if engine.waiting is None:
            self.engines.pop()
            self.doubtful = self.doubtful or engine.doubtful
        else:
            self.settle(engine, None if engine.uncertain or engine.doubtful else False)

    def settle(self, engine: Engine, verdict: bool | None) -> None:
        """A negated goal is decided: who waits for it goes back (True), or on, if need be uncertain (None).

        What is undefined only because a goal further down is still open may yet be decided: it is not remembered.
        """
        self.engines.pop()
        del self.in_progress[engine.goal]
        parent, strand = self.engines[-1], engine.waiting
        assert strand is not None
        if verdict is not None or engine.low >= len(self.engines):
            self.verdicts[engine.goal] = verdict
        else:
            parent.low = min(parent.low, engine.low)
        strand.failing = verdict is True
        strand.certain = strand.certain and verdict is False
        parent.queue.appendleft(strand)
