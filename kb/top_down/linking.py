"""Which predicate is answered how: looked up, resolved with its clauses, tabled, or computed by a built-in."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Any, TypeAlias

from casper.kb.errors import ProgramError, Undefined
from casper.kb.program.listing import is_range_restricted
from casper.kb.program.refusals import undefined_sentence
from casper.kb.relations.relation import Relation
from casper.kb.terms.builtins import BUILTINS
from casper.kb.terms.clauses import SYSTEM, Clause, Indicator, Literal
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.kb.terms.unification import is_ground, variables_of
from casper.kb.terms.unknown import closed
from casper.kb.top_down.builtins import COMPUTING, CONTROL, library
from casper.kb.top_down.compiled.code import CompiledClause, Pattern, Procedure
from casper.kb.top_down.lookups import Lookups
from casper.kb.top_down.planning import SizeOf, ordered
from casper.kb.top_down.recursion import tabled_of

Computed: TypeAlias = Callable[[Compound], Iterator[Compound]]
RESOLVED, TABLED, STORED, DOUBTFUL, BUILT_IN, ASKED, CONTROLLED, PROVIDED = range(8)


@dataclass(frozen=True, slots=True)
class Rows:
    """A computed predicate whose answers are the rows of a relation that is made for what is asked.

    Args:
        relation: from an atom to a relation that has every row it can be, the undefined ones among them.
        remark: on what a row rests, in a proof.
    """

    relation: Callable[[Compound], Relation]
    remark: str = "given from outside"

    def __call__(self, atom: Compound) -> Iterator[Compound]:
        """The rows that the atom can be.

        Raises:
            Undefined: after the last one, where another row that it can be is undefined.
        """
        relation = self.relation(atom)
        known = tuple(c for c, arg in enumerate(atom.args) if is_ground(arg))
        key = tuple([atom.args[c] for c in known])
        for row in list(relation.matching(known, key)):
            yield Compound((atom[0], *row))
        for row in relation.undefined.matching(known, key) if relation.undefined is not None else ():
            raise Undefined(f"{term_text(as_term(Compound((atom[0], *map(closed, row)))))} is undefined")


class Link:
    """How a predicate is answered, and what by."""

    __slots__ = ("how", "what")

    def __init__(self, how: int, what: Any) -> None:
        self.how, self.what = how, what


class Code:
    """The clauses of a program, compiled when they are first needed.

    Args:
        clauses: of every predicate that is resolved.
        finite: predicates whose rows could all be listed: the order of their conditions is the planner's.
        size_of: how many rows a predicate has, or may have.
        below: the code of a program that these clauses are added to: what it has compiled is compiled.
    """

    def __init__(
        self,
        clauses: Mapping[Indicator, Sequence[Clause]],
        finite: Collection[Indicator] = (),
        size_of: SizeOf = lambda _: 1,
        below: Code | None = None,
    ) -> None:
        self.clauses, self.finite, self.size_of, self.below = clauses, finite, size_of, below
        self._procedures: dict[Indicator, Procedure] = {}

    @cached_property
    def tabled(self) -> frozenset[Indicator]:
        """The predicates whose calls are tabled: all that recur without building terms."""
        return tabled_of(self.clauses) if self.below is None else self.below.tabled

    def extended(self, inner: Mapping[Indicator, Sequence[Clause]]) -> Code:
        """With the clauses of the goals inside a question; they stand for goals, and nothing else needs them."""
        finite = set(self.finite)
        if finite:
            for _ in inner:  # a goal inside a goal may come after it
                finite.update(i for i, found in inner.items() if all(_is_finite(clause, finite) for clause in found))
        return Code({**self.clauses, **inner}, finite, self.size_of, self)

    def procedure(self, indicator: Indicator) -> Procedure:
        """The compiled clauses of a predicate."""
        if self.below is not None and indicator in self.below.clauses:
            return self.below.procedure(indicator)
        found = self._procedures.get(indicator)
        if found is None:
            clauses = [CompiledClause(clause) for clause in self.clauses[indicator]]
            found = self._procedures[indicator] = Procedure(clauses, indicator[1])
            if indicator in self.finite and any(len(clause.clause.body) > 1 for clause in clauses):
                found.fitted = partial(self._fitted, indicator)
        return found

    def _fitted(self, indicator: Indicator, pattern: Pattern) -> Procedure:
        clauses = self.clauses[indicator]
        return Procedure([CompiledClause(c, self.body(c, pattern)) for c in clauses], indicator[1])

    def query(self, body: Sequence[Literal]) -> list[Literal]:
        """A question's conditions in the order in which they are taken."""
        if len(body) > 1 and all(x.is_comparison or x.needed in self.finite for x in body):
            return ordered(body, (), self.size_of)
        return list(body)

    def body(self, clause: Clause, pattern: Pattern) -> list[Literal]:
        """A clause's conditions in the order in which they are taken, when those arguments are known."""
        if clause.head.indicator not in self.finite:
            return list(clause.body)
        known = variables_of(*(arg for arg, is_known in zip(clause.head.args, pattern) if is_known))
        return ordered(clause.body, known, self.size_of)


def _is_finite(clause: Clause, finite: Collection[Indicator]) -> bool:
    return is_range_restricted(clause) and all(x.is_comparison or x.needed in finite for x in clause.body)


class Links(dict[Indicator, Link]):
    """The link of every predicate a search comes to; a program's own definition wins over a built-in."""

    def __init__(
        self, relations: Mapping[Indicator, Relation], code: Code, computed: Mapping[Indicator, Computed]
    ) -> None:
        super().__init__()
        self.relations, self.code, self.computed = relations, code, computed

    @cached_property
    def lookups(self) -> Lookups:
        """How goals inside goals that ask for stored rows alone are looked up."""
        return Lookups(self.relations)

    def __missing__(self, indicator: Indicator) -> Link:
        found = self[indicator] = self._found(indicator)
        return found

    def _found(self, indicator: Indicator) -> Link:
        relation = self.relations.get(indicator)
        if relation is not None:
            return Link(STORED if relation.undefined is None else DOUBTFUL, relation)
        if indicator in self.computed:
            computed = self.computed[indicator]
            return Link(PROVIDED if isinstance(computed, Rows) else ASKED, computed)
        if indicator in self.code.clauses:
            return Link(TABLED if indicator in self.code.tabled else RESOLVED, self.code.procedure(indicator))
        if indicator in CONTROL:
            return Link(CONTROLLED, CONTROL[indicator])
        if indicator in COMPUTING:
            return Link(BUILT_IN, COMPUTING[indicator])
        if indicator in library():
            return Link(RESOLVED, library()[indicator])
        if indicator in SYSTEM:
            return Link(RESOLVED, Procedure((), indicator[1]))
        raise ProgramError(undefined_sentence(indicator, (*self.code.clauses, *BUILTINS)))
