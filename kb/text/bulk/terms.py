"""Plain terms in large texts: told by an expression, and read without the parser.

A plain term is ``name`` or ``name(arguments)``; an argument is a name, a variable, a whole number, or a term of these:
``goal(tea(Cup, 2))``. It is read as the parser reads it, ``is`` too: where a name is needed, that is one.
"""

from __future__ import annotations

import re
import sys
from itertools import count

from casper.kb.terms.terms import Compound, Term, Variable

_NAME = r"[a-z][A-Za-z0-9_]*+"
_VALUE = r"[A-Z_][A-Za-z0-9_]*+|[0-9]{1,18}"


def _series(item: str) -> str:
    return rf"(?:{item})(?:\s*+,\s*+(?:{item}))*"


def _term(argument: str) -> str:
    return rf"{_NAME}(?:\(\s*+{_series(argument)}\s*+\))?"


TERM = _term(f"{_term(f'{_NAME}|{_VALUE}')}|{_VALUE}")
TERMS = _series(TERM)
_PART = re.compile(r"[^\s,()]++(?:\([^()]*+(?:\([^()]*+\)[^()]*+)*\))?")  # of a series that is known to be plain
_ANONYMOUS = re.compile(r"_(?!\w)(?<!\w_)")

parts = _PART.findall
"""The texts between the commas of a plain series."""
part_matches = _PART.finditer
"""As `parts`, with their offsets."""
first_anonymous = _ANONYMOUS.search
"""Where a plain text has a variable ``_``, or None."""


class Terms(dict[str, Term]):
    """What the texts of plain terms stand for: ``terms[text]`` reads a text once, however often it occurs."""

    def __missing__(self, text: str) -> Term:
        if text < "A":  # digits stand before the capitals and ``_``, and those before the small letters
            term: Term = float(text) if "." in text else int(text)
        elif text < "a":
            term = Variable(text)
        else:
            term = self.statement(text) if text[-1] == ")" else sys.intern(text)
        self[text] = term
        return term

    def statement(self, text: str) -> Compound:
        """A term that is not worth remembering, as something that can be true: a name becomes ``(name,)``."""
        name, _, arguments = text.partition("(")
        if "(" in arguments:
            return Compound((sys.intern(name), *[self[part] for part in parts(arguments, 0, len(arguments) - 1)]))
        if not arguments:
            return Compound((sys.intern(name),))
        split = map(str.strip, arguments[:-1].split(","))  # names and numbers are sooner made than looked up
        values = [sys.intern(part) if part >= "a" else int(part) if part < "A" else self[part] for part in split]
        return Compound((sys.intern(name), *values))


def numbered(*texts: str) -> list[str]:
    """The texts of one sentence, each ``_`` with the name that the parser's reader gives it: ``_#1``, ``_#2`` …"""
    numbers = count(1)
    return [_ANONYMOUS.sub(lambda _: f"_#{next(numbers)}", text) for text in texts]
