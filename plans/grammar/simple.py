"""Terms written as plain names, ``wash`` or ``wash(Plate, sink)``, read without the parser: libraries of ten thousand
goals are built in Python."""

from __future__ import annotations

import re
from functools import lru_cache

from casper.kb.terms.terms import Compound, Term, Variable

_NAME = r"[a-z][A-Za-z0-9_]*"
_ARGUMENT = rf"(?:{_NAME}|[A-Z][A-Za-z0-9_]*)"
_SIMPLE = re.compile(rf"\s*({_NAME})(?:\(\s*({_ARGUMENT}(?:\s*,\s*{_ARGUMENT})*)\s*\))?\s*\Z")


@lru_cache(maxsize=65_536)
def simple_term(text: str) -> Compound | None:
    """The term, or None when the text is no such thing and the parser has to look at it."""
    found = _SIMPLE.match(text)
    if found is None or "is" in re.findall(_NAME, text):
        return None
    name, arguments = found[1], found[2] or ""
    return Compound((name, *(_argument(part.strip()) for part in arguments.split(",") if arguments)))


def _argument(text: str) -> Term:
    return Variable(text) if text[0].isupper() else text
