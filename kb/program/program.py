"""A program: clauses sorted into predicates and constraints, checked, and split into strata.

A predicate is *stored* when the fixpoint can list all its rows: every clause is range-restricted, nothing it needs is
situational (claim/1, did/2, what is offered from outside), and no recursion builds ever larger terms. Every other
predicate is answered top-down.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from itertools import chain
from typing import TypeAlias

from casper.kb.errors import ProgramError
from casper.kb.program.control import plain_clauses
from casper.kb.program.declarations import Moded
from casper.kb.program.listing import unlisted
from casper.kb.program.refusals import check_bound, check_computable, check_defined, check_own, checked_constraint
from casper.kb.program.strata import check_least, components_of, dependents, levels_of, needs, negative_circles
from casper.kb.relations.relation import Row
from casper.kb.terms.builtins import BUILTINS
from casper.kb.terms.clauses import DID, NOWHERE, SYSTEM, Clause, Indicator
from casper.kb.terms.origins import Origin, clause_behind
from casper.kb.terms.terms import Compound
from casper.kb.terms.unification import is_ground

Given: TypeAlias = dict[Row, Origin]


@dataclass(frozen=True)
class Program:
    """Clauses by predicate, in the author's order, with the analysis that evaluation needs.

    ``rules`` are the clauses that are more than a ground fact; ``given`` the rows of the ground facts, with the clause
    or block behind each (None: loaded in bulk); ``clauses`` what resolution needs: the rules, and of a predicate that
    is answered top-down its facts too. All three have every defined predicate as a key.
    """

    clauses: Mapping[Indicator, tuple[Clause, ...]]
    rules: Mapping[Indicator, tuple[Clause, ...]]
    given: dict[Indicator, Given]
    constraints: tuple[Clause, ...]
    strata: tuple[frozenset[Indicator], ...]  # of the stored predicates, lowest first
    situational: frozenset[Indicator]
    top_down: frozenset[Indicator]
    least: Mapping[Indicator, Moded] = field(default_factory=dict)
    circular: frozenset[Indicator] = frozenset()  # where negation runs in a circle; each circle is a stratum
    outside: frozenset[Indicator] = frozenset()  # what is asked of those that are offered from outside

    @cached_property
    def looks_back(self) -> bool:
        """Whether a rule or constraint asks what happened earlier."""
        written = chain(self.constraints, *self.rules.values())
        return any(literal.needed == DID for clause in written for literal in clause.body)


def analyse(
    clauses: Iterable[Clause],
    dynamic: Iterable[Indicator] = (),
    bulk: Mapping[Indicator, Iterable[Row]] | None = None,
    least: Mapping[Indicator, Moded] | None = None,
    offered: Collection[Indicator] = (),
) -> Program:
    """Sort and check the clauses.

    Args:
        clauses: facts, rules and constraints.
        dynamic: predicates that are defined even without a clause.
        bulk: rows of ground facts that no clause stands for; of a mapping the values are what is behind each.
        least: predicates with an argument that is kept least or greatest for each of the others.
        offered: predicates that others answer at the moment of asking, where the program names them without a clause.

    Raises:
        ProgramError: an undefined predicate, a redefined system predicate, a constraint without a sentence,
            a variable that nothing binds under a negation, a function that nothing computes, or an aggregate that is
            part of what it is worked out of (the circle is named).
    """
    predicates: dict[Indicator, list[Clause]] = {}
    for indicator in dynamic:
        check_own(indicator, NOWHERE)
        predicates[indicator] = []
    constraints: list[Clause] = []
    for clause in plain_clauses(clauses):
        if clause.head.functor == "never":
            constraints.append(checked_constraint(clause))
            continue
        check_own(clause.head.indicator, clause.place)
        predicates.setdefault(clause.head.indicator, []).append(clause)
    given: dict[Indicator, Given] = {i: _with_origins(rows) for i, rows in (bulk or {}).items()}
    for indicator in given:
        check_own(indicator, NOWHERE)
        predicates.setdefault(indicator, [])
    outside = _outside(predicates, constraints, offered, given)
    predicates.update({indicator: [] for indicator in outside})
    given.update({indicator: {} for indicator in outside})
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
            check_computable(literal)
            check_bound(literal, clause)
    moded = {i: m for i, m in (least or {}).items() if i in rules}
    split = _split(rules, moded, outside)
    resolved = dict(rules)
    for indicator in split.top_down:
        rows = given[indicator]
        loaded = (Compound((indicator[0], *row)) for row, behind in rows.items() if not isinstance(behind, Clause))
        resolved[indicator] = (*table[indicator], *(clause_behind(head, rows[head.args]) for head in loaded))
    return Program(resolved, rules, given, tuple(constraints), **vars(split), least=moded, outside=outside)


def _outside(
    predicates: Mapping[Indicator, list[Clause]],
    constraints: list[Clause],
    offered: Collection[Indicator],
    given: Mapping[Indicator, Given],
) -> frozenset[Indicator]:
    """Those of what is offered that the program names, as a condition or a declaration, and does not define itself."""
    wanted = {i for i in offered if not predicates.get(i) and not given.get(i)}
    if not wanted:
        return frozenset()
    asked = needs([*constraints, *(clause for found in predicates.values() for clause in found)])
    return frozenset(wanted & {*asked, *predicates})


def _with_origins(rows: Iterable[Row]) -> Given:
    return dict(rows) if isinstance(rows, Mapping) else dict.fromkeys(rows)


def is_given(clause: Clause) -> bool:
    """Whether a clause is a ground fact."""
    return not clause.body and is_ground(clause.head)


def _split(
    rules: Mapping[Indicator, tuple[Clause, ...]], least: Mapping[Indicator, Moded], outside: frozenset[Indicator]
) -> _Split:
    """The strata of the stored predicates, and how all others are answered."""
    groups = components_of(rules)
    levels = levels_of(rules, groups, least)
    check_least(rules, groups, least)
    circles = [group for group, _, _ in negative_circles(rules, groups)]
    situational = dependents(rules, {*SYSTEM, *outside}) | outside
    top_down = situational | unlisted(rules, groups, least)
    top_down |= dependents(rules, top_down | set(BUILTINS - rules.keys()))
    for name, arity in sorted(top_down & least.keys()):
        sentence = f"{name}/{arity} cannot keep one row for each key: its rows cannot all be listed"
        raise ProgramError(sentence)
    apart = [*circles, *(frozenset(group) for group in groups if any(i in least for i in group))]
    circle_of = {i: number for number, group in enumerate(apart, 1) for i in group}
    by_level: dict[tuple[int, int], list[Indicator]] = {}
    for indicator, level in levels.items():
        if indicator not in top_down:
            by_level.setdefault((level, circle_of.get(indicator, 0)), []).append(indicator)
    strata = tuple(frozenset(by_level[level]) for level in sorted(by_level))
    return _Split(strata, frozenset(situational), frozenset(top_down), frozenset(i for group in circles for i in group))


@dataclass(frozen=True)
class _Split:
    strata: tuple[frozenset[Indicator], ...]
    situational: frozenset[Indicator]
    top_down: frozenset[Indicator]
    circular: frozenset[Indicator]
