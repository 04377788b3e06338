"""Why something does not hold: for each clause that could give it, the fewest conditions that fail.

Conditions are taken in the author's order, under the bindings that come nearest: of all ways to satisfy a body, one
that leaves the fewest conditions unsatisfied.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

from casper.kb.errors import BudgetExceeded, ProgramError
from casper.kb.reasons.counting import told
from casper.kb.reasons.says import SILENT, Words
from casper.kb.reasons.wording import failure_sentence
from casper.kb.terms.clauses import Clause, Literal
from casper.kb.terms.comparison import compare
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.kb.terms.unification import Bindings, is_ground, substitute, unify
from casper.kb.terms.values.arithmetic import EvaluationFailed
from casper.kb.text.lines import Shown, one_line
from casper.kb.top_down.solve import Solver


@dataclass(frozen=True, slots=True)
class Attempt:
    """One clause that could have given the statement, and its conditions that fail (instantiated, author's order).

    Without any, the search for them stopped at its budget.
    """

    clause: Clause
    failed: tuple[Literal, ...]


@dataclass(frozen=True, slots=True)
class Violation:
    """A broken constraint: its sentence, the clause of never/1, and the instantiated conditions that clash.

    With a ``doubt`` it is undefined whether it is broken, because of that.
    """

    sentence: str
    clause: Clause
    clash: tuple[Literal, ...]
    doubt: str = ""

    def __str__(self) -> str:
        return f'whether this is broken is undefined: "{self.sentence}" ({self.doubt})' if self.doubt else self.sentence


@dataclass(frozen=True, slots=True)
class Refusal(Shown):
    """Why a statement does not hold (or is not valid); ``str()`` is one sentence a line."""

    statement: Compound
    attempts: tuple[Attempt, ...] = ()
    violations: tuple[Violation, ...] = ()
    undefined: str = ""
    provable: bool = False  # then only the violations stand against it
    doubt: str = ""  # why the statement is undefined, rather than false
    words: Words = field(default=SILENT, compare=False, repr=False)  # in which it is told

    @property
    def reasons(self) -> tuple[str, ...]:
        """The sentences: failed conditions of the nearest clauses first, then broken constraints."""
        sentences = [sentence for sentence in (self.undefined, self.doubt) if sentence]
        if self.doubt:
            return (*sentences, *map(self._broken, self.violations))
        fewest = min((len(a.failed) for a in self.attempts if a.failed), default=0)
        for attempt in self.attempts:
            if len(attempt.failed) == fewest:
                sentences.extend(failure_sentence(literal, self.words) for literal in attempt.failed)
        sentences.extend(map(self._broken, self.violations))
        if not sentences and self.attempts:
            sentences.append("the search for a reason stopped at its budget: which condition fails is unknown")
        if not sentences:
            sentences.append(self._nothing_gives())
        return tuple(dict.fromkeys(sentences))

    def _broken(self, violation: Violation) -> str:
        return str(replace(violation, sentence=self.words.constraint(violation.sentence)))

    def _nothing_gives(self) -> str:
        """That there is nothing to go by: what the author says of what does not hold, if anything."""
        said = self.words.sentence(self.statement, denied=True) if self.words else None
        return said or self.words.phrase("nothing gives", term_text(as_term(self.statement)))

    def __str__(self) -> str:
        return "\n".join(self.reasons)

    def __repr__(self) -> str:
        return one_line(f"Refusal of {term_text(as_term(self.statement))}: {'; '.join(self.reasons)}")


def attempts(statement: Compound, clauses: Sequence[Clause], solver: Solver) -> Iterator[Attempt]:
    """For every rule whose head the statement can be, its nearest attempt; nothing for a statement that holds.

    Where the nearest is too far to search for, the first condition that fails stands for it. What is undefined is not
    said to fail, unless nothing else stands in the way.
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
            limited = replace(solver, steps=0, budget=solver.budget // share, floundering_fails=True, doubts_hold=True)
            try:
                failed = search(body, bindings, limited) or search(body, bindings, replace(limited, doubts_hold=False))
            except (BudgetExceeded, RecursionError):
                continue
            yield Attempt(clause, failed)
            break
        else:
            yield Attempt(clause, ())


def settled(clause: Clause, statement: Compound, solver: Solver) -> tuple[Literal, ...] | None:
    """The failing conditions of a clause whose head alone settles every variable: nothing needs to be searched.

    Empty where the head does not fit; None where some variable, or a predicate answered top-down, is left to a search.
    """
    bindings = unify(clause.head, statement, {})
    if bindings is None or not clause.body:
        return ()
    failed = []
    for literal in clause.body:
        atom = substitute(literal.atom, bindings)
        if not is_ground(atom) or literal.is_aggregate:
            return None
        if literal.is_comparison:
            try:
                holds = compare(literal, bindings) is not None
            except EvaluationFailed:
                return None
        else:
            relation = solver.relations.get(atom.indicator)
            if relation is None or relation.undefined is not None:
                return None
            holds = (atom.args in relation) != literal.negated
        if not holds:
            failed.append(literal.instance(bindings))
    return tuple(failed) or None


def nearest(body: Sequence[Literal], bindings: Bindings, solver: Solver) -> tuple[Literal, ...]:
    """The fewest conditions that must be given up for the rest of the body to hold, instantiated."""
    for allowed in range(len(body) + 1):
        found = next(_give_up(list(body), bindings, allowed, solver), None)
        if found is not None:
            given_up, solution = found
            kept = [literal for literal in body if any(literal is x for x in given_up)]
            failed = [x for x in kept if _fails(x, solution, solver)]
            return tuple(told(x, body, solution, solver) for x in failed or kept)
    return tuple(body)


def first_failing(body: Sequence[Literal], bindings: Bindings, solver: Solver) -> tuple[Literal, ...]:
    """The first condition, in the author's order, that fails however those before it are satisfied, instantiated."""
    held: list[Literal] = []
    for literal in body:
        if next(solver.accepted([*held, literal], bindings), None) is not None:
            held.append(literal)
            continue
        before = next(solver.accepted(held, bindings))
        if _fails(literal, before, solver):
            return (told(literal, body, before, solver),)
    return ()


def _fails(literal: Literal, bindings: Bindings, solver: Solver) -> bool:
    """Whether a condition that was given up does fail; one that only lost what binds it is undecided."""
    if solver.next_of([literal], bindings) is None:
        return False
    try:
        search = replace(solver, floundering_fails=False)
        return not any(search.accepts(found) for found in search.answers(literal, bindings))
    except ProgramError:
        return False


def _give_up(
    body: list[Literal], bindings: Bindings, allowed: int, solver: Solver
) -> Iterator[tuple[list[Literal], Bindings]]:
    """Ways to satisfy the body but for at most ``allowed`` conditions: those given up, with the bindings."""
    if not body:
        yield [], bindings
        return
    ready = solver.next_of(body, bindings)
    at = 0 if ready is None else ready
    literal, rest = body[at], body[:at] + body[at + 1 :]
    if ready is not None:
        for extended in filter(solver.accepts, solver.answers(literal, bindings)):
            yield from _give_up(rest, extended, allowed, solver)
    if allowed:
        for given_up, solution in _give_up(rest, bindings, allowed - 1, solver):
            yield [literal, *given_up], solution
