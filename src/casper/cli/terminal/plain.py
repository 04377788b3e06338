"""Plain signs: no character ends the program, and no text of a domain tells the terminal what to do.

A stream that cannot write our signs (✔, bars, lines of trees) gets plain ones for them, `SIGNS`, and escapes for all
else.
"""

from __future__ import annotations

import codecs
import io
import os
import sys
import unicodedata

SIGNS = {
    **dict.fromkeys("█▉▊▋▌", "#"), **dict.fromkeys("▍▎▏", " "),  # bars keep their width
    **dict.fromkeys("─╼╾━", "-"), **dict.fromkeys("│├╟╽┃┆", "|"), **dict.fromkeys("└╙", "`"),
    "✔": "+", "✘": "x", "★": "*", "▷": ">", "→": "->", "…": "...", "·": ".", "⋮": ":", "–": "-", "−": "-",
    "●": "*", "✗": "x", "○": "o", "◌": "~",  # the marks of plan trees
    "‘": "'", "’": "'", "“": '"', "”": '"', "×": "x", "⁻": "-",
}  # fmt: skip
"""What stands for a sign on a terminal, or in a file, that cannot hold it."""

_HANDLER = "casper.signs"
_MISLEADING = frozenset(
    "\u061c\u200e\u200f\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069"  # turn the direction of writing
    "\u2028\u2029"
)


def visible(text: str, keep: str = "\n") -> str:
    r"""The text with what a terminal obeys instead of showing it spelt out: an escape character becomes ``\x1b``."""
    if text.isascii() and text.isprintable():
        return text
    return "".join(c if c in keep or not _is_obeyed(c) else _spelt(c) for c in text)


def _is_obeyed(character: str) -> bool:
    return character in _MISLEADING or unicodedata.category(character) in ("Cc", "Cs")


def _spelt(character: str) -> str:
    return character.encode("unicode_escape").decode("ascii")


def _plain(mistake: UnicodeError) -> tuple[str, int]:
    """The error handler of our streams: plain signs for what the encoding cannot hold."""
    if not isinstance(mistake, UnicodeEncodeError):
        raise mistake
    unwritable = mistake.object[mistake.start : mistake.end]
    return "".join(SIGNS.get(c) or _spelt(c) for c in unwritable), mistake.end


def settle_streams() -> None:
    """Let no character end the program: neither one that a stream cannot write, nor a byte that it cannot read."""
    codecs.register_error(_HANDLER, _plain)
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        if getattr(sys, name) is None:  # whoever started the program has closed it
            setattr(sys, name, open(os.devnull, mode, encoding="utf-8"))  # noqa: SIM115
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors=_HANDLER)
    if isinstance(sys.stdin, io.TextIOWrapper):
        sys.stdin.reconfigure(errors="surrogateescape")
