"""What a search has in hand: engines, one for the question and one for each negated goal under way, and tables."""

from __future__ import annotations

from collections import deque
from collections.abc import Hashable, Iterable
from typing import TypeAlias

from casper.kb.terms.clauses import Indicator
from casper.kb.terms.terms import Term, Variable
from casper.kb.top_down.compiled.cells import Cell, thaw
from casper.kb.top_down.compiled.code import CALL, STOP, Frame, Node
from casper.kb.top_down.linking import Links
from casper.kb.top_down.running.goals import node_for
from casper.kb.top_down.running.strands import Strand
from casper.kb.top_down.running.tables import Table

Goal: TypeAlias = tuple[Indicator, Hashable]  # a predicate, and what its arguments are a variant of
Args: TypeAlias = tuple[Term, ...]
NEVER_MET = 1 << 60
ROOT, NEGATION = object(), object()  # what an answer of the question, and of a negated goal, goes to


class Engine:
    """One search to the end.

    Attributes:
        queue: strands that wait for their turn.
        tables: of the calls that are being worked out.
        goal: the negated goal that is searched for; None for the question.
        args: its arguments, frozen.
        waiting: who goes on when it is decided.
        low: the lowest engine on the stack whose goal was met again under a negation.
        uncertain: whether the goal was proved by way of something undefined.
        doubtful: whether an evaluation failed on the way.
        decided: how many goals had been decided when it began.
    """

    __slots__ = ("args", "decided", "doubtful", "goal", "low", "queue", "tables", "uncertain", "waiting")

    def __init__(
        self, first: Strand, goal: Goal | None = None, args: Args = (), waiting: Strand | None = None, decided: int = 0
    ) -> None:
        self.queue: deque[Strand] = deque([first])
        self.tables: dict[Hashable, Table] = {}
        self.goal, self.args, self.waiting, self.decided = goal, args, waiting, decided
        self.low = NEVER_MET
        self.uncertain = self.doubtful = False


class Workspace:
    """Everything that lives as long as one search.

    Attributes:
        undecided: what evaluating raises where a condition is neither true nor false, and the search goes on.
        serial: how many choice points there have been.
        toil: steps that are charged for terms so large that looking at them is work.
        done: complete tables.
        verdicts: of negated goals: True (provable), False (refuted), None (undefined).
        open: negated goals that are undefined as long as the goal of an engine further down is, and which engine.
        in_progress: the place on the stack of every goal that is being refuted.
    """

    def __init__(self, links: Links, floundering_fails: bool, undecided: tuple[type[Exception], ...]) -> None:
        self.links, self.floundering_fails, self.undecided = links, floundering_fails, undecided
        self.serial = self.toil = 0
        self.engines: list[Engine] = []
        self.done: dict[Hashable, Table] = {}
        self.verdicts: dict[Goal, bool | None] = {}
        self.open: dict[Goal, int] = {}
        self.in_progress: dict[Goal, int] = {}
        self.doubtful = False  # an evaluation failed, so an answer that is not there may not be false
        self.answer: tuple[Frame, bool] = ([], True)

    def refute(self, goal: Goal, args: Args, waiting: Strand) -> None:
        """Begin to search for a goal that is negated; its arguments are frozen."""
        self.in_progress[goal] = len(self.engines)
        cells: dict[Variable, Cell] = {}
        node = node_for(CALL, *goal[0], Node(STOP, goal[0], tuple, None, NEGATION))
        strand = Strand(node, [0, *(thaw(arg, cells) for arg in args)], None)
        self.engines.append(Engine(strand, goal, args, waiting, len(self.verdicts)))

    def finish(self, engine: Engine) -> None:
        """An engine with nothing left to do: its tables are complete, and its goal is decided."""
        for key, table in engine.tables.items():
            table.complete, table.doubtful = True, engine.doubtful
            if table.is_settled or engine.low == NEVER_MET:
                self.done[key] = table
        if engine.waiting is None:
            self.engines.pop()
            self.doubtful = self.doubtful or engine.doubtful
        else:
            self.settle(engine, None if engine.uncertain or engine.doubtful else False)

    def settle(self, engine: Engine, verdict: bool | None) -> None:
        """A negated goal is decided: who waits for it goes back (True), or on, if need be uncertain (None).

        Where negation runs in a circle, every goal on it is taken to be undefined at first. What is true or false all
        the same is so for good; with that known the circle is gone through again, until nothing more is decided.
        """
        self.engines.pop()
        goal, place, strand = engine.goal, len(self.engines), engine.waiting
        assert goal is not None and strand is not None
        del self.in_progress[goal]
        hangs = [other for other, low in self.open.items() if low >= place]
        if verdict is None and engine.low == place and len(self.verdicts) > engine.decided:
            self._forget(hangs)
            self.refute(goal, engine.args, strand)
            return
        if verdict is None and engine.low < place:
            self.open.update(dict.fromkeys((*hangs, goal), engine.low))
            self.engines[-1].low = min(self.engines[-1].low, engine.low)
        else:
            self._forget(hangs)
            self.verdicts[goal] = verdict
            if verdict is None:
                self.verdicts.update(dict.fromkeys(hangs))
        strand.failing = verdict is True
        strand.certain = strand.certain and verdict is False
        self.engines[-1].queue.appendleft(strand)

    def _forget(self, goals: Iterable[Goal]) -> None:
        for goal in goals:
            del self.open[goal]
