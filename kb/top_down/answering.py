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
from casper.kb.terms.terms import Variable
from casper.kb.terms.unification import Bindings, substitute
from casper.kb.terms.unknown import DOUBT
from casper.kb.terms.values.arithmetic import EvaluationFailed
from casper.kb.top_down.compiled.code import NotCarried
from casper.kb.top_down.linking import Code
from casper.kb.top_down.plain import PlainSolver
from casper.kb.top_down.search import Search, names_of

_UNSETTLED = (NotCarried, EvaluationFailed, Undefined)


@dataclass
class Answering(PlainSolver):
    """A solver that answers by the machine where it can.

    Args:
        code: the compiled form of the clauses, which searches share.
        listed: gives the same search over everything that can be listed, where only facts are at hand.
    """

    code: Code | None = None
    listed: Callable[[], Answering] | None = None
    inner: Mapping[Indicator, tuple[Clause, ...]] = field(default_factory=dict)

    def possible(self, body: Sequence[Literal], bindings: Bindings | None = None, depth: int = 0) -> Iterator[Bindings]:
        """As `solve`, with the doubtful solutions among the others; a solution may come twice."""
        given = {} if bindings is None else bindings
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
        asked = body if self.code is None else self.code.query(body)
        columns = {name: at for at, name in enumerate(names_of(asked))}
        wanted = [columns.get(name, -1) for name in names]
        search = self._search()
        try:
            for values, certain in search.found(asked, {}):
                if values is None or not certain:
                    break
                yield tuple([name if at < 0 else values[at] for at, name in zip(wanted, names)]), ""
            else:
                return
        except _UNSETTLED:
            pass
        finally:
            self.steps, self.code = search.steps, search.code
        for solution in self.plain().possible(body):
            doubt = str(solution[DOUBT]) or "it is undefined" if DOUBT in solution else ""
            yield tuple([substitute(name, solution) for name in names]), doubt

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
        return replace(super().over(relations, floundering_fails=floundering_fails), listed=None)

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
