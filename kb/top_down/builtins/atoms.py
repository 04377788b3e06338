"""Atoms as the text they are."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from casper.kb.errors import BudgetExceeded
from casper.kb.terms.atoms import number_text
from casper.kb.terms.values.effort import charge_text
from casper.kb.top_down.builtins.builtin import Builtin, Outcome, Values, is_known, no_meaning

MOST_CHARACTERS = 1 << 24  # of an atom; one that doubles would otherwise fill the memory in a few steps


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


def checked(text: str) -> str:
    """An atom that was made, paid for.

    Raises:
        BudgetExceeded: it is too long.
    """
    if len(text) > MOST_CHARACTERS:
        raise _too_long()
    charge_text(len(text))
    return text


def _joined(left: str, right: str) -> str:
    if len(left) + len(right) > MOST_CHARACTERS:  # before it takes the memory
        raise _too_long()
    return checked(left + right)


def _too_long() -> BudgetExceeded:
    return BudgetExceeded(f"the search made an atom of more than {MOST_CHARACTERS:,} characters: the answer is unknown")


def _length(atom: Any, number: Any) -> Outcome:
    if is_known(number) and type(number) is not int:
        raise no_meaning("atom_length/2", "a whole number", number)
    return None, len(text_of("atom_length/2", atom))


def _concat(left: Any, right: Any, whole: Any) -> Outcome:
    if is_known(left) and is_known(right):
        joined = _joined(text_of("atom_concat/3", left), text_of("atom_concat/3", right))
        if not is_known(whole):
            return None, None, joined
        return (None, None, None) if joined == text_of("atom_concat/3", whole) else None
    text = text_of("atom_concat/3", whole)
    if is_known(left):
        start = text_of("atom_concat/3", left)
        return (None, checked(text[len(start) :]), None) if text.startswith(start) else None
    if is_known(right):
        end = text_of("atom_concat/3", right)
        return (checked(text[: len(text) - len(end)]), None, None) if text.endswith(end) else None
    return _parts(text)


def _parts(text: str) -> Iterator[Values]:
    return ((checked(text[:at]), checked(text[at:]), None) for at in range(len(text) + 1))


def _parts_known(left: Any, right: Any, whole: Any) -> bool:
    return is_known(whole) or (is_known(left) and is_known(right))


def _first_known(atom: Any, _: Any) -> bool:
    return is_known(atom)


ATOMS = {
    ("atom_length", 2): Builtin(_length, _first_known),
    ("atom_concat", 3): Builtin(_concat, _parts_known),
}
