"""The computed predicates: valid/1, what could be claimed without breaking a constraint; never/1, what is broken."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from casper.kb.errors import Undefined
from casper.kb.reasons.validity import valid_instances
from casper.kb.reasons.why_not import Violation
from casper.kb.store.model import Model
from casper.kb.terms.clauses import Indicator, is_auxiliary
from casper.kb.terms.terms import Compound, Term, Variable, as_term, predication
from casper.kb.terms.unification import unify
from casper.kb.top_down.answering import Answering


def own_predicates(model: Model) -> set[Indicator]:
    """The predicates that are defined, without those that only stand for goals inside clauses."""
    return {i for i in model.program.clauses if not is_auxiliary(i)}


def statement_predicates(model: Model, declared: Iterable[Indicator]) -> list[Indicator]:
    """The declared action statements; without a declaration, every stored predicate that has a rule."""
    own = own_predicates(model)
    derived = (i for i, found in model.program.clauses.items() if i in own and any(c.body for c in found))
    return list(declared) or [i for i in derived if model.keeps(i)]


def valid(
    wanted: Term, model: Model, declared: Iterable[Indicator], search: Callable[[], Answering]
) -> Iterator[Compound]:
    """The answers of ``valid(wanted)``; of a variable those of every action statement.

    Raises:
        Undefined: at the end, when it is undefined whether something else is valid.
    """
    if isinstance(wanted, Variable):
        predicates = statement_predicates(model, declared)
        patterns = [Compound([name, *(Variable(f"V{at}") for at in range(arity))]) for name, arity in predicates]
    else:
        patterns = [predication(wanted)] if isinstance(wanted, (str, tuple)) else []  # a number is no statement
    doubt: Undefined | None = None
    for pattern in patterns:
        if pattern.indicator in model.program.clauses:
            constraints = model.constraints  # which may list what follows: before the search begins
            try:
                for instance in valid_instances(pattern, search(), constraints):
                    yield Compound(("valid", as_term(instance)))
            except Undefined as mistake:
                doubt = doubt or mistake
    if doubt is not None:
        raise doubt


def broken(atom: Compound, violations: Iterable[Violation]) -> Iterator[Compound]:
    """The answers of never/1 that the atom can be: the constraints that the facts alone break.

    Raises:
        Undefined: at the end, when it is undefined whether some other constraint is broken.
    """
    doubts: dict[str, str] = {}
    for violation in violations:
        answer = Compound(("never", violation.sentence))
        if unify(atom, answer, {}) is not None:
            if not violation.doubt:
                doubts.pop(violation.sentence, None)
                yield answer
            else:
                doubts.setdefault(violation.sentence, str(violation))
    if doubts:
        raise Undefined(next(iter(doubts.values())))
