"""Validity: a statement is valid when it is provable and breaks no constraint when it is claimed (paper III-F).

Unknown parts of a statement are logic variables: it is acceptable when some value makes it valid, and a part for
which only one value does is filled in (what the paper's SWRL rules were for).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from casper.kb.errors import BudgetExceeded, Undefined
from casper.kb.reasons.constraints import Constraints
from casper.kb.reasons.printing import verdict_lines
from casper.kb.reasons.says import SILENT, Words
from casper.kb.reasons.why_not import Refusal
from casper.kb.terms.clauses import Literal
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, as_term
from casper.kb.terms.unification import substitute
from casper.kb.terms.unknown import DOUBT
from casper.kb.text.lines import Line, Shown, one_line, text_of
from casper.kb.top_down.solve import Solver

_FILL_LIMIT = 1000  # instances looked at before a part is given up as open


@dataclass(frozen=True, slots=True)
class Verdict(Shown):
    """The outcome of a verification.

    ``valid`` is None when it is undefined or the search ran out of its budget (``remark`` says which). ``completed`` is
    the statement with every part filled in for which only one value is valid; ``refusal`` says why not.
    """

    statement: Compound
    valid: bool | None
    completed: Compound
    refusal: Refusal | None = None
    remark: str = ""
    words: Words = field(default=SILENT, compare=False, repr=False)  # in which it is told

    @property
    def reasons(self) -> tuple[str, ...]:
        """Why the statement is not valid, one sentence each; empty when it is."""
        if self.refusal is not None:
            return self.refusal.reasons
        return (self.remark,) if self.remark else ()

    def lines(self) -> Iterator[Line]:
        """What a person is shown."""
        return verdict_lines(self.statement, self.valid, self.completed, self.reasons, self.words)

    def __str__(self) -> str:
        return text_of(self.lines())

    def __repr__(self) -> str:
        word = "unknown" if self.valid is None else "valid" if self.valid else "not valid"
        return one_line(f"Verdict: {term_text(as_term(self.statement))} is {word}")


def valid_instances(statement: Compound, solver: Solver, constraints: Constraints) -> Iterator[Compound]:
    """Every valid instance of the statement, lazily.

    Raises:
        Undefined: at the end, when it is undefined of some other instance whether it is valid.
    """
    seen: set[Compound] = set()
    doubts: dict[Compound, str] = {}
    for solution in solver.possible([Literal(statement)]):
        instance: Compound = substitute(statement, solution)
        if instance in seen:
            continue
        if DOUBT not in solution:
            seen.add(instance)
        try:
            broken = next(constraints.broken_by(instance, solver), None) is not None
        except Undefined as doubt:
            doubts.setdefault(instance, doubt.sentence)
            continue
        if DOUBT in solution and not broken:
            doubts.setdefault(instance, str(solution[DOUBT]))
        elif not broken:
            doubts.pop(instance, None)
            yield instance
        else:
            doubts.pop(instance, None)
    if doubts:
        raise Undefined(next(iter(doubts.values())))


def verify(statement: Compound, solver: Solver, constraints: Constraints) -> Verdict:
    """Judge one statement; an invalid one comes back without its refusal, which `KnowledgeBase.verify` adds.

    Unknown is not no: a search that outlives its budget before it finds a valid instance gives ``valid=None``, and so
    does a statement that is undefined.
    """
    completed: Compound | None = None
    try:
        for number, instance in enumerate(valid_instances(statement, solver, constraints)):
            completed = instance if completed is None else _agreement(statement, completed, instance)
            if completed == statement or number >= _FILL_LIMIT:
                completed = statement
                break
    except (BudgetExceeded, Undefined) as mistake:
        if completed is not None:  # one value does; whether another would too is what the search did not tell
            return Verdict(statement, True, statement)
        return Verdict(statement, None, statement, None, mistake.sentence)
    if completed is None:
        return Verdict(statement, False, statement)
    return Verdict(statement, True, completed)


def _agreement(statement: Term, left: Term, right: Term) -> Term:
    """What two instances agree on, with the statement's own unknown parts where they do not."""
    if left == right:
        return left
    if isinstance(statement, Compound) and isinstance(left, Compound) and isinstance(right, Compound):
        return Compound([_agreement(s, a, b) for s, a, b in zip(statement, left, right)])
    return statement
