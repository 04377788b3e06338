"""How a term is written for people, such that it reads in again as the same term: spaces where they help the eye.

A term is looked at as the data it is (tuples whose first element is the functor, strings, numbers), so that this file
needs none of the classes that print themselves by it. As SWI-Prolog writes terms, `kb.terms.writeq` does.
"""

from __future__ import annotations

from typing import Any

from casper.kb.terms.atoms import NIL, is_signs, is_word, number_text, quoted
from casper.kb.terms.operators import ARGUMENT, HIGHEST, STANDARD

COMPARISONS = frozenset({"=", "\\=", "==", "\\==", "<", ">", "=<", ">=", "=:=", "=\\=", "is"})
_BARE = frozenset({NIL, "{}"})


def term_text(term: Any, limit: int = ARGUMENT, sequences: bool = False) -> str:
    """The term in the language's syntax.

    Args:
        term: any term.
        limit: the highest operator priority that needs no brackets.
        sequences: whether ``','`` and ``';'`` of more than two are written ``a, b, c``, as in the body of a production.
    """
    if isinstance(term, tuple) and term and isinstance(term[0], str):
        return _compound_text(term, limit, sequences)
    if isinstance(term, str):
        return atom_text(term)
    return number_text(term) if isinstance(term, (int, float)) else str(term)


def atom_text(atom: str) -> str:
    """An atom, quoted where the syntax needs it: a sentence in double quotes, anything else in single ones."""
    if is_word(atom) or atom in _BARE:
        return atom
    return quoted(atom, '"' if " " in atom else "'", doubled=True)


def _compound_text(term: tuple[Any, ...], limit: int, sequences: bool) -> str:
    functor, *args = term
    if functor == "." and len(args) == 2:
        items, tail = _list_items(term)
        shown = ", ".join(term_text(item, ARGUMENT, sequences) for item in items)
        return f"[{shown}]" if tail == NIL else f"[{shown} | {term_text(tail, 700, sequences)}]"
    if functor == "{}" and len(args) == 1:
        return f"{{{term_text(args[0], HIGHEST, sequences)}}}"
    operator, priority = _operator_text(term, sequences)
    if operator:
        return f"({operator})" if priority > limit else operator
    return statement_text(term, sequences)


def statement_text(term: tuple[Any, ...], sequences: bool = False) -> str:
    """A compound as a name, or ``name(arguments)``, even where its functor is an operator: ``'+'(1, 2)``."""
    functor, *args = term
    name = atom_text(functor) if is_word(functor) else quoted(functor, doubled=True)
    return f"{name}({', '.join(term_text(arg, ARGUMENT, sequences) for arg in args)})" if args else name


def _list_items(cell: Any) -> tuple[list[Any], Any]:
    items = []
    while isinstance(cell, tuple) and len(cell) == 3 and cell[0] == ".":
        items.append(cell[1])
        cell = cell[2]
    return items, cell


def _operator_text(term: tuple[Any, ...], sequences: bool) -> tuple[str, int]:
    """The term written with its operator, and its priority; nothing when its functor is none at this arity."""
    name, arity = term[0], len(term) - 1
    if name in (",", ";") and (arity == 2 or (arity > 2 and sequences)):
        return _series_text(term, sequences)
    if arity == 2 and name in STANDARD.infix:
        priority, left, right = STANDARD.infix[name]
        glue = ": " if name == ":" else f" {name} "
        return f"{_operand(term[1], left, sequences)}{glue}{_operand(term[2], right, sequences)}", priority
    if arity == 1 and name in STANDARD.prefix and is_signs(name) and term[1] not in (",", "|"):
        priority, operand = STANDARD.prefix[name]
        return f"{name} {_operand(term[1], operand, sequences)}", priority
    return "", 0


def _series_text(term: tuple[Any, ...], sequences: bool) -> tuple[str, int]:
    """``a, b, c``: of a term of two, the right side's as well."""
    name, items = term[0], list(term[1:])
    while not sequences and isinstance(items[-1], tuple) and len(items[-1]) == 3 and items[-1][0] == name:
        items[-1:] = items[-1][1:]
    priority = STANDARD.infix[name][0]
    return (", " if name == "," else " ; ").join(_operand(item, priority - 1, sequences) for item in items), priority


def _operand(term: Any, limit: int, sequences: bool) -> str:
    """A term beside an operator: there a name that is an operator itself stands in quotes."""
    if isinstance(term, str) and term in STANDARD and is_word(term):
        return f"'{term}'"
    return term_text(term, limit, sequences)
