"""What all pictures share: a size, how wide a text is, and how a picture stands on its own."""

from __future__ import annotations

from typing import Final
from unicodedata import east_asian_width

from casper.notebook.markup import Markup, tag

ADVANCE = 7.25  # pixels a letter of 12 pixels takes in a monospaced font
_ALONE: Final = Markup("""<style>
svg{color:#1c1c1c;background:#fff;--share:#3a86c8;--good:#2f9e5f;--bad:#d64a5f;--faint:#666;--rule:#bbb;--soft:#f2f2f2}
@media(prefers-color-scheme:dark){svg{color:#e6e6e6;background:#181818;--faint:#9a9a9a;--rule:#555;--soft:#2a2a2a}}
text{font:12px ui-monospace,"DejaVu Sans Mono",Menlo,Consolas,monospace}
</style>""")


def wide(text: str) -> float:
    """How many pixels a text takes, about."""
    return ADVANCE * sum(2 if east_asian_width(c) in "WF" else 1 for c in text)


def picture(width: float, height: float, *children: object) -> Markup:
    """A picture of so many pixels, for a page whose colours it takes."""
    wide_, high = round(width), round(height)
    box = f"0 0 {wide_} {high}"
    space = "http://www.w3.org/2000/svg"
    return tag("svg", *children, xmlns=space, viewBox=box, width=wide_, height=high, role="img")


def alone(drawn: Markup) -> str:
    """A picture that brings its own colours, light or dark as the reader has chosen."""
    head, _, rest = drawn.partition(">")
    return f"{head}>{_ALONE}{rest}"
