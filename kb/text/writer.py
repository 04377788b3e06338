"""The printer: terms, clauses and productions as text that reads in again as the same thing."""

from __future__ import annotations

from collections.abc import Iterable

from casper.kb.terms.clauses import Clause, Directive, Literal, Production, Sentence
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term


def literal_text(literal: Literal) -> str:
    """One condition as it stands in a body."""
    atom = literal.atom if literal.shown is None else literal.shown
    text = term_text(as_term(atom) if isinstance(atom, Compound) else atom, 700 if literal.is_comparison else 999)
    return f"\\+ {text}" if literal.negated else text


def sentence_text(sentence: Sentence) -> str:
    """One clause, production or directive, with its full stop."""
    match sentence:
        case Clause(head, ()):
            return f"{term_text(as_term(head))}."
        case Clause(head, body):
            return f"{term_text(as_term(head))} :- {', '.join(map(literal_text, body))}."
        case Production(head, body):
            return f"{term_text(as_term(head))} --> {term_text(body, 1200)}."
        case Directive(term):
            return f":- {term_text(as_term(term))}."
    raise TypeError(f"{sentence!r} is no sentence of the language")


def program_text(sentences: Iterable[Sentence]) -> str:
    """A whole text, one sentence a line."""
    return "".join(f"{sentence_text(sentence)}\n" for sentence in sentences)
