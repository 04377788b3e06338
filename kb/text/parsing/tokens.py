"""Tokens: what a text is made of, told apart by one regular expression; quotes and numbers, and what they stand for.

Letters and signs beyond ASCII are those of SWI-Prolog: ``éclair`` is a name, ``Ünal`` a variable, ``→`` a sign.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from casper.kb.terms.atoms import goes_on, is_capital, is_sign, is_start

NAME, QUOTED, CODES, VARIABLE, NUMBER, PUNCTUATION = "name", "quoted", "codes", "variable", "number", "punctuation"
END, NOTHING, MISTAKE = "end", "nothing", "mistake"  # a full stop, the end of the text, what is no token

COMMENT = r"%[^\n]*+|/\*[^*]*+(?:\*(?!/)[^*]*+)*\*/"
SIGNS = r"[#$&*+\-./:<=>?@\\^~]"
STOP = r"\.(?=\s|%|\Z)"
_ASCII = r"(?![^\x00-\x7f])"
ESCAPE = r"\\(?:x[0-9a-fA-F]++\\?|[0-7]++\\?|u[0-9a-fA-F]{4}|U[0-9a-fA-F]{8}|[\s\S])"
_QUOTES = "|".join(rf"{quote}(?:[^{quote}\\\n]++|{ESCAPE}|{quote}{quote})*+{quote}" for quote in "'\"`")
_CODE = rf"0'(?:{ESCAPE}|''|[^\\\n])"
_NUMBER = rf"""{_CODE}|0x[0-9a-fA-F]++|0o[0-7]++|0b[01]++|\d{{1,2}}'[0-9a-zA-Z]++
    |\d++(?:\.\d++(?:[eE][+\-]?\d++|Inf|NaN)?|[eE][+\-]?\d++)|\d++r\d++|\d++(?:_\d++)*+"""
_ALONE = re.compile(_NUMBER, re.VERBOSE)
WITHIN = rf"{COMMENT}|{_QUOTES}|{_CODE}|\d++\.\d++"
"""Tokens within which a full stop ends nothing."""
OTHERS = rf"(?!{STOP}|/\*){SIGNS}++|[^\x00-\x7f\w\s]++{SIGNS}*+|[^'\"`#$&*+\-./:<=>?@\\^~]"
"""Signs that are no full stop, and what else is no word, blank or quote."""
_TOKEN = re.compile(
    rf"""(?P<blank>(?:\s++|{COMMENT})++)
    |(?P<name>[a-z][a-zA-Z0-9_]*+{_ASCII}|(?!{STOP}|/\*){SIGNS}++{_ASCII}|[!;])
    |(?P<variable>[A-Z_][a-zA-Z0-9_]*+{_ASCII})
    |(?P<punctuation>[()\[\]{{}},|])
    |(?P<number>{_NUMBER})
    |(?P<quoted>{_QUOTES})
    |(?P<end>{STOP})
    |(?P<other>[\s\S])""",
    re.VERBOSE,
)


class Tokens:
    """The tokens of one sentence, its full stop included; after the last there is one of kind ``nothing``."""

    __slots__ = ("kinds", "starts", "texts")

    def __init__(self) -> None:
        self.kinds: list[str] = []
        self.texts: list[str] = []
        self.starts: list[int] = []

    def end(self, at: int) -> int:
        """Where a token ends."""
        return self.starts[at] + len(self.texts[at])

    def close(self, text: str) -> None:
        """Put the end of the text behind the last token, twice: the parser may look one token further."""
        for _ in range(2):
            self.kinds.append(NOTHING)
            self.texts.append("")
            self.starts.append(len(text))


def sentences_of(text: str) -> Iterator[Tokens]:
    """The tokens of each sentence. A mistake is a token, too: the parser tells it if it comes so far."""
    at, match = 0, _TOKEN.match
    tokens = Tokens()
    while (found := match(text, at)) is not None:
        kind, word, start, at = found.lastgroup, found[0], at, found.end()
        if kind == "blank":
            continue
        if kind == "other":
            kind, word = _other(text, start)
            at = start + len(word)
        elif kind == QUOTED and word[0] == "`":
            kind = CODES
        tokens.kinds.append(kind or MISTAKE)
        tokens.texts.append(word)
        tokens.starts.append(start)
        if kind == END:
            tokens.close(text)
            yield tokens
            tokens = Tokens()
    if tokens.kinds:
        tokens.close(text)
        yield tokens


def _other(text: str, at: int) -> tuple[str, str]:
    """The token that starts with, or goes on with, a character beyond ASCII."""
    first = text[at]
    if is_start(first) or first == "_":
        end = at + 1
        while end < len(text) and goes_on(text[end]):
            end += 1
        return (VARIABLE if is_capital(first) else NAME), text[at:end]
    if is_sign(first) and not text.startswith("/*", at):
        end = at + 1
        while end < len(text) and is_sign(text[end]):
            end += 1
        return NAME, text[at:end]
    return MISTAKE, first


# --- what quotes and numbers stand for -------------------------------------------------------------------------------

_ESCAPED = {"n": "\n", "t": "\t", "r": "\r", "a": "\a", "b": "\b", "f": "\f", "v": "\v", "e": "\x1b", "s": " "}
_ESCAPED.update({letter: letter for letter in "\\'\"`"})
_IN_QUOTES = re.compile(
    r"""\\(?:x([0-9a-fA-F]++)\\?|([0-7]++)\\?|u([0-9a-fA-F]{4})|U([0-9a-fA-F]{8})|(\n[^\S\n]*+|c\s*+)|([\s\S]))"""
    r"""|''|""|``"""
)


class Unreadable(ValueError):
    """What a token's text says wrongly; ``at`` counts from its start, ``quoted`` is what the sentence repeats of it."""

    def __init__(self, sentence: str, at: int = 0, quoted: str = "") -> None:
        super().__init__(sentence)
        self.sentence, self.at, self.quoted = sentence, at, quoted


def unquoted(word: str) -> str:
    """The atom between the quotes.

    Raises:
        Unreadable: an escape that is none.
    """
    inner, quote = word[1:-1], word[0]
    if "\\" not in inner and quote not in inner:
        return inner
    return _IN_QUOTES.sub(lambda found: found[0] if found[0][0] not in ("\\", quote) else _meant(found), inner)


def _meant(found: re.Match[str]) -> str:
    """The characters that an escape, or a doubled quote, stands for."""
    hexadecimal, octal, four, eight, skipped, letter = found.groups()
    if skipped is not None:
        return ""
    if letter is not None:
        if letter not in _ESCAPED:
            raise Unreadable(f"\\{letter} stands for nothing; write \\\\ for a backslash", found.start() + 1, letter)
        return _ESCAPED[letter]
    if octal is None and hexadecimal is None and four is None and eight is None:
        return found[0][0]
    code = int(octal, 8) if octal is not None else int(hexadecimal or four or eight, 16)
    if code > 0x10FFFF or 0xD800 <= code <= 0xDFFF:
        raise Unreadable("there is no such character", found.start() + 1)
    return chr(code)


def number(word: str) -> int | float:
    """The value of a number's text.

    Raises:
        Unreadable: it is none that can be dealt with.
    """
    if word.isdigit():
        return _whole(word, 10)
    if word[:2] in ("0x", "0o", "0b"):
        return _whole(word[2:], {"x": 16, "o": 8, "b": 2}[word[1]])
    if word[:2] == "0'":
        return _code_of(word[2:])
    if "'" in word:
        return _with_radix(*word.split("'"))
    if "r" in word:
        raise Unreadable("there are no fractions here; write a decimal number")
    if word.endswith(("Inf", "NaN")):
        raise Unreadable("this is no finite number")
    if "." in word or "e" in word or "E" in word:
        value = float(word)
        if value in (float("inf"), float("-inf")):
            raise Unreadable("this number is too large")
        return value
    return _whole(word.replace("_", ""), 10)


def number_in(text: str) -> int | float | None:
    """The number that a text without a sign spells and nothing else, no blank either; None where it spells none."""
    try:
        return number(text) if _ALONE.fullmatch(text) else None
    except Unreadable:
        return None


def _whole(digits: str, radix: int) -> int:
    try:
        return int(digits, radix)
    except ValueError:  # more digits than Python reads
        raise Unreadable("this number is too large") from None


def _code_of(character: str) -> int:
    if character in ("'", "''"):
        return ord("'")
    return ord(_IN_QUOTES.sub(_meant, character)) if character[0] == "\\" else ord(character)


def _with_radix(radix: str, digits: str) -> int:
    if 2 <= int(radix) <= 36:
        try:
            return int(digits, int(radix))
        except ValueError:
            pass
    raise Unreadable(f"{digits} is no number of radix {radix}", quoted=digits)
