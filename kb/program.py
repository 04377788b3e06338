"""A program: clauses sorted into predicates and constraints, checked, and split into strata.

A predicate is *stored* when the fixpoint can list all its rows: every clause is range-restricted, nothing it needs is
situational (claim/1, did/2), and no recursion builds ever larger terms. Every other predicate is answered top-down.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cached_property
from itertools import chain
from typing import TypeAlias

from casper.kb.clauses import COMPARISONS, NOWHERE, Clause, Literal
from casper.kb.errors import Place, ProgramError
from casper.kb.relation import Row
from casper.kb.terms import Compound, Variable, is_ground, variables_of

Indicator: TypeAlias = tuple[str, int]
Given: TypeAlias = dict[Row, Clause | None]
DID: Indicator = ("did", 2)
SITUATION: tuple[Indicator, ...] = (("claim", 1), DID)
COMPUTED: tuple[Indicator, ...] = (("valid", 1), ("never", 1))
SYSTEM: tuple[Indicator, ...] = (*SITUATION, *COMPUTED)


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
        _check_own(indicator, NOWHERE)
        predicates[indicator] = []
    constraints: list[Clause] = []
    for clause in clauses:
        if clause.head.functor == "never":
            constraints.append(_checked_constraint(clause))
            continue
        _check_own(clause.head.indicator, clause.place)
        predicates.setdefault(clause.head.indicator, []).append(clause)
    given: dict[Indicator, Given] = {i: dict.fromkeys(rows) for i, rows in (bulk or {}).items()}
    for indicator in given:
        _check_own(indicator, NOWHERE)
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
            _check_bound(literal, clause)
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
    levels = _levels(rules)
    situational = _dependents(rules, set(SYSTEM))
    top_down = situational | _unlisted(rules)
    top_down = _dependents(rules, top_down) | top_down
    heights = sorted({level for indicator, level in levels.items() if indicator not in top_down})
    strata = tuple(frozenset(i for i, at in levels.items() if at == h and i not in top_down) for h in heights)
    return strata, frozenset(situational), frozenset(top_down)


def _check_own(indicator: Indicator, place: Place) -> None:
    """Refuse to define what the system defines."""
    name, arity = indicator
    if indicator in SYSTEM or (name in COMPARISONS and arity == 2):
        sentence = f"{name}/{arity} is defined by the system; choose another name"
        raise ProgramError(sentence, place if place.line else None)


def check_defined(literal: Literal, known: Collection[Indicator]) -> None:
    """Refuse a condition whose predicate nobody defines, with the nearest name that somebody does.

    Raises:
        ProgramError: naming the predicate, its place, and what may have been meant.
    """
    if literal.is_comparison or literal.atom.indicator in SYSTEM:
        return
    if literal.atom.indicator not in known:
        place = literal.place if literal.place.line else None
        raise ProgramError(undefined_sentence(literal.atom.indicator, known), place)


def undefined_sentence(indicator: Indicator, known: Collection[Indicator]) -> str:
    """The sentence for a predicate that is not there: another arity, a likely misspelling, or what to do."""
    name, arity = indicator
    arities = sorted(a for n, a in known if n == name)
    if arities:
        noun = "argument" if arities == [1] else "arguments"
        return f"{name} takes {' or '.join(map(str, arities))} {noun}, not {arity}"
    close = get_close_matches(name, sorted({n for n, _ in known}), n=1)
    hint = f"did you mean {close[0]}?" if close else "add a fact or a rule for it"
    return f"nothing defines {name}/{arity}; {hint}"


def _checked_constraint(clause: Clause) -> Clause:
    if not (clause.is_constraint and isinstance(clause.head[1], str)):
        raise ProgramError('a constraint starts with its sentence: never("…") :- …', clause.place)
    if not clause.body:
        raise ProgramError("this constraint is always broken; give it a body", clause.place)
    return clause


def _check_bound(literal: Literal, clause: Clause) -> None:
    """A negated condition's variables must be bound by something: otherwise it asks for all there is not."""
    if not literal.negated or literal.is_comparison:
        return
    binders = [x.atom for x in clause.body if not x.negated]
    bound = set(variables_of(clause.head, *binders))
    for variable in literal.variables():
        if variable not in bound and not variable.is_anonymous:
            sentence = f"{variable.name} stands only under a negation; bind it by a condition, or write _"
            raise ProgramError(sentence, literal.place)


def _dependents(table: Mapping[Indicator, tuple[Clause, ...]], roots: set[Indicator]) -> set[Indicator]:
    """Every defined predicate that needs one of the roots, directly or not."""
    reached: set[Indicator] = set()
    grown = True
    while grown:
        grown = False
        for indicator, clauses in table.items():
            if indicator not in reached and any(n in roots or n in reached for n in _needs(clauses)):
                reached.add(indicator)
                grown = True
    return reached


def _needs(clauses: Iterable[Clause]) -> Iterator[Indicator]:
    return (x.atom.indicator for clause in clauses for x in clause.body if not x.is_comparison)


def _unlisted(table: Mapping[Indicator, tuple[Clause, ...]]) -> set[Indicator]:
    """Predicates whose rows cannot all be listed: an unbound head variable, or recursion that builds terms."""
    found = {i for i, clauses in table.items() if not all(is_range_restricted(c) for c in clauses)}
    for indicator, clauses in table.items():
        builds = any(_builds(c.head) or any(_computes(x) for x in c.body) for c in clauses)
        if builds and indicator in _dependents(table, {indicator}):
            found.add(indicator)
    return found


def _builds(head: Compound) -> bool:
    return any(isinstance(arg, Compound) and not is_ground(arg) for arg in head.args)


def _computes(literal: Literal) -> bool:
    """Whether a condition can make a term that stands nowhere else: ``N is M + 1``, ``Y = s(X)``."""
    return literal.is_comparison and (literal.atom[0] == "is" or (literal.atom[0] == "=" and _builds(literal.atom)))


def is_range_restricted(clause: Clause) -> bool:
    """Whether positive conditions bind every variable of the head, of the comparisons and of the negations."""
    bound: set[Variable] = set()
    for literal in clause.body:
        if not literal.negated and not literal.is_comparison:
            bound.update(literal.variables())
    grown = True
    while grown:
        grown = False
        for literal in clause.body:
            if literal.negated or not literal.is_comparison or literal.atom[0] not in ("=", "is"):
                continue
            left, right = set(variables_of(literal.atom[1])), set(variables_of(literal.atom[2]))
            new = (left if right <= bound else set()) | (right if left <= bound and literal.atom[0] == "=" else set())
            if not new <= bound:
                bound |= new
                grown = True
    needed = set(variables_of(clause.head))
    for literal in clause.body:
        if literal.is_comparison or literal.negated:
            needed.update(v for v in literal.variables() if literal.is_comparison or not v.is_anonymous)
    return needed <= bound


def _levels(table: Mapping[Indicator, tuple[Clause, ...]]) -> dict[Indicator, int]:
    """The stratum of every predicate: at least that of what it needs, above that of what it negates."""
    levels = dict.fromkeys(table, 0)
    for _ in range(len(table) + 1):
        changed = False
        for indicator, clauses in table.items():
            for literal in (x for clause in clauses for x in clause.body):
                below = levels.get(literal.atom.indicator)
                if below is not None and levels[indicator] < below + literal.negated:
                    levels[indicator] = below + literal.negated
                    changed = True
        if not changed:
            return levels
    raise _negative_cycle(table)


def _negative_cycle(table: Mapping[Indicator, tuple[Clause, ...]]) -> ProgramError:
    import networkx as nx  # only a program that is refused needs it

    graph: nx.DiGraph = nx.DiGraph()
    for indicator, clauses in table.items():
        graph.add_edges_from((indicator, needed) for needed in _needs(clauses))
    for indicator, clauses in table.items():
        for literal in (x for clause in clauses for x in clause.body if x.negated and not x.is_comparison):
            negated = literal.atom.indicator
            if negated in graph and nx.has_path(graph, negated, indicator):
                cycle = [indicator, *nx.shortest_path(graph, negated, indicator)]
                names = " needs ".join(f"{'not ' if at == 1 else ''}{n}/{a}" for at, (n, a) in enumerate(cycle))
                return ProgramError(f"negation runs in a circle: {names}; break it", literal.place)
    raise AssertionError("levels diverge only through a negation")
