"""Plain signs: no character ends the program, and no text of a domain tells the terminal what to do.

A stream that cannot write our signs (✔, bars, lines of trees) gets plain ones for them, `SIGNS`, and escapes for all
else.
"""

from __future__ import annotations

import codecs
import io
import os
import sys

from casper.kb.text.lines import spelt
from casper.kb.text.lines import visible as visible

SIGNS = {
    **dict.fromkeys("█▉▊▋▌", "#"), **dict.fromkeys("▍▎▏", " "),  # bars keep their width
    **dict.fromkeys("─╼╾━", "-"), **dict.fromkeys("│├╟╽┃┆", "|"), **dict.fromkeys("└╙", "`"),
    "✔": "+", "✘": "x", "★": "*", "▷": ">", "→": "->", "…": "...", "·": ".", "⋮": ":", "–": "-", "−": "-",
    "●": "*", "✗": "x", "○": "o", "◌": "~",  # the marks of plan trees
    "‘": "'", "’": "'", "“": '"', "”": '"', "×": "x", "⁻": "-",
}  # fmt: skip
"""What stands for a sign on a terminal, or in a file, that cannot hold it."""

_HANDLER = "casper.signs"


def _plain(mistake: UnicodeError) -> tuple[str, int]:
    """The error handler of our streams: plain signs for what the encoding cannot hold."""
    if not isinstance(mistake, UnicodeEncodeError):
        raise mistake
    unwritable = mistake.object[mistake.start : mistake.end]
    return "".join(SIGNS.get(c) or spelt(c) for c in unwritable), mistake.end


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
