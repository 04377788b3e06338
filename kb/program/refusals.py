"""What no clause may say: a name of the system's, an undefined condition, a variable only under a negation."""

from __future__ import annotations

from collections.abc import Collection
from difflib import get_close_matches

from casper.kb.errors import Place, ProgramError
from casper.kb.terms.builtins import BUILTINS, CONTROL
from casper.kb.terms.clauses import SYSTEM, Clause, Indicator, Literal
from casper.kb.terms.syntax import COMPARISONS
from casper.kb.terms.unification import variables_of


def check_own(indicator: Indicator, place: Place) -> None:
    """Refuse to define what the system defines."""
    name, arity = indicator
    if indicator in SYSTEM or indicator in CONTROL or (name in COMPARISONS and arity == 2):
        sentence = f"{name}/{arity} is defined by the system; choose another name"
        raise ProgramError(sentence, place if place.line else None)


def check_defined(literal: Literal, known: Collection[Indicator]) -> None:
    """Refuse a condition whose predicate nobody defines, with the nearest name that somebody does.

    Raises:
        ProgramError: naming the predicate, its place, and what may have been meant.
    """
    if literal.is_comparison or literal.atom.indicator in SYSTEM:
        return
    if literal.atom.indicator not in known and literal.atom.indicator not in BUILTINS:
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


def checked_constraint(clause: Clause) -> Clause:
    """The clause of never/1 itself, once it has a sentence and something that can break it."""
    if not (clause.is_constraint and isinstance(clause.head[1], str)):
        raise ProgramError('a constraint starts with its sentence: never("…") :- …', clause.place)
    if not clause.body:
        raise ProgramError("this constraint is always broken; give it a body", clause.place)
    return clause


def check_bound(literal: Literal, clause: Clause) -> None:
    """A negated condition's variables must be bound by something: otherwise it asks for all there is not."""
    if not literal.negated or literal.is_comparison:
        return
    binders = [x.atom for x in clause.body if not x.negated]
    bound = set(variables_of(clause.head, *binders))
    for variable in literal.variables():
        if variable not in bound and not variable.is_anonymous:
            sentence = f"{variable.name} stands only under a negation; bind it by a condition, or write _"
            raise ProgramError(sentence, literal.place)
