"""Directives that the reader itself obeys, ``:- op(P, T, Name).``, and those that stand for several."""

from __future__ import annotations

from collections.abc import Iterator

from casper.kb.terms.operators import HIGHEST, TYPES, Operators
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import NIL, Compound, Term, list_items

OP = ("op", 3)
_FIXED = frozenset({":-", "-->", ",", "|", ";", "->", "\\+", NIL, "{}"})
_SEVERAL = frozenset({"dynamic", "table", "discontiguous", "stored"})  # may name several predicates at once


class Refused(ValueError):
    """A directive that makes no sense; the reader adds the place. ``quoted`` is what the sentence repeats of it."""

    def __init__(self, sentence: str, quoted: str) -> None:
        super().__init__(sentence)
        self.sentence, self.quoted = sentence, quoted


def declare(directive: Compound, operators: Operators) -> None:
    """Do what ``op(Priority, Type, Name)`` says; Name may be a list of names.

    Raises:
        Refused: there is no such priority or type, or the name cannot be such an operator.
    """
    _, priority, type_, names = directive
    if isinstance(priority, bool) or not isinstance(priority, int) or not 0 <= priority <= HIGHEST:
        shown = term_text(priority)
        raise Refused(f"an operator's priority is a whole number from 0 to {HIGHEST}, not {shown}", f"not {shown}")
    if type_ not in TYPES:
        shown = term_text(type_)
        raise Refused(f"an operator's type is one of {', '.join(TYPES)}, not {shown}", f"not {shown}")
    for name in _names(names):
        _check(name, type_, operators)
        operators.add(priority, type_, name)
        if priority and name in operators:
            operators.own.add(name)


def _names(term: Term) -> list[str]:
    items, tail = list_items(term)
    names = items if items and tail == NIL else [term]
    for name in names:
        if not isinstance(name, str):
            raise Refused(f"{term_text(name)} is no name, so it cannot be an operator", term_text(name))
    return names


def _check(name: str, type_: str, operators: Operators) -> None:
    if name in _FIXED:
        raise Refused(f"{name} is part of the language and stays what it is; choose another operator", name)
    other = operators.postfix if len(type_) == 3 else operators.infix if type_[0] != "f" else {}
    if name in other:
        raise Refused(f"{name} clashes with itself: it cannot stand between two terms and behind one", name)


def each_of(directive: Compound) -> Iterator[Compound]:
    """``dynamic p/1, q/2`` and ``dynamic([p/1, q/2])`` as one directive for each predicate."""
    if directive.functor not in _SEVERAL or directive.arity != 1:
        yield directive
        return
    waiting = [directive[1]]
    while waiting:
        term = waiting.pop()
        items, tail = list_items(term)
        if items and tail == NIL:
            waiting += reversed(items)
        elif isinstance(term, Compound) and term.indicator == (",", 2):
            waiting += (term[2], term[1])
        else:
            yield Compound((directive.functor, term))
