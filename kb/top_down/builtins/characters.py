"""Atoms as rows of characters: parts, case, codes, and the numbers they spell."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from casper.kb.terms.atoms import number_text
from casper.kb.terms.terms import make_list
from casper.kb.terms.values.effort import SMALL, charge
from casper.kb.text.parsing.tokens import number_in
from casper.kb.top_down.builtins.atoms import checked, text_of
from casper.kb.top_down.builtins.builtin import (
    Builtin,
    Outcome,
    Values,
    has_end,
    is_ground,
    is_known,
    no_meaning,
    proper_items,
)
from casper.kb.top_down.compiled.cells import deref

_SUB = "sub_atom/5"


def _first_known(atom: Any, *_: Any) -> bool:
    return is_known(atom)


def _either_known(left: Any, right: Any) -> bool:
    return is_known(left) or is_known(right)


def _spelt_known(left: Any, items: Any) -> bool:
    return is_known(left) or (has_end(items) and is_ground(items))


def _place(number: Any) -> int | None:
    """A number of characters; None while it is open.

    Raises:
        Undefined: it is no whole number from 0 on.
    """
    if not is_known(number):
        return None
    if type(number) is not int or number < 0:
        raise no_meaning(_SUB, "a number of characters", number)
    return number


def _sub_atom(atom: Any, before: Any, length: Any, after: Any, part: Any) -> Outcome:
    text = text_of(_SUB, atom)
    start, size, rest = _place(before), _place(length), _place(after)
    if is_known(part):
        return _found(text, text_of(_SUB, part))
    spans = _spans(len(text), start, size, rest)
    return ((None, at, end - at, len(text) - end, checked(text[at:end])) for at, end in spans)


def _found(text: str, part: str) -> Iterator[Values]:
    at = text.find(part)
    while at >= 0:
        yield None, at, len(part), len(text) - at - len(part), None
        at = text.find(part, at + 1)


def _spans(whole: int, start: int | None, size: int | None, rest: int | None) -> Iterator[tuple[int, int]]:
    """Where a part can begin and end, given what is known of the numbers of characters before, in and after it."""
    end = None if rest is None else whole - rest
    if start is None and end is not None and size is not None:
        start = end - size
    starts = range(whole + 1) if start is None else (start,)
    for at in starts:
        ends = (end,) if end is not None else (at + size,) if size is not None else range(at, whole + 1)
        for to in ends:
            if 0 <= at <= to <= whole and (size is None or to - at == size):
                yield at, to


def _number_in(text: str) -> int | float | None:
    """The number that a text spells, perhaps with a sign; None where it spells none."""
    found = number_in(text[1:] if text[:1] in ("+", "-") else text)
    return -found if found is not None and text[0] == "-" else found


def _atom_number(atom: Any, number: Any) -> Outcome:
    if not is_known(atom):
        if type(number) is not int and type(number) is not float:
            raise no_meaning("atom_number/2", "a number", number)
        return number_text(number), None
    if type(atom) is not str and not is_known(number):
        raise no_meaning("atom_number/2", "an atom", atom)
    if is_known(number) and type(number) is not int and type(number) is not float:
        raise no_meaning("atom_number/2", "a number", number)
    found = _number_in(text_of("atom_number/2", atom))
    return None if found is None else (None, found)


def _characters(name: str, items: Any) -> str:
    """The text that a list of characters or codes spells.

    Raises:
        Undefined: something else is in it.
    """
    found: list[str] = []
    for item in map(deref, proper_items(name, items)):
        if type(item) is str and len(item) == 1:
            found.append(item)
        elif type(item) is int and 0 <= item < 0x110000:
            found.append(chr(item))
        else:
            raise no_meaning(name, "characters or codes", item)
    return checked("".join(found))


def _spelt(text: str) -> str:
    """A text whose characters become items."""
    if len(text) > SMALL:
        charge(len(text))
    return text


def _spelling(name: str, item_of: Callable[[str], Any]) -> Builtin:
    def run(atom: Any, items: Any) -> Outcome:
        if is_known(atom):
            return None, make_list(map(item_of, _spelt(text_of(name, atom))))
        return _characters(name, items), None

    return Builtin(run, _spelt_known)


def _number_codes(number: Any, codes: Any) -> Outcome:
    if is_known(number) and type(number) is not int and type(number) is not float:
        raise no_meaning("number_codes/2", "a number", number)
    if is_known(number) and not (has_end(codes) and is_ground(codes)):
        return None, make_list(map(ord, _spelt(number_text(number))))
    found = _number_in(_characters("number_codes/2", codes))
    if found is None:
        raise no_meaning("number_codes/2", "the codes of a number", codes)
    return found, None


def _char_code(char: Any, code: Any) -> Outcome:
    if is_known(char):
        if type(char) is not str or len(char) != 1:
            raise no_meaning("char_code/2", "a character", char)
        return None, ord(char)
    if type(code) is not int or not 0 <= code < 0x110000:
        raise no_meaning("char_code/2", "the code of a character", code)
    return chr(code), None


def _cased(name: str, change: Callable[[str], str]) -> Builtin:
    return Builtin(lambda atom, _: (None, change(_spelt(text_of(name, atom)))), _first_known)


def _each(change: Callable[[str], str]) -> Callable[[str], str]:
    """A change of case character by character, as in SWI-Prolog: one that would become two stays as it is."""
    return lambda text: "".join(changed if len(changed := change(c)) == 1 else c for c in text)


CHARACTERS = {
    ("sub_atom", 5): Builtin(_sub_atom, _first_known),
    ("atom_number", 2): Builtin(_atom_number, _either_known),
    ("atom_chars", 2): _spelling("atom_chars/2", str),
    ("atom_codes", 2): _spelling("atom_codes/2", ord),
    ("number_codes", 2): Builtin(_number_codes, _spelt_known),
    ("char_code", 2): Builtin(_char_code, _either_known),
    ("upcase_atom", 2): _cased("upcase_atom/2", _each(str.upper)),
    ("downcase_atom", 2): _cased("downcase_atom/2", _each(str.lower)),
}
