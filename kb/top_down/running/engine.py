"""What a search has in hand: engines, one for the question and one for each goal inside it under way, and tables."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Hashable, Iterable
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
Verdict: TypeAlias = bool | str  # proved, refuted, or undefined: then why
NEVER_MET = 1 << 60
ROOT, NEGATION = object(), object()  # what an answer of the question, and of a negated goal, goes to


class Engine:
    """One search to the end.

    Attributes:
        queue: strands that wait for their turn.
        tables: of the calls that are being worked out.
        goal: the goal that is searched for, negated or with all its answers; None for the question.
        args: its arguments, frozen.
        waiting: who goes on when it is decided.
        collected: the goal's answers, where all of them are wanted.
        low: the lowest engine on the stack whose goal was met again under a negation or in what is counted.
        doubt: of a goal that was proved by way of something undefined, by what.
        decided: how many goals had been decided when it began.
    """

    __slots__ = ("args", "collected", "decided", "doubt", "goal", "low", "queue", "tables", "waiting")

    def __init__(
        self, first: Strand, goal: Goal | None = None, args: Args = (), waiting: Strand | None = None, decided: int = 0
    ) -> None:
        self.queue: deque[Strand] = deque([first])
        self.tables: dict[Hashable, Table] = {}
        self.goal, self.args, self.waiting, self.decided = goal, args, waiting, decided
        self.collected: Table | None = None
        self.low, self.doubt = NEVER_MET, ""


class Workspace:
    """Everything that lives as long as one search.

    Attributes:
        look: told of steps, it gives those that may follow before it is told again, or raises: the search has to stop.
        serial: how many choice points there have been.
        done: complete tables.
        verdicts: of negated goals.
        open: negated goals that are undefined as long as the goal of an engine further down is, and which engine.
        in_progress: the place on the stack of every goal that is being refuted, or whose answers are collected.
    """

    def __init__(self, links: Links, look: Callable[[int], int], floundering_fails: bool) -> None:
        self.links, self.look, self.floundering_fails = links, look, floundering_fails
        self.serial = 0
        self.engines: list[Engine] = []
        self.done: dict[Hashable, Table] = {}
        self.verdicts: dict[Goal, Verdict] = {}
        self.open: dict[Goal, int] = {}
        self.in_progress: dict[Goal, int] = {}
        self.answer: tuple[Frame, str] = ([], "")

    def refute(self, goal: Goal, args: Args, waiting: Strand) -> None:
        """Begin to search for a goal that is negated; its arguments are frozen."""
        self._begin(goal, args, waiting, NEGATION)

    def collect(self, goal: Goal, args: Args, waiting: Strand) -> None:
        """Begin to search for all answers of a goal; its arguments are frozen."""
        table = Table()
        self._begin(goal, args, waiting, table).collected = table

    def _begin(self, goal: Goal, args: Args, waiting: Strand, sink: object) -> Engine:
        self.in_progress[goal] = len(self.engines)
        cells: dict[Variable, Cell] = {}
        node = node_for(CALL, *goal[0], Node(STOP, goal[0], tuple, None, sink))
        strand = Strand(node, [0, *(thaw(arg, cells) for arg in args)], None)
        engine = Engine(strand, goal, args, waiting, len(self.verdicts))
        self.engines.append(engine)
        return engine

    def finish(self, engine: Engine) -> None:
        """An engine with nothing left to do: its tables are complete, and its goal is decided."""
        for key, table in engine.tables.items():
            table.complete = True
            if table.is_settled or engine.low == NEVER_MET:
                self.done[key] = table
        if engine.waiting is None:
            self.engines.pop()
        elif engine.collected is not None:
            self._collected(engine, engine.collected)
        else:
            self.settle(engine, engine.doubt or False)

    def settle(self, engine: Engine, verdict: Verdict) -> None:
        """A negated goal is decided: who waits for it goes back (True), or on, if need be doubtful.

        Where negation runs in a circle, every goal on it is taken to be undefined at first. What is true or false all
        the same is so for good; with that known the circle is gone through again, until nothing more is decided.
        """
        goal, place, strand, hangs = self._left(engine)
        is_undefined = isinstance(verdict, str)
        if is_undefined and self._is_worth_repeating(engine, place):
            self._forget(hangs)
            self.refute(goal, engine.args, strand)
            return
        if is_undefined and engine.low < place:
            self._hang((*hangs, goal), engine.low)
        else:
            self._forget(hangs)
            self.verdicts[goal] = verdict
            if is_undefined:
                self.verdicts.update(dict.fromkeys(hangs, verdict))
        strand.failing = verdict is True
        if is_undefined:
            strand.doubt = strand.doubt or str(verdict)
        self.engines[-1].queue.appendleft(strand)

    def _collected(self, engine: Engine, table: Table) -> None:
        """All answers of a goal are there; who waits for them goes on."""
        goal, place, strand, hangs = self._left(engine)
        if self._is_worth_repeating(engine, place):
            self._forget(hangs)
            self.collect(goal, engine.args, strand)
            return
        table.complete = True
        if engine.low < place:
            self._hang(hangs, engine.low)
        else:
            self._forget(hangs)
            self.done[goal] = table
        strand.collected = table
        self.engines[-1].queue.appendleft(strand)

    def _left(self, engine: Engine) -> tuple[Goal, int, Strand, list[Goal]]:
        """Take an engine off the stack: its goal and place, who waits, and the goals that hang on it."""
        self.engines.pop()
        goal, place, strand = engine.goal, len(self.engines), engine.waiting
        assert goal is not None and strand is not None
        del self.in_progress[goal]
        return goal, place, strand, [other for other, low in self.open.items() if low >= place]

    def _is_worth_repeating(self, engine: Engine, place: int) -> bool:
        """Whether more is known by now of a circle that begins and ends here."""
        return engine.low == place and len(self.verdicts) > engine.decided

    def _hang(self, goals: Iterable[Goal], low: int) -> None:
        """Goals that are undefined as long as the goal of that engine is; the engine on top hangs on it, too."""
        self.open.update(dict.fromkeys(goals, low))
        self.engines[-1].low = min(self.engines[-1].low, low)

    def _forget(self, goals: Iterable[Goal]) -> None:
        for goal in goals:
            del self.open[goal]
