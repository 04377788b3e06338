"""How a term is written, such that it reads in again as the same term.

A term is looked at as the data it is (tuples whose first element is the functor, strings, numbers), so that this file
needs none of the classes that print themselves by it.
"""

from __future__ import annotations

import re
from typing import Any

COMPARISONS = frozenset({"=", "\\=", "==", "\\==", "<", ">", "=<", ">=", "=:=", "=\\=", "is"})
_LONG, _AT_ONCE = 13_000, 4_000  # bits from which an integer is written in parts; digits of a part
_NIL = "[]"  # as `terms.NIL`
_PLAIN = re.compile(r"[a-z][A-Za-z0-9_]*\Z")
_ESCAPED = {"\\": "\\\\", "\n": "\\n", "\t": "\\t", "\r": "\\r", "\0": "\\0"}
_PRIORITY = {";": 1100, "->": 1050, ",": 1000, "\\+": 900, "+": 500, "-": 500, "*": 400, "/": 400, ":": 200}
_PRIORITY.update(dict.fromkeys(COMPARISONS, 700))


def term_text(term: Any, limit: int = 999) -> str:
    """The term in the language's syntax; ``limit`` is the highest operator priority that needs no brackets."""
    if isinstance(term, tuple) and term and isinstance(term[0], str):
        return _compound_text(term, limit)
    if isinstance(term, str):
        return atom_text(term)
    return _digits(term) if isinstance(term, int) and term.bit_length() > _LONG else str(term)


def _digits(number: int) -> str:
    """An integer of more digits than Python writes at once."""
    parts, rest = [], abs(number)
    while rest:
        rest, part = divmod(rest, 10**_AT_ONCE)
        parts.append(str(part).rjust(_AT_ONCE, "0") if rest else str(part))
    return ("-" if number < 0 else "") + "".join(reversed(parts))


def atom_text(atom: str) -> str:
    """An atom, quoted where the syntax needs it: a sentence in double quotes, anything else in single ones."""
    if _PLAIN.match(atom) and atom != "is":
        return atom
    if atom == _NIL:
        return atom
    quote = '"' if " " in atom else "'"
    inner = "".join(_ESCAPED.get(c, c * 2 if c == quote else c) for c in atom)
    return f"{quote}{inner}{quote}"


def _compound_text(term: tuple[Any, ...], limit: int) -> str:
    functor, *args = term
    if functor == "." and len(args) == 2:
        items, tail = _list_items(term)
        shown = ", ".join(term_text(item) for item in items)
        return f"[{shown}]" if tail == _NIL else f"[{shown} | {term_text(tail, 700)}]"
    operator = _operator_text(term)
    if operator is not None:
        return f"({operator})" if _PRIORITY[functor] > limit else operator
    if not args:
        return atom_text(functor)
    return f"{atom_text(functor)}({', '.join(term_text(arg) for arg in args)})"


def _list_items(cell: Any) -> tuple[list[Any], Any]:
    items = []
    while isinstance(cell, tuple) and len(cell) == 3 and cell[0] == ".":
        items.append(cell[1])
        cell = cell[2]
    return items, cell


def _operator_text(term: tuple[Any, ...]) -> str | None:
    """The term written with its operator, or None when its functor is none at this arity."""
    name, arity = term[0], len(term) - 1
    if name in (",", ";") and arity >= 2:
        limit = _PRIORITY[name] - 1
        return (", " if name == "," else " ; ").join(term_text(arg, limit) for arg in term[1:])
    if name == "\\+" and arity == 1:
        return f"\\+ {term_text(term[1], 900)}"
    if arity != 2 or name not in _PRIORITY:
        return None
    priority = _PRIORITY[name]
    left = priority if name in "+-*/" else priority - 1
    right = priority if name in (":", "->") else priority - 1
    glue = ": " if name == ":" else f" {name} "
    return f"{term_text(term[1], left)}{glue}{term_text(term[2], right)}"
