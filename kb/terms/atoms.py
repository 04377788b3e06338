"""Characters, atoms and numbers as they are written: which names need no quotes, what is escaped within them.

Letters and signs beyond ASCII are those of SWI-Prolog: ``éclair`` is a name, ``Ünal`` a variable, ``→`` a sign.
"""

from __future__ import annotations

import re
import unicodedata

NIL = "[]"
_LONG, _AT_ONCE = 13_000, 4_000  # bits from which an integer is written in parts; digits of a part
SIGNS = "#$&*+-./:<=>?@\\^~"
_PLAIN = re.compile(r"[a-z][A-Za-z0-9_]*\Z")
_ESCAPED = {"\\": "\\\\", "\n": "\\n", "\t": "\\t", "\r": "\\r", "\a": "\\a", "\b": "\\b", "\f": "\\f", "\v": "\\v"}


def is_start(letter: str) -> bool:
    """Whether a name or a variable can start with the letter."""
    return letter.isalpha() or (letter.isidentifier() and letter != "_")


def is_capital(letter: str) -> bool:
    """Whether what starts with the letter is a variable."""
    return letter == "_" or letter.isupper()


def goes_on(letter: str) -> bool:
    """Whether a name or a variable can go on with the letter."""
    return letter.isalpha() or (f"a{letter}".isidentifier() and letter != "·")


def is_sign(letter: str) -> bool:
    """Whether names are made of such signs: ``→`` as well as ``+``."""
    if letter < "\x80":
        return letter in SIGNS
    return unicodedata.category(letter)[0] in "PS"


def is_word(atom: str) -> bool:
    """Whether an atom is a plain name, which needs no quotes: letters, digits and ``_``, a small letter first."""
    if _PLAIN.match(atom):
        return True
    return bool(atom) and is_start(atom[0]) and not is_capital(atom[0]) and all(map(goes_on, atom))


def is_signs(atom: str) -> bool:
    """Whether an atom is a name made of signs, such as ``=:=``."""
    return bool(atom) and atom != "." and not atom.startswith("/*") and all(map(is_sign, atom))


def quoted(atom: str, quote: str = "'", doubled: bool = False) -> str:
    """An atom in quotes, on one line; a quote within is escaped, or doubled."""
    inside = quote * 2 if doubled else f"\\{quote}"
    return f"{quote}{''.join(inside if c == quote else _escaped(c) for c in atom)}{quote}"


def _escaped(character: str) -> str:
    if character in _ESCAPED:
        return _ESCAPED[character]
    return character if character.isprintable() else f"\\x{ord(character):X}\\"


def number_text(number: int | float) -> str:
    """A number as SWI-Prolog writes it: the fewest digits that read in again as the same, and never ``1e5``."""
    if isinstance(number, int) and number.bit_length() > _LONG:
        return _digits(number)
    if isinstance(number, bool) or not isinstance(number, float) or number in (float("inf"), float("-inf")):
        return str(number)
    if number != number:
        return "nan"
    sign, digits, point = _decimal(number)
    if point <= -4 or (len(digits) <= point and point > 15):
        return f"{sign}{digits[0]}.{digits[1:] or '0'}e{point - 1:+d}".replace("e-", "e-")
    if point <= 0:
        return f"{sign}0.{'0' * -point}{digits}"
    if len(digits) > point:
        return f"{sign}{digits[:point]}.{digits[point:]}"
    return f"{sign}{digits}{'0' * (point - len(digits))}.0"


def _digits(number: int) -> str:
    """An integer of more digits than Python writes at once."""
    parts, rest = [], abs(number)
    while rest:
        rest, part = divmod(rest, 10**_AT_ONCE)
        parts.append(str(part).rjust(_AT_ONCE, "0") if rest else str(part))
    return ("-" if number < 0 else "") + "".join(reversed(parts))


def _decimal(number: float) -> tuple[str, str, int]:
    """A sign, the fewest digits, and where the point stands before or among them: 12.5 is '', '125', 2."""
    sign = "-" if repr(number).startswith("-") else ""
    mantissa, _, exponent = repr(abs(number)).partition("e")
    whole, _, fraction = mantissa.partition(".")
    fraction = "" if fraction == "0" else fraction
    digits = (whole + fraction).lstrip("0")
    point = len(whole) - (len(whole + fraction) - len(digits)) + int(exponent or 0)
    return sign, digits.rstrip("0") or "0", point if digits else 1
