"""Why something does not hold: for each clause that could give it, the fewest conditions that fail.

Conditions are taken in the author's order, under the bindings that come nearest: of all ways to satisfy a body, one
that leaves the fewest conditions unsatisfied.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from casper.kb.errors import BudgetExceeded, ProgramError
from casper.kb.reasons.wording import failure_sentence
from casper.kb.terms.clauses import Clause, Literal
from casper.kb.terms.comparison import compare
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.kb.terms.unification import Bindings, is_ground, substitute, unify
from casper.kb.top_down.search import Search
from casper.kb.top_down.solve import next_ready


@dataclass(frozen=True, slots=True)
class Attempt:
    """One clause that could have given the statement, and its conditions that fail (instantiated, author's order).

    Without any, the search for them stopped at its budget.
    """

    clause: Clause
    failed: tuple[Literal, ...]


@dataclass(frozen=True, slots=True)
class Violation:
    """A broken constraint: its sentence, the clause of never/1, and the instantiated conditions that clash."""

    sentence: str
    clause: Clause
    clash: tuple[Literal, ...]


@dataclass(frozen=True, slots=True)
class Refusal:
    """Why a statement does not hold (or is not valid); ``str()`` is one sentence a line."""

    statement: Compound
    attempts: tuple[Attempt, ...] = ()
    violations: tuple[Violation, ...] = ()
    undefined: str = ""
    provable: bool = False  # then only the violations stand against it

    @property
    def reasons(self) -> tuple[str, ...]:
        """The sentences: failed conditions of the nearest clauses first, then broken constraints."""
        sentences = [self.undefined] if self.undefined else []
        fewest = min((len(a.failed) for a in self.attempts if a.failed), default=0)
        for attempt in self.attempts:
            if len(attempt.failed) == fewest:
                sentences.extend(failure_sentence(literal) for literal in attempt.failed)
        sentences.extend(v.sentence for v in self.violations)
        if not sentences and self.attempts:
            sentences.append("the search for a reason stopped at its budget: which condition fails is unknown")
        if not sentences:
            sentences.append(f"no fact or rule gives {term_text(as_term(self.statement))}")
        return tuple(dict.fromkeys(sentences))

    def __str__(self) -> str:
        return "\n".join(self.reasons)


def attempts(statement: Compound, clauses: Sequence[Clause], solver: Search) -> Iterator[Attempt]:
    """For every rule whose head the statement can be, its nearest attempt; nothing for a statement that holds.

    Where the nearest is too far to search for, the first condition that fails stands for it.
    """
    for clause in clauses:
        plain = settled(clause, statement, solver)
        if plain is not None:
            if plain:
                yield Attempt(clause, plain)
            continue
        head, body = solver.fresh(clause)
        bindings = unify(head, statement, {})
        if bindings is None or not body:
            continue
        for search, share in ((nearest, 10), (first_failing, 1)):
            limited = replace(solver, steps=0, budget=solver.budget // share, floundering_fails=True)
            try:
                failed = search(body, bindings, limited)
            except (BudgetExceeded, RecursionError):
                continue
            yield Attempt(clause, failed)
            break
        else:
            yield Attempt(clause, ())


def settled(clause: Clause, statement: Compound, solver: Search) -> tuple[Literal, ...] | None:
    """The failing conditions of a clause whose head alone settles every variable: nothing needs to be searched.

    Empty where the head does not fit; None where some variable, or a predicate answered top-down, is left to a search.
    """
    bindings = unify(clause.head, statement, {})
    if bindings is None or not clause.body:
        return ()
    failed = []
    for literal in clause.body:
        atom = substitute(literal.atom, bindings)
        if not is_ground(atom):
            return None
        if literal.is_comparison:
            holds = compare(literal, bindings) is not None
        else:
            relation = solver.relations.get(atom.indicator)
            if relation is None:
                return None
            holds = (atom.args in relation) != literal.negated
        if not holds:
            failed.append(Literal(atom, literal.negated, literal.place))
    return tuple(failed) or None


def nearest(body: Sequence[Literal], bindings: Bindings, solver: Search) -> tuple[Literal, ...]:
    """The fewest conditions that must be given up for the rest of the body to hold, instantiated."""
    for allowed in range(len(body) + 1):
        found = next(_give_up(list(body), bindings, allowed, solver), None)
        if found is not None:
            given_up, solution = found
            kept = [literal for literal in body if any(literal is x for x in given_up)]
            failed = [x for x in kept if _fails(x, solution, solver)]
            return tuple(Literal(substitute(x.atom, solution), x.negated, x.place) for x in failed or kept)
    return tuple(body)


def first_failing(body: Sequence[Literal], bindings: Bindings, solver: Search) -> tuple[Literal, ...]:
    """The first condition, in the author's order, that fails however those before it are satisfied, instantiated."""
    held: list[Literal] = []
    for literal in body:
        if next(solver.solve([*held, literal], bindings), None) is not None:
            held.append(literal)
            continue
        before = next(solver.solve(held, bindings))
        if _fails(literal, before, solver):
            return (Literal(substitute(literal.atom, before), literal.negated, literal.place),)
    return tuple(body)


def _fails(literal: Literal, bindings: Bindings, solver: Search) -> bool:
    """Whether a condition that was given up does fail; one that only lost what binds it is undecided."""
    if next_ready([literal], bindings) is None:
        return False
    try:
        return next(replace(solver, floundering_fails=False).answers(literal, bindings), None) is None
    except ProgramError:
        return False


def _give_up(
    body: list[Literal], bindings: Bindings, allowed: int, solver: Search
) -> Iterator[tuple[list[Literal], Bindings]]:
    """Ways to satisfy the body but for at most ``allowed`` conditions: those given up, with the bindings."""
    if not body:
        yield [], bindings
        return
    ready = next_ready(body, bindings)
    at = 0 if ready is None else ready
    literal, rest = body[at], body[:at] + body[at + 1 :]
    if ready is not None:
        for extended in solver.answers(literal, bindings):
            yield from _give_up(rest, extended, allowed, solver)
    if allowed:
        for given_up, solution in _give_up(rest, bindings, allowed - 1, solver):
            yield [literal, *given_up], solution
