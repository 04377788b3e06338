"""Namespaces: one text uses the predicates of another under a prefix, ``kitchen:food(X)``.

In ISO Prolog's module syntax ``kitchen:food(X)`` names the predicate food/1 of kitchen. Here the prefix becomes part of
the name: the predicate is called ``'kitchen:food'``, and a text may write either. So two texts never mix, and the rest
of the knowledge base knows nothing of namespaces.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass

from casper.kb.terms.builtins import BUILTINS
from casper.kb.terms.clauses import CALLING, SYSTEM, Clause, Directive, Indicator, Literal, Sentence
from casper.kb.terms.control import CONTROL
from casper.kb.terms.syntax import COMPARISONS
from casper.kb.terms.terms import Compound, Term, Variable, as_term, predication

SEPARATOR = ":"
_ABOUT = (("claim", 1), ("did", 2), ("valid", 1))  # their first argument is a statement
_SAYS = (("say", 2), ("say", 3))  # the last but one is what is worded (`kb.reasons.says`)
_DENIALS = (("\\+", 1), ("not", 1))
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
    if _added(term.indicator) is not None:
        return Compound((term[0], goal_of(term[1]), *term[2:]))
    return qualified(term)


def _added(indicator: Indicator) -> int | None:
    """How many arguments a built-in adds to its first one, which is a goal; None where that is none."""
    is_call = indicator[0] == "call" and indicator in BUILTINS
    return indicator[1] - 1 if is_call else CALLING.get(indicator)


def prefixed(sentences: Iterable[Sentence], prefix: str) -> Iterator[Sentence]:
    """The clauses of another text with every predicate of its own under the prefix; its plans stay its own.

    A built-in predicate that the text does not define keeps its name. Its constraints come along: they are about its
    own statements, ``claim(eat(…))`` becomes ``claim(prefix:eat(…))``.
    """
    everything = list(sentences)
    space = _Space(prefix, BUILTINS - _defined(everything))
    for sentence in everything:
        if isinstance(sentence, Clause):
            yield _clause(sentence, space)
        elif isinstance(sentence, Directive):
            yield Directive(_directive(sentence.term, space), sentence.place)


@dataclass(frozen=True, slots=True)
class _Space:
    """A prefix, and the built-in predicates that go without it."""

    prefix: str
    given: frozenset[Indicator]

    def named(self, indicator: Indicator) -> str:
        """What a predicate of the text is called."""
        is_given = indicator in SYSTEM or indicator in self.given
        return indicator[0] if is_given else f"{self.prefix}{SEPARATOR}{indicator[0]}"


def _defined(sentences: Sequence[Sentence]) -> frozenset[Indicator]:
    """What a text defines, by clauses or by saying that it is dynamic."""
    declared = (s.term[1] for s in sentences if isinstance(s, Directive) and s.term.indicator == ("dynamic", 1))
    named = (term for term in declared if isinstance(term, Compound) and term.indicator == ("/", 2))
    dynamic = ((str(term[1]), term[2]) for term in named)
    return frozenset({*(s.head.indicator for s in sentences if isinstance(s, Clause)), *dynamic})


def _clause(clause: Clause, space: _Space) -> Clause:
    if clause.head.indicator in _SAYS and isinstance(clause.head[-1], str):
        return Clause(_worded(clause.head, space), clause.body, clause.place)
    about = (x.atom[1] for x in clause.body if x.atom.indicator in _ABOUT)
    statements = {statement for statement in about if isinstance(statement, Variable)}
    body = tuple(Literal(_condition(x, space, statements), x.negated, x.place) for x in clause.body)
    return Clause(_named(clause.head, space), body, clause.place)


def _worded(head: Compound, space: _Space) -> Compound:
    """The sentence of a term of the text: its predicates have the prefix, its things have not."""
    term = head[-2]
    if isinstance(term, Compound) and term.indicator in _DENIALS:
        return Compound((*head[:-2], Compound((term[0], _statement(term[1], space))), head[-1]))
    named = _statement(term, space) if isinstance(term, Compound) else term
    return Compound((*head[:-2], named, head[-1]))


def _condition(literal: Literal, space: _Space, statements: Collection[Variable]) -> Compound:
    atom = literal.atom
    if literal.is_comparison:  # S = eat(A, T, D), where S is a statement
        if not any(arg in statements for arg in atom.args):
            return atom
        return Compound((atom[0], *(_statement(arg, space) for arg in atom.args)))
    return predication(_goal(as_term(atom), space))


def _goal(term: Term, space: _Space) -> Term:
    """A goal inside a condition under the prefix: what it is made of has the names, not the control around it."""
    if not isinstance(term, (str, Compound)):
        return term
    atom = predication(term)
    if atom[0] in COMPARISONS and atom.arity == 2:
        return atom
    if atom.indicator in _COUNTED:
        return Compound((atom[0], atom[1], _goal(atom[2], space), atom[3]))
    if atom.indicator in CONTROL or (atom[0] in (",", ";") and atom.arity):
        return as_term(Compound((atom[0], *(_goal(part, space) for part in atom.args))))
    if atom.indicator in _ABOUT:
        return Compound((atom[0], _statement(atom[1], space), *atom[2:]))
    added = _added(atom.indicator) if atom.indicator in space.given else None
    if added is not None:
        return Compound((atom[0], _called(atom[1], added, space), *atom[2:]))
    return as_term(_named(atom, space))


def _called(term: Term, extra: int, space: _Space) -> Term:
    """A goal that lacks its last arguments under the prefix."""
    if not extra or not isinstance(term, (str, Compound)):
        return _goal(term, space)
    atom = predication(term)
    whole = (atom.functor, atom.arity + extra)
    if whole in CONTROL or (atom.functor in COMPARISONS and whole[1] == 2):
        return term
    return as_term(Compound((space.named(whole), *atom.args)))


def _statement(term: Term, space: _Space) -> Term:
    return as_term(_named(predication(term), space)) if isinstance(term, (str, Compound)) else term


def _named(atom: Compound, space: _Space) -> Compound:
    return Compound((space.named(atom.indicator), *atom.args))


def _directive(term: Compound, space: _Space) -> Compound:
    """``dynamic(name/arity)`` or ``table(path(_, _, min))`` under the prefix."""
    if term.functor in ("table", "discontiguous", "dynamic", "stored") and term.arity == 1:
        return Compound((term[0], _declared(term[1], space)))
    return term


def _declared(term: Term, space: _Space) -> Term:
    if isinstance(term, Compound) and term.indicator == ("/", 2):
        return Compound(("/", space.named((str(term[1]), term[2])), term[2]))
    return _named(term, space) if isinstance(term, Compound) else term
