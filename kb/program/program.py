"""A program: clauses sorted into predicates and constraints, checked, and split into strata.

A predicate is *stored* when the fixpoint can list all its rows: every clause is range-restricted, nothing it needs is
situational (claim/1, did/2), and no recursion builds ever larger terms. Every other predicate is answered top-down.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import chain
from typing import TypeAlias

from casper.kb.program.listing import unlisted
from casper.kb.program.refusals import check_bound, check_defined, check_own, checked_constraint
from casper.kb.program.strata import dependents, levels_of
from casper.kb.relations.relation import Row
from casper.kb.terms.builtins import BUILTINS
from casper.kb.terms.clauses import DID, NOWHERE, SYSTEM, Clause, Indicator
from casper.kb.terms.terms import Compound
from casper.kb.terms.unification import is_ground

Given: TypeAlias = dict[Row, Clause | None]


@dataclass(frozen=True)
class Program:
    """Clauses by predicate, in the author's order, with the analysis that evaluation needs.

    ``rules`` are the clauses that are more than a ground fact; ``given`` the rows of the ground facts, with the clause
    behind each (None: loaded in bulk); ``clauses`` what resolution needs: the rules, and of a predicate that is
    answered top-down its facts too. All three have every defined predicate as a key.
    """

    clauses: Mapping[Indicator, tuple[Clause, ...]]
    rules: Mapping[Indicator, tuple[Clause, ...]]
    given: dict[Indicator, Given]
    constraints: tuple[Clause, ...]
    strata: tuple[frozenset[Indicator], ...]  # of the stored predicates, lowest first
    situational: frozenset[Indicator]
    top_down: frozenset[Indicator]

    @cached_property
    def looks_back(self) -> bool:
        """Whether a rule or constraint asks what happened earlier."""
        written = chain(self.constraints, *self.rules.values())
        return any(literal.atom.indicator == DID for clause in written for literal in clause.body)


def analyse(
    clauses: Iterable[Clause], dynamic: Iterable[Indicator] = (), bulk: Mapping[Indicator, Iterable[Row]] | None = None
) -> Program:
    """Sort and check the clauses.

    Args:
        clauses: facts, rules and constraints.
        dynamic: predicates that are defined even without a clause.
        bulk: rows of ground facts that no clause stands for.

    Raises:
        ProgramError: an undefined predicate, a redefined system predicate, a constraint without a sentence,
            a variable that nothing binds under a negation, or negation through recursion (the cycle is named).
    """
    predicates: dict[Indicator, list[Clause]] = {}
    for indicator in dynamic:
        check_own(indicator, NOWHERE)
        predicates[indicator] = []
    constraints: list[Clause] = []
    for clause in clauses:
        if clause.head.functor == "never":
            constraints.append(checked_constraint(clause))
            continue
        check_own(clause.head.indicator, clause.place)
        predicates.setdefault(clause.head.indicator, []).append(clause)
    given: dict[Indicator, Given] = {i: dict.fromkeys(rows) for i, rows in (bulk or {}).items()}
    for indicator in given:
        check_own(indicator, NOWHERE)
        predicates.setdefault(indicator, [])
    table = {indicator: tuple(found) for indicator, found in predicates.items()}
    rules = {indicator: tuple(c for c in found if not is_given(c)) for indicator, found in table.items()}
    for indicator, found in table.items():
        rows = given.setdefault(indicator, {})
        for clause in found:
            if is_given(clause):
                rows.setdefault(clause.head.args, clause)
    for clause in (*(c for found in rules.values() for c in found), *constraints):
        for literal in clause.body:
            check_defined(literal, table)
            check_bound(literal, clause)
    strata, situational, top_down = _split(rules)
    resolved = dict(rules)
    for indicator in top_down:
        loaded = (Clause(Compound((indicator[0], *row))) for row, clause in given[indicator].items() if clause is None)
        resolved[indicator] = (*table[indicator], *loaded)
    return Program(resolved, rules, given, tuple(constraints), strata, situational, top_down)


def is_given(clause: Clause) -> bool:
    """Whether a clause is a ground fact."""
    return not clause.body and is_ground(clause.head)


def _split(
    rules: Mapping[Indicator, tuple[Clause, ...]],
) -> tuple[tuple[frozenset[Indicator], ...], frozenset[Indicator], frozenset[Indicator]]:
    """The strata of the stored predicates, the situational predicates, and all that are answered top-down."""
    levels = levels_of(rules)
    situational = dependents(rules, set(SYSTEM))
    top_down = situational | unlisted(rules) | dependents(rules, set(BUILTINS - rules.keys()))
    top_down = dependents(rules, top_down) | top_down
    heights = sorted({level for indicator, level in levels.items() if indicator not in top_down})
    strata = tuple(frozenset(i for i, at in levels.items() if at == h and i not in top_down) for h in heights)
    return strata, frozenset(situational), frozenset(top_down)
