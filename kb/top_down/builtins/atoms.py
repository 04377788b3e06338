"""Atoms as the text they are."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from casper.kb.terms.atoms import number_text
from casper.kb.top_down.builtins.builtin import Builtin, Outcome, Values, is_known, no_meaning


def text_of(name: str, term: Any) -> str:
    """The text of an atom or a number.

    Raises:
        Undefined: it is neither.
    """
    if type(term) is str:
        return term
    if type(term) is int or type(term) is float:
        return number_text(term)
    raise no_meaning(name, "an atom", term)


def _length(atom: Any, number: Any) -> Outcome:
    if is_known(number) and type(number) is not int:
        raise no_meaning("atom_length/2", "a whole number", number)
    return None, len(text_of("atom_length/2", atom))


def _concat(left: Any, right: Any, whole: Any) -> Outcome:
    if is_known(left) and is_known(right):
        joined = text_of("atom_concat/3", left) + text_of("atom_concat/3", right)
        if not is_known(whole):
            return None, None, joined
        return (None, None, None) if joined == text_of("atom_concat/3", whole) else None
    text = text_of("atom_concat/3", whole)
    if is_known(left):
        start = text_of("atom_concat/3", left)
        return (None, text[len(start) :], None) if text.startswith(start) else None
    if is_known(right):
        end = text_of("atom_concat/3", right)
        return (text[: len(text) - len(end)], None, None) if text.endswith(end) else None
    return _parts(text)


def _parts(text: str) -> Iterator[Values]:
    return ((text[:at], text[at:], None) for at in range(len(text) + 1))


def _parts_known(left: Any, right: Any, whole: Any) -> bool:
    return is_known(whole) or (is_known(left) and is_known(right))


def _first_known(atom: Any, _: Any) -> bool:
    return is_known(atom)


ATOMS = {
    ("atom_length", 2): Builtin(_length, _first_known),
    ("atom_concat", 3): Builtin(_concat, _parts_known),
}
