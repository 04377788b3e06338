"""What the printers of the commands share: JSON lines, a console that shows texts as they are, bars, plain signs.

Texts of a domain, file names and messages go to the console through `escape`, or with ``markup=False``. A stream that
cannot write our signs (✔, bars, lines of trees) gets plain ones for them, `SIGNS`, and escapes for all else.
"""

from __future__ import annotations

import codecs
import io
import json
import os
import sys
import unicodedata
from typing import Any

from rich.console import Console
from rich.text import Text

from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Term, Variable, as_term, predication

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
    "\u2028\u2029\ufdd0\ufdd1"
)
_GUARDED = {"[": "\ufdd0", "\\": "\ufdd1"}  # noncharacters that no text is shown with: markup never sees the originals
_GUARD = str.maketrans(_GUARDED)
_UNGUARD = str.maketrans({guard: original for original, guard in _GUARDED.items()})


class _Literal(Console):
    """A console whose texts say what is there: no codes of emoji, no control characters obeyed or dropped."""

    def render_str(self, text: str, **options: Any) -> Text:
        rendered = super().render_str(visible(text, keep="\n\ufdd0\ufdd1"), **options)
        rendered.plain = rendered.plain.translate(_UNGUARD)
        return rendered


def console() -> Console:
    """The terminal; plain text when it is none."""
    return _Literal(highlight=False, soft_wrap=True, emoji=False)


def visible(text: str, keep: str = "\n") -> str:
    r"""The text with what a terminal obeys instead of showing it spelt out: an escape character becomes ``\x1b``."""
    if text.isascii() and text.isprintable():
        return text
    return "".join(c if c in keep or not _is_obeyed(c) else _spelt(c) for c in text)


def escape(text: str) -> str:
    """The text for a place within markup, where it is shown as it is (`rich.markup.escape` fails at backslashes)."""
    return visible(text).translate(_GUARD)


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


def print_json(data: dict[str, Any]) -> None:
    r"""One JSON object on one line, at once; with ``\u`` escapes where the output cannot hold its characters."""
    line = json.dumps(data, ensure_ascii=False)
    try:
        line.encode(getattr(sys.stdout, "encoding", None) or "utf-8")
    except UnicodeEncodeError:
        line = json.dumps(data)
    print(line, flush=True)


def json_value(term: Term) -> Any:
    """A term as a JSON value: numbers and atoms as they are, compound terms as text, what may be anything as null."""
    if isinstance(term, Variable):
        return None
    if isinstance(term, tuple):
        return term_text(as_term(predication(term)))
    return term


def bar(share: float, width: int = 10) -> str:
    """A share from 0 to 1 as a bar of blocks, exact to an eighth of a cell."""
    eighths = round(max(0.0, min(1.0, share)) * width * 8)
    full, rest = divmod(eighths, 8)
    return ("█" * full + (" ▏▎▍▌▋▊▉"[rest] if rest else "")).ljust(width)
