"""Which of the two ways a question is answered: by the machine, or by plain resolution in three truth values.

The machine (`kb.top_down.search`) is fast, ends recursion by tables, and its depth is bounded by memory alone. It is
asked first, and what it says is taken only where everything is settled. As soon as the question touches what it cannot
carry, the *whole* question goes to plain resolution (`kb.top_down.plain`), which knows all three truth values and says
"unknown" where it would not end:

* a relation with undefined rows, or an aggregate (`NotCarried`);
* an evaluation without a value, or a computed predicate that is undefined (`EvaluationFailed`, `Undefined`);
* an answer by way of a negation in a circle that ends undefined (an outcome that is not certain).

So no answer ever rests on two ways of keeping track of what is undefined. Answers that the machine gave before are
certain; plain resolution gives them once more, and whoever asks takes each once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Self

from casper.kb.errors import Undefined
from casper.kb.relations.relation import Relation, Row
from casper.kb.terms.clauses import Clause, Indicator, Literal
from casper.kb.terms.terms import Term, Variable
from casper.kb.terms.unification import Bindings, substitute
from casper.kb.terms.unknown import DOUBT
from casper.kb.terms.values.arithmetic import EvaluationFailed
from casper.kb.top_down.compiled.code import NotCarried
from casper.kb.top_down.linking import Code, Links
from casper.kb.top_down.lookups import Lookups, Planned, shape_of
from casper.kb.top_down.plain import PlainSolver
from casper.kb.top_down.search import Search, names_of

_UNSETTLED = (NotCarried, EvaluationFailed, Undefined)


@dataclass
class Answering(PlainSolver):
    """A solver that answers by the machine where it can.

    Args:
        code: the compiled form of the clauses, which searches share.
        listed: gives the same search over everything that can be listed, where only facts are at hand.
        inner: clauses of goals inside the question.
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
        """As `possible`, by the machine or by plain resolution."""
        if DOUBT not in given:
            try:
                for solution, certain in self._by_machine(body, given):
                    if solution is None or not certain:
                        break
                    yield solution
                else:
                    return
            except _UNSETTLED:
                pass
        yield from self.plain().possible(body, given)

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
        """As `rows`, by the machine or by plain resolution."""
        asked = body if self.code is None else self.code.query(body)
        columns = {name: at for at, name in enumerate(names_of(asked))}
        places = [columns.get(name, -1) for name in names]
        search = self._search()
        try:
            for values, certain in search.found(asked, {}):
                if values is None or not certain:
                    break
                yield _picked(places, names, values), ""
            else:
                return
        except _UNSETTLED:
            pass
        finally:
            self.steps, self.code = search.steps, search.code
        for solution in self.plain().possible(body):
            doubt = str(solution[DOUBT]) or "it is undefined" if DOUBT in solution else ""
            yield tuple([substitute(name, solution) for name in names]), doubt

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
        return replace(self, clauses={**self.clauses, **inner}, code=None, inner=inner) if inner else self

    def over(self, relations: Mapping[Indicator, Relation], *, floundering_fails: bool = False) -> Self:
        """The same search over other relations."""
        own = self.clauses, self.computed, self.budget, 0, floundering_fails, False, self.deadline, self.cancelled
        return type(self)(relations, *own, self.code, None, self.inner)

    def _by_machine(
        self, body: Sequence[Literal], bindings: Bindings
    ) -> Iterator[tuple[Bindings | None, bool]]:
        search = self._search()
        asked = body if bindings or self.code is None else self.code.query(body)
        try:
            yield from search.outcomes(asked, bindings)
        finally:
            self.steps, self.code = search.steps, search.code

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
            settled=True,
        )

    def plain(self) -> PlainSolver:
        """Plain resolution with all its budget: what the machine spent was for nothing."""
        above = self if self.listed is None else self.listed().with_inner(self.inner)
        return PlainSolver(
            above.relations,
            above.clauses,
            above.computed,
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
