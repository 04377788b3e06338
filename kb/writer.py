"""The printer: terms, clauses and productions as text that reads in again as the same thing."""

from __future__ import annotations

import re
from collections.abc import Iterable

from casper.kb.clauses import COMPARISONS, Clause, Directive, Literal, Production, Sentence
from casper.kb.terms import NIL, Compound, Term, Variable, as_term, list_items

_PLAIN = re.compile(r"[a-z][A-Za-z0-9_]*\Z")
_ESCAPED = {"\\": "\\\\", "\n": "\\n", "\t": "\\t", "\r": "\\r", "\0": "\\0"}
_PRIORITY = {";": 1100, ",": 1000, "\\+": 900, "+": 500, "-": 500, "*": 400, "/": 400, ":": 200}
_PRIORITY.update(dict.fromkeys(COMPARISONS, 700))


def term_text(term: Term, limit: int = 999) -> str:
    """The term in the language's syntax; ``limit`` is the highest operator priority that needs no brackets."""
    if isinstance(term, Variable):
        return "_" if term.name.startswith("_#") else repr(term)
    if isinstance(term, Compound):
        return _compound_text(term, limit)
    if isinstance(term, str):
        return atom_text(term)
    return repr(term)


def atom_text(atom: str) -> str:
    """An atom, quoted where the syntax needs it: a sentence in double quotes, anything else in single ones."""
    if _PLAIN.match(atom) and atom != "is":
        return atom
    if atom == NIL:
        return atom
    quote = '"' if " " in atom else "'"
    inner = "".join(_ESCAPED.get(c, c * 2 if c == quote else c) for c in atom)
    return f"{quote}{inner}{quote}"


def _compound_text(term: Compound, limit: int) -> str:
    if term.indicator == (".", 2):
        items, tail = list_items(term)
        shown = ", ".join(term_text(item) for item in items)
        return f"[{shown}]" if tail == NIL else f"[{shown} | {term_text(tail, 700)}]"
    operator = _operator_text(term)
    if operator is not None:
        return f"({operator})" if _PRIORITY[term.functor] > limit else operator
    if len(term) == 1:
        return atom_text(term.functor)
    return f"{atom_text(term.functor)}({', '.join(term_text(arg) for arg in term.args)})"


def _operator_text(term: Compound) -> str | None:
    """The term written with its operator, or None when its functor is none at this arity."""
    name, arity = term.functor, term.arity
    if name in (",", ";") and arity >= 2:
        limit = _PRIORITY[name] - 1
        return (", " if name == "," else " ; ").join(term_text(arg, limit) for arg in term.args)
    if name == "\\+" and arity == 1:
        return f"\\+ {term_text(term[1], 900)}"
    if arity != 2 or name not in _PRIORITY:
        return None
    priority = _PRIORITY[name]
    left = priority if name in "+-*/" else priority - 1
    right = priority if name == ":" else priority - 1
    glue = ": " if name == ":" else f" {name} "
    return f"{term_text(term[1], left)}{glue}{term_text(term[2], right)}"


def literal_text(literal: Literal) -> str:
    """One condition as it stands in a body."""
    text = term_text(as_term(literal.atom), 700 if literal.is_comparison else 999)
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
