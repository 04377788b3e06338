"""Constants in large texts: names, numbers and what stands in quotes, told by expressions and each read once.

What stands in quotes may hold commas, brackets and full stops. It is put aside first (`Constants.aside`): a mark stands
for it, so that the rest can be split at its commas, and the mark is looked up like any other constant.
"""

from __future__ import annotations

import re
import sys

from casper.kb.terms.atoms import goes_on, is_capital, is_start
from casper.kb.terms.terms import Term
from casper.kb.text.parsing.tokens import ESCAPE, number, unquoted

NUMBER = (
    r"-?(?:0x[0-9a-fA-F]{1,200}+|0o[0-7]{1,200}+|0b[01]{1,200}+"
    r"|[0-9]{1,99}+(?:\.[0-9]{1,99}+(?:[eE][+\-]?[0-9]{1,2}+)?|[eE][+\-]?[0-9]{1,2}+|(?:_[0-9]{1,99}+){1,9}+)?)"
)
"""A number, but none that is too large, a fraction or the code of a character; a minus sign stands right before it."""
QUOTED = "|".join(rf"{quote}(?:[^{quote}\\\n]++|(?!\\\n){ESCAPE}|{quote}{quote})*+{quote}" for quote in "'\"")
"""An atom in quotes that stands on one line."""
_QUOTED = re.compile(f"({QUOTED})")
_NAME = r"[a-z][A-Za-z0-9_]*+"


def name_expression(text: str) -> str:
    """The names without quotes that can stand in a text: of plain letters, and of the others that the text has."""
    if text.isascii():
        return _NAME
    others = "".join(letter for letter in set(text) if letter > "\x7f" and goes_on(letter))
    small = "".join(letter for letter in others if is_start(letter) and not is_capital(letter))
    return rf"[a-z{small}][A-Za-z0-9_{others}]*+"


class Constants(dict[str, Term]):
    """What the texts of constants stand for: ``constants[text]`` reads a text once, however often it occurs."""

    def __init__(self) -> None:
        super().__init__()
        self._marks = _Marks(self)

    def __missing__(self, text: str) -> Term:
        if text > "A":  # signs and digits stand before the capitals, and those before all that names start with
            term: Term = sys.intern(text)
        elif text.isdigit():
            term = int(text)
        elif "." in text:
            term = float(text)
        else:
            term = -number(text[1:]) if text[0] == "-" else number(text)
        self[text] = term
        return term

    def aside(self, text: str) -> str:
        """The text with a mark for each of the things in quotes.

        Raises:
            Unreadable: there is an escape that is none.
        """
        if "'" not in text and '"' not in text:
            return text
        pieces = _QUOTED.split(text)
        pieces[1::2] = map(self._marks.__getitem__, pieces[1::2])
        return "".join(pieces)


class _Marks(dict[str, str]):
    """The mark for each thing in quotes, which the constants know then, too."""

    def __init__(self, constants: Constants) -> None:
        super().__init__()
        self._constants = constants

    def __missing__(self, text: str) -> str:
        atom, mark = sys.intern(unquoted(text)), f"'{len(self)}"
        self[text] = mark
        self._constants[mark] = atom
        return mark
