"""Strands: independent branches of a search, each with its own choice points, trail and cells.

Strands share nothing that is written, so they take turns freely: no branch starves another, however long it goes on.
What a strand still has to do can be copied (a `Snapshot`): to be continued with each answer of a table, or to give a
choice point a strand of its own.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, TypeAlias

from casper.kb.terms.terms import Term, Variable
from casper.kb.top_down.compiled.cells import UNBOUND, Cell, Trail, freeze, thaw
from casper.kb.top_down.compiled.code import Frame, Node

Cont: TypeAlias = tuple[Any, ...] | None  # (node, frame, continuation): what is to be done after this
State: TypeAlias = tuple["Node | None", Frame, Cont, str]  # what is to be done next, and what makes that doubtful
CLAUSES, ROWS, VALUES, BRANCHES, ANSWERS = range(5)
DEAD, TIRED, ANSWERED, PROVED, NESTING = range(5)  # what ends a strand's turn
TURN = 1_024  # steps before another strand has its turn


class Choice:
    """A choice point: what else can be tried, and where the trail was.

    Attributes:
        mark: the trail's length.
        serial: its age.
        doubt: why the branch up to here is undefined; empty where it certainly holds.
        kind: CLAUSES (``what``: the clauses, from ``at`` on), ROWS (an iterator of rows), VALUES (an iterator of a
            built-in's values), BRANCHES (goal terms) or ANSWERS (a consumer of a table).
        args: the terms that are matched.
        cont: what is to be done then.
    """

    __slots__ = ("args", "at", "cont", "doubt", "kind", "mark", "serial", "what")

    def __init__(
        self, mark: int, serial: int, doubt: str, kind: int, what: Any, at: int, args: Any, cont: Cont
    ) -> None:
        self.mark, self.serial, self.doubt, self.kind = mark, serial, doubt, kind
        self.what, self.at, self.args, self.cont = what, at, args, cont


class Strand:
    """A branch of the search.

    Attributes:
        node, frame, cont, doubt: what is to be done next, when it has its turn again.
        failing: it goes on by its newest choice point instead.
        event: what ended its turn, where that was no failure.
        choices: its choice points, the newest last.
        top: the newest one's serial, 0 without any.
        turn: steps that are left of its turn.
        collected: the answers that an aggregate has waited for.
    """

    __slots__ = ("choices", "collected", "cont", "doubt", "event", "failing", "frame", "node", "top", "trail", "turn")

    def __init__(self, node: Node | None, frame: Frame, cont: Cont, doubt: str = "") -> None:
        self.node, self.frame, self.cont, self.doubt = node, frame, cont, doubt
        self.choices: list[Choice] = []
        self.trail = Trail()
        self.failing, self.turn = False, TURN
        self.event = self.top = 0
        self.collected: Any = None

    def push(self, choice: Choice) -> None:
        """Make a choice point."""
        self.choices.append(choice)
        self.top = choice.serial

    def pop(self) -> None:
        """Take the newest choice point away: it is used up."""
        choices = self.choices
        choices.pop()
        self.top = choices[-1].serial if choices else 0

    @classmethod
    def of(cls, choice: Choice) -> Strand:
        """A strand that begins by taking a choice."""
        strand = cls(None, [], None)
        strand.push(choice)
        strand.failing = True
        return strand


@dataclass(frozen=True, slots=True)
class Snapshot:
    """A continuation with some terms, all cells frozen."""

    frames: tuple[tuple[Node, tuple[Term, ...]], ...]
    terms: tuple[Term, ...]

    @property
    def size(self) -> int:
        """How many frames there are."""
        return len(self.frames)

    def revived(self, stamp: int) -> tuple[Cont, tuple[Any, ...]]:
        """The continuation and the terms with cells of their own."""
        cells: dict[Variable, Cell] = {}
        cont: Cont = None
        for node, terms in reversed(self.frames):
            cont = (node, [stamp, *[_thawed(term, cells, stamp) for term in terms]], cont)
        return cont, tuple([_thawed(term, cells, stamp) for term in self.terms])


def _thawed(term: Term, cells: dict[Variable, Cell], stamp: int) -> Any:
    return thaw(term, cells, stamp) if type(term) is tuple or type(term) is Variable else term


def snapshot(cont: Cont, terms: tuple[Any, ...]) -> Snapshot:
    """What is to be done, and some terms, as they are now."""
    holes: dict[int, Variable] = {}
    return Snapshot(
        tuple([(node, tuple([freeze(part, holes) for part in frame[1:]])) for node, frame in _frames(cont)]),
        tuple([freeze(term, holes) for term in terms]),
    )


def _frames(cont: Cont) -> Iterator[tuple[Node, Frame]]:
    while cont is not None:
        yield cont[0], cont[1]
        cont = cont[2]


def split(strand: Strand) -> Strand | None:
    """Take the strand's oldest choice point away into a strand of its own; None where there is none.

    Its turn grows with what the copying cost, so that copying never outweighs the search.
    """
    strand.turn = TURN
    if not strand.choices:
        strand.trail.clear()
        return None
    choice = strand.choices.pop(0)
    strand.top = strand.choices[-1].serial if strand.choices else 0
    since = strand.trail[choice.mark :]
    values = [cell[0] for cell in since]
    for cell in since:
        cell[0] = UNBOUND
    copy = snapshot(choice.cont, choice.args)
    for cell, value in zip(reversed(since), reversed(values)):
        cell[0] = value
    cont, args = copy.revived(0)
    strand.turn = max(TURN, len(since), copy.size)
    return Strand.of(Choice(0, choice.serial, choice.doubt, choice.kind, choice.what, choice.at, args, cont))
