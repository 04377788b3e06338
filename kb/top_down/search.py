"""One search over what holds now: the machine, with what it may cost and what it is asked in.

It answers queries, checks constraints and rebuilds proofs. `kb.top_down.solve` says the same in a few lines and is what
it must agree with, wherever that comes to an end.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from casper.kb.errors import BudgetExceeded, Undefined
from casper.kb.relations.relation import Relation, Row
from casper.kb.terms.clauses import Clause, Indicator, Literal
from casper.kb.terms.terms import Compound, Term, Variable
from casper.kb.terms.unification import Bindings, is_ground, substitute, unify
from casper.kb.terms.values.effort import charged_to
from casper.kb.top_down.compiled.cells import Cell, deref, freeze, inward, variant
from casper.kb.top_down.compiled.code import STOP, Frame, Node, Slots, linked, node_of
from casper.kb.top_down.linking import Code, Computed, Links
from casper.kb.top_down.running.engine import ROOT
from casper.kb.top_down.running.machine import Machine

BETWEEN_LOOKS = 256  # steps between two looks at the clock
DEFAULT_BUDGET = 200_000
MOST_BLOCKS = 5_000_000  # pieces of memory a search may hold: some 500 MB
MOST_PAGES = 200_000  # of 4 kB, by which the process may grow meanwhile: 800 MB
_PLAIN = frozenset((str, int, float, Compound))  # types of values that need no copying
_BETWEEN_WEIGHINGS = 16_384


@dataclass
class Search:
    """A search over stored relations, clauses for the rest, and computed predicates such as valid/1.

    ``relations`` may hold the situation (claim/1, did/2) laid over the knowledge base. ``code`` is the compiled form
    of ``clauses``, which searches share.
    """

    relations: Mapping[Indicator, Relation]
    clauses: Mapping[Indicator, Sequence[Clause]]
    computed: Mapping[Indicator, Computed] = field(default_factory=dict)
    budget: int = DEFAULT_BUDGET
    steps: int = 0
    floundering_fails: bool = False  # in constraints: what some value could still satisfy is not broken
    deadline: float | None = None  # of time.monotonic()
    cancelled: Callable[[], bool] | None = None  # asked now and then; true stops the search
    code: Code | None = None

    def solve(self, body: Sequence[Literal], bindings: Bindings | None = None) -> Iterator[Bindings]:
        """Every extension of the bindings under which the whole body certainly holds, lazily.

        Raises:
            BudgetExceeded: the search took more steps, time or memory than it may: the rest is unknown.
            Undefined: after all that is certain, where something else is neither true nor false.
            ProgramError: a condition was reached whose variables nothing binds.
        """
        given, names = bindings or {}, names_of(body)
        return (_extended(given, names, values) for values in self._certain(self.found(body, given)))

    def outcomes(
        self, body: Sequence[Literal], bindings: Bindings | None = None, doubt: str = ""
    ) -> Iterator[tuple[Bindings, str]]:
        """Every extension of the bindings, with what makes it doubtful (``""``: it certainly holds).

        Raises as `solve` does, but for `Undefined`.
        """
        given, names = bindings or {}, names_of(body)
        for values, reason in self.found(body, given, doubt):
            yield _extended(given, names, values), reason

    def _certain(self, found: Iterator[tuple[Row, str]]) -> Iterator[Row]:
        doubts: dict[Hashable, str] = {}  # undefined that way; another may make it certain
        settled: list[Row] = []
        for values, doubt in found:
            if doubt:
                doubts.setdefault(variant(values), doubt)
            else:
                settled.append(values)
                yield values
        if doubts:
            known = set(map(variant, settled))
            for key, doubt in doubts.items():
                if key not in known:
                    raise Undefined(f"whether this holds is neither true nor false: {doubt}")

    def found(
        self, body: Sequence[Literal], given: Bindings, doubt: str = "", wanted: Sequence[Variable] | None = None
    ) -> Iterator[tuple[Row, str]]:
        """The values of the body's variables, in their order, in every answer, with what makes it doubtful.

        Where only some are ``wanted``, those, in that order: the others are not copied. Raises as `outcomes` does.
        """
        names = names_of(body)
        links = Links(self.relations, self._compiled, self.computed)
        slots: Slots = {variable: at for at, variable in enumerate(names, 1)}
        cells: dict[Variable, Cell] = {}
        frame: Frame = [0, *(inward(substitute(name, given), cells) for name in names)]
        look = self.meter(body)
        machine = Machine(links, look, self.floundering_fails)
        stop = Node(STOP, ("", 0), _nothing, None, ROOT)
        chain = linked([*(node_of(literal, slots, given) for literal in body), stop])
        places = range(1, len(names) + 1) if wanted is None else [slots[name] for name in wanted]
        own = {id(cell): variable for variable, cell in cells.items()}
        try:
            for answer, reason in machine.answers(chain, frame, doubt):
                values = tuple([deref(answer[at]) for at in places])
                if not all(map(_PLAIN.__contains__, map(type, values))):
                    holes = _named(names, given, answer, own, frame)
                    with charged_to(look):
                        values = tuple([freeze(value, holes, Compound) for value in values])
                    look(len(holes) // 4)  # an answer with many open parts is work, too
                yield values, reason
        except RecursionError:
            raise BudgetExceeded("the search met a term that is nested too deeply: the answer is unknown") from None
        except MemoryError:
            machine.engines.clear()
            raise self.stopped(body, "all the memory there is") from None

    @property
    def _compiled(self) -> Code:
        if self.code is None or self.code.clauses is not self.clauses:
            self.code = Code(self.clauses)
        return self.code

    def meter(self, body: Sequence[Literal]) -> Callable[[int], int]:
        """What looks at steps, clock and memory now and then: called with the steps since then, it grants some more."""
        held, weighed = _held(), self.steps

        def look(used: int) -> int:
            nonlocal weighed
            self.steps += used
            if self.steps > self.budget:
                raise self.stopped(body, f"{self.budget} steps")
            if self.deadline is not None and time.monotonic() > self.deadline:
                raise BudgetExceeded("the search stopped when its time was up: the answer is unknown")
            if self.cancelled is not None and self.cancelled():
                raise BudgetExceeded("the search was cancelled: the answer is unknown")
            if self.steps - weighed > _BETWEEN_WEIGHINGS:
                weighed = self.steps
                if any(now - before > most for now, before, most in zip(_held(), held, (MOST_BLOCKS, MOST_PAGES))):
                    raise self.stopped(body, f"{self.steps} steps, when it held too much memory")
            return min(BETWEEN_LOOKS, self.budget + 1 - self.steps)

        return look

    def stopped(self, body: Sequence[Literal], limit: str) -> BudgetExceeded:
        """What is raised when the search has had what it may."""
        name, arity = body[0].atom.indicator if body else ("true", 0)
        return BudgetExceeded(f"the search for {name}/{arity} stopped after {limit}: the answer is unknown")


def _held() -> tuple[int, int]:
    """The blocks that Python holds, and where the system tells, the pages of memory: large values are in no block."""
    try:
        with open("/proc/self/statm", "rb") as told:
            return sys.getallocatedblocks(), int(told.read().split()[1])
    except OSError:
        return sys.getallocatedblocks(), 0


def _nothing(_: Frame) -> tuple[Term, ...]:
    return ()


def _named(
    names: Sequence[Variable], given: Bindings, answer: Frame, own: dict[int, Variable], asked: Frame
) -> dict[int, Variable]:
    """What an answer's open cells are called: those of the asker by the asker's variables."""
    if answer is asked:
        return dict(own)
    holes: dict[int, Variable] = {}  # the answer comes from a copy: its cells are others
    for name, cell in zip(names, answer[1:]):
        cell = deref(cell)
        if name not in given and type(cell) is list:
            holes.setdefault(id(cell), name)
    return holes


def _extended(given: Bindings, names: Sequence[Variable], values: Row) -> Bindings:
    """The bindings with what an answer says of the names; what stays open keeps the asker's variables."""
    found = dict(given)
    for name, value in zip(names, values):
        if name not in given:
            if value is not name:
                found[name] = value
        elif not is_ground(given[name]):
            _bind(name, value, found)
    return found


def names_of(body: Sequence[Literal]) -> list[Variable]:
    """The variables of conditions, each once, in their order."""
    return list(dict.fromkeys(variable for literal in body for variable in literal.variables()))


def _bind(name: Variable, value: Term, found: Bindings) -> None:
    """Carry what an answer says of a name that had a value with variables down to those variables."""
    extended = unify(name, value, found)
    if extended is not None:
        found.update(extended)
