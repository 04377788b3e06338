"""A question put to the machine: its answers in three truth values, with what makes some of them doubtful.

Where only facts are at hand and a search falls short, what follows from them is listed, and the question asked of that.
Plain resolution (`kb.top_down.plain`) is the executable specification: `plain` gives it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Self

from casper.kb.errors import BudgetExceeded
from casper.kb.relations.relation import Relation, Row
from casper.kb.terms.clauses import Clause, Indicator, Literal
from casper.kb.terms.terms import Term, Variable
from casper.kb.terms.unification import Bindings
from casper.kb.terms.unknown import DOUBT
from casper.kb.top_down.linking import Code, Links
from casper.kb.top_down.lookups import Lookups, Planned, shape_of
from casper.kb.top_down.plain import PlainSolver
from casper.kb.top_down.search import DEFAULT_BUDGET, Search, names_of


@dataclass
class Answering(PlainSolver):
    """A solver that answers by the machine.

    Args:
        code: the compiled form of the clauses, which searches share.
        listed: gives the same search over everything that can be listed, where only facts are at hand.
        inner: the clauses of goals inside the question.
        lookups: the plans of questions on stored rows alone, where ``relations`` are theirs (and did/2 at most).
    """

    code: Code | None = None
    listed: Callable[[], Answering] | None = None
    inner: Mapping[Indicator, tuple[Clause, ...]] = field(default_factory=dict)
    lookups: Lookups | None = None

    def possible(self, body: Sequence[Literal], bindings: Bindings | None = None, depth: int = 0) -> Iterator[Bindings]:
        """As `solve`, with the doubtful solutions among the others; a solution may come twice."""
        given = {} if bindings is None else bindings
        looked_up = self._looked_up(body, given)
        if looked_up is None:
            return self._searched(body, given)
        names, found = looked_up
        return ({**given, **dict(zip(names, values))} for values in found)

    def _searched(self, body: Sequence[Literal], given: Bindings) -> Iterator[Bindings]:
        """As `possible`, by the machine."""
        before = str(given[DOUBT]) if DOUBT in given else ""
        known = {v: value for v, value in given.items() if v is not DOUBT} if before else given
        try:
            for solution, doubt in self._outcomes(body, known, before):
                yield {**solution, DOUBT: doubt} if doubt else solution
        except BudgetExceeded:
            above = self._listing()
            if above is None:
                raise
            yield from above.possible(body, given)

    def rows(self, body: Sequence[Literal], names: Sequence[Variable]) -> Iterator[tuple[Row, str]]:
        """The values of some variables in every solution, with what makes it doubtful (else ``""``); as `possible`."""
        looked_up = self._looked_up(body, {})
        if looked_up is None:
            return self._searched_rows(body, names)
        columns, found = looked_up
        if list(columns) == list(names):
            return ((values, "") for values in found)
        places = [columns.get(name, -1) for name in names]
        return ((_picked(places, names, values), "") for values in found)

    def _searched_rows(self, body: Sequence[Literal], names: Sequence[Variable]) -> Iterator[tuple[Row, str]]:
        """As `rows`, by the machine."""
        asked = body if self.code is None else self.code.query(body)
        inside = set(names_of(asked))
        columns = {name: at for at, name in enumerate(dict.fromkeys(name for name in names if name in inside))}
        places = [columns.get(name, -1) for name in names]
        search = self._search()
        try:
            for values, doubt in search.found(asked, {}, wanted=list(columns)):
                yield _picked(places, names, values), doubt
        except BudgetExceeded:
            above = self._listing()
            if above is None:
                raise
            yield from above.rows(body, names)
        finally:
            self.steps, self.code = search.steps, search.code

    def _looked_up(self, body: Sequence[Literal], given: Bindings) -> tuple[dict[Variable, int], Iterator[Row]] | None:
        """The open variables of a question on stored rows alone, and the values of each answer; None for any other.

        Raises:
            BudgetExceeded: this search has had its steps: one for every question, and those of nested look-ups.
        """
        if self.lookups is None or DOUBT in given:
            return None
        asked = shape_of(body, given)
        planned = None if asked is None else self.lookups.of(asked[0])
        if asked is None or planned is None:
            return None
        self.steps += 1
        if self.steps > self.budget:
            raise self._search().stopped(body, f"{self.budget} steps")
        _, constants, names = asked
        if len(body) > 1 or self.deadline is not None or self.cancelled is not None:
            return names, self._metered(planned, constants, body)
        return names, planned.answers(constants, None)

    def _metered(self, planned: Planned, constants: Sequence[Term], body: Sequence[Literal]) -> Iterator[Row]:
        """The answers, within the budget of this search."""
        search = self._search()
        try:
            yield from planned.answers(constants, search.meter(body))
        finally:
            self.steps = search.steps

    @property
    def links(self) -> Links:
        """How every predicate is answered here."""
        return Links(self.relations, Code(self.clauses) if self.code is None else self.code, self.computed)

    def meter(self, body: Sequence[Literal]) -> Callable[[int], int]:
        """What stops whoever works out a question elsewhere, when its time is up or it is cancelled."""
        return self._search().meter(body)

    def answers(self, literal: Literal, bindings: Bindings, depth: int = 0) -> Iterator[Bindings]:
        """Every extension of the bindings under which one condition holds, the doubtful among them."""
        return self.possible([literal], bindings)

    def with_inner(self, inner: Mapping[Indicator, tuple[Clause, ...]]) -> Self:
        """The same search with the clauses of goals inside the question."""
        if not inner:
            return self
        code = (self.code or Code(self.clauses)).extended(inner)
        return replace(self, clauses=code.clauses, code=code, inner=inner)

    def over(self, relations: Mapping[Indicator, Relation], *, floundering_fails: bool = False) -> Self:
        """The same search over other relations."""
        own = self.clauses, self.computed, self.budget, 0, floundering_fails, False, self.deadline, self.cancelled
        return type(self)(relations, *own, self.code, None, self.inner)

    def _outcomes(self, body: Sequence[Literal], bindings: Bindings, doubt: str) -> Iterator[tuple[Bindings, str]]:
        search = self._search()
        asked = body if bindings or self.code is None else self.code.query(body)
        try:
            yield from search.outcomes(asked, bindings, doubt)
        finally:
            self.steps, self.code = search.steps, search.code

    def _listing(self) -> Answering | None:
        """The same question over all that can be listed; None where the asker stopped the search, or gave it less."""
        if self.listed is None or self.code is None or self.budget < DEFAULT_BUDGET:
            return None
        if self.deadline is not None or (self.cancelled is not None and self.cancelled()):
            return None
        above = self.listed().with_inner(self.inner)
        above.cancelled, above.floundering_fails = self.cancelled, self.floundering_fails
        return above

    def _search(self) -> Search:
        return Search(
            self.relations,
            self.clauses,
            self.computed,
            self.budget,
            self.steps,
            self.floundering_fails,
            self.deadline,
            self.cancelled,
            self.code,
        )

    def plain(self) -> PlainSolver:
        """Plain resolution with all its budget, over the same."""
        return PlainSolver(
            self.relations,
            self.clauses,
            self.computed,
            self.budget,
            0,
            self.floundering_fails,
            self.doubts_hold,
            self.deadline,
            self.cancelled,
        )


def _picked(places: Sequence[int], names: Sequence[Variable], values: Row) -> Row:
    """The values of the names; one that has no place stays as it is."""
    return tuple([name if at < 0 else values[at] for at, name in zip(places, names)])
