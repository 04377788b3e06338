"""Namespaces: one text uses the predicates of another under a prefix, ``kitchen:food(X)``.

In ISO Prolog's module syntax ``kitchen:food(X)`` names the predicate food/1 of kitchen. Here the prefix becomes part of
the name: the predicate is called ``'kitchen:food'``, and a text may write either. So two texts never mix, and the rest
of the knowledge base knows nothing of namespaces.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator

from casper.kb.terms.clauses import SYSTEM, Clause, Directive, Literal, Sentence
from casper.kb.terms.control import CONTROL
from casper.kb.terms.syntax import COMPARISONS
from casper.kb.terms.terms import Compound, Term, Variable, as_term, predication

SEPARATOR = ":"
_ABOUT = (("claim", 1), ("did", 2), ("valid", 1))  # their first argument is a statement
_COUNTED = (("aggregate_all", 3), ("findall", 3))  # their second argument is a goal


def qualified(term: Term) -> Term:
    """``prefix:name(X)`` as the statement ``'prefix:name'(X)``; also inside claim, did and valid.

    Anything else comes back as it is: a pair ``a: b`` of data stays a pair.
    """
    if not isinstance(term, Compound):
        return term
    if term.indicator in _ABOUT:
        return Compound((term[0], qualified(term[1]), *term[2:]))
    if term.indicator != (SEPARATOR, 2) or not isinstance(term[1], str):
        return term
    inner = qualified(term[2])
    if isinstance(inner, str):
        return f"{term[1]}{SEPARATOR}{inner}"
    if not isinstance(inner, Compound) or inner.indicator == (SEPARATOR, 2):
        return term
    return Compound((f"{term[1]}{SEPARATOR}{inner.functor}", *inner.args))


def goal_of(term: Term) -> Term:
    """A goal with the prefixes of the conditions in it made part of their names."""
    if not isinstance(term, Compound):
        return term
    if term.indicator in _COUNTED:
        return Compound((term[0], term[1], goal_of(term[2]), term[3]))
    if term.indicator in CONTROL or term[0] in (",", ";"):
        return Compound((term[0], *map(goal_of, term.args)))
    return qualified(term)


def prefixed(sentences: Iterable[Sentence], prefix: str) -> Iterator[Sentence]:
    """The clauses of another text with every predicate of its own under the prefix; its plans stay its own.

    Its constraints come along: they are about its own statements, ``claim(eat(…))`` becomes ``claim(prefix:eat(…))``.
    """
    for sentence in sentences:
        if isinstance(sentence, Clause):
            yield _clause(sentence, prefix)
        elif isinstance(sentence, Directive):
            yield Directive(_directive(sentence.term, prefix), sentence.place)


def _clause(clause: Clause, prefix: str) -> Clause:
    about = (x.atom[1] for x in clause.body if x.atom.indicator in _ABOUT)
    statements = {statement for statement in about if isinstance(statement, Variable)}
    body = tuple(Literal(_condition(x, prefix, statements), x.negated, x.place) for x in clause.body)
    return Clause(_named(clause.head, prefix), body, clause.place)


def _condition(literal: Literal, prefix: str, statements: Collection[Variable]) -> Compound:
    atom = literal.atom
    if literal.is_comparison:  # S = eat(A, T, D), where S is a statement
        if not any(arg in statements for arg in atom.args):
            return atom
        return Compound((atom[0], *(_statement(arg, prefix) for arg in atom.args)))
    return predication(_goal(as_term(atom), prefix))


def _goal(term: Term, prefix: str) -> Term:
    """A goal inside a condition under the prefix: what it is made of has the names, not the control around it."""
    if not isinstance(term, (str, Compound)):
        return term
    atom = predication(term)
    if atom[0] in COMPARISONS and atom.arity == 2:
        return atom
    if atom.indicator in _COUNTED:
        return Compound((atom[0], atom[1], _goal(atom[2], prefix), atom[3]))
    if atom.indicator in CONTROL or (atom[0] in (",", ";") and atom.arity):
        return as_term(Compound((atom[0], *(_goal(part, prefix) for part in atom.args))))
    if atom.indicator in _ABOUT:
        return Compound((atom[0], _statement(atom[1], prefix), *atom[2:]))
    return as_term(_named(atom, prefix))


def _statement(term: Term, prefix: str) -> Term:
    return as_term(_named(predication(term), prefix)) if isinstance(term, (str, Compound)) else term


def _named(atom: Compound, prefix: str) -> Compound:
    if atom.indicator in SYSTEM:
        return atom
    return Compound((f"{prefix}{SEPARATOR}{atom.functor}", *atom.args))


def _directive(term: Compound, prefix: str) -> Compound:
    """``dynamic(name/arity)`` or ``table(path(_, _, min))`` under the prefix."""
    if term.functor in ("table", "discontiguous", "dynamic") and term.arity == 1:
        return Compound((term[0], _declared(term[1], prefix)))
    return term


def _declared(term: Term, prefix: str) -> Term:
    if isinstance(term, Compound) and term[0] == ",":
        return Compound((",", *(_declared(part, prefix) for part in term.args)))
    if isinstance(term, Compound) and term.indicator == ("/", 2):
        return Compound(("/", f"{prefix}{SEPARATOR}{term[1]}", term[2]))
    return _named(term, prefix) if isinstance(term, Compound) else term
