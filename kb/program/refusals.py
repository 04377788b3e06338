"""What no clause may say: a name of the system's, an undefined condition, a variable only under a negation."""

from __future__ import annotations

from collections.abc import Collection
from difflib import get_close_matches

from casper.kb.errors import Place, ProgramError
from casper.kb.terms.builtins import BUILTINS, MOST_EXTRA
from casper.kb.terms.clauses import SYSTEM, Clause, Indicator, Literal, is_auxiliary
from casper.kb.terms.comparison import misspelt
from casper.kb.terms.control import CONTROL
from casper.kb.terms.syntax import COMPARISONS
from casper.kb.terms.unification import variables_of
from casper.kb.terms.values.arithmetic import CONSTANTS, FUNCTIONS


def check_own(indicator: Indicator, place: Place) -> None:
    """Refuse to define what the system defines."""
    name, arity = indicator
    is_call = name == "call" and 1 <= arity <= 1 + MOST_EXTRA
    if indicator in SYSTEM or indicator in CONTROL or is_call or (name in COMPARISONS and arity == 2):
        sentence = f"{name}/{arity} is defined by the system; choose another name"
        raise ProgramError(sentence, place if place.line else None)


def check_defined(literal: Literal, known: Collection[Indicator]) -> None:
    """Refuse a condition whose predicate nobody defines, with the nearest name that somebody does.

    Raises:
        ProgramError: naming the predicate, its place, and what may have been meant.
    """
    called = None if literal.atom.indicator in known else literal.called
    for needed in (literal.needed, called):
        if needed is None or needed in SYSTEM or needed in known or needed in BUILTINS:
            continue
        if needed == called and needed[0] in COMPARISONS:
            continue
        place = literal.place if literal.place.line else None
        raise ProgramError(undefined_sentence(needed, known), place)


def check_computable(literal: Literal) -> None:
    """Refuse an expression with a function or constant that nothing computes.

    Raises:
        ProgramError: naming it, and its likely spelling.
    """
    if literal.is_comparison:
        for name in misspelt(literal):
            function, _, arity = name.rpartition("/")
            known = {n for n, a in FUNCTIONS if a == int(arity)} if arity != "0" else set(CONSTANTS)
            close = get_close_matches(function, sorted(known), n=1)
            hint = f"did you mean {close[0]}?" if close else "write a number, a variable or a function of arithmetic"
            raise ProgramError(f"nothing computes {name}; {hint}", literal.place if literal.place.line else None)


def undefined_sentence(indicator: Indicator, known: Collection[Indicator]) -> str:
    """The sentence for a predicate that is not there: another arity, a likely misspelling, or what to do."""
    name, arity = indicator
    known = [i for i in known if not is_auxiliary(i)]
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
    if not literal.is_strict:
        return
    binders = [x.atom for x in clause.body if not x.is_strict] + [x.atom[3] for x in clause.body if x.is_aggregate]
    bound = set(variables_of(clause.head, *binders))
    for variable in literal.strict_variables():
        if variable not in bound:
            where = "in what is counted" if literal.is_aggregate else "under a negation"
            sentence = f"{variable.name} stands only {where}; bind it by a condition, or write _"
            raise ProgramError(sentence, literal.place)
