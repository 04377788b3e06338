"""The printer: terms, clauses and productions as text that reads in again as the same thing."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from casper.kb.terms.clauses import Clause, Directive, Indicator, Literal, Production, Sentence
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Term, Variable, as_term, predication
from casper.kb.text.lines import Line, Span, line

MOST_SHOWN = 40  # sentences of a printed text


def literal_text(literal: Literal) -> str:
    """One condition as it stands in a body."""
    return str(literal)


def sentence_text(sentence: Sentence) -> str:
    """One clause, production or directive, with its full stop."""
    if not isinstance(sentence, (Clause, Production, Directive)):
        raise TypeError(f"{sentence!r} is no sentence of the language")
    return str(sentence)


def answer_text(answer: Mapping[str, Term]) -> str:
    """An answer to a query: ``T = meal, D = plate``; ``yes`` where nothing was asked for."""
    return ", ".join(f"{name} = {term_text(value)}" for name, value in answer.items()) or "yes"


def answer_json(answer: Mapping[str, Term]) -> dict[str, Any]:
    """An answer as a JSON object of its variables.

    Numbers and atoms are as they are, compound terms are text, and what may be anything is null.
    """
    return {name: _json_value(value) for name, value in answer.items()}


def _json_value(term: Term) -> Any:
    if isinstance(term, Variable):
        return None
    return term_text(as_term(predication(term))) if isinstance(term, tuple) else term


def indicators_text(indicators: Iterable[Indicator]) -> str:
    """Predicates by name and arity, in order: ``agent/1, eat/3``."""
    return ", ".join(f"{name}/{arity}" for name, arity in sorted(indicators))


def program_lines(sentences: Sequence[Sentence], most: int = MOST_SHOWN) -> Iterator[Line]:
    """The sentences, one a line; of many the first, and a comment that says how many more there are."""
    if not sentences:
        yield line(Span("% nothing is stated", "faint"))
    yield from (line(sentence_text(sentence)) for sentence in sentences[:most])
    if len(sentences) > most:
        yield line(Span(f"% … and {len(sentences) - most} more", "faint"))


def program_text(sentences: Iterable[Sentence]) -> str:
    """A whole text, one sentence a line."""
    return "".join(f"{sentence_text(sentence)}\n" for sentence in sentences)
