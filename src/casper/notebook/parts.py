"""What several things are shown by: printed lines in their colours, tables, shares as bars, chips."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from casper.kb.text.lines import Line
from casper.notebook.markup import NOTHING, Markup, joined, tag


def lines_html(lines: Iterable[Line]) -> Markup:
    """What `print` shows, with roles as classes."""
    shown = [
        joined(tag("span", span.text, class_=span.role) if span.role != "plain" else span.text for span in spans)
        for spans in lines
    ]
    return tag("pre", joined(part for line in shown for part in (line, "\n"))) if shown else NOTHING


def number(value: float, digits: int = 2) -> Markup:
    """A number rounded for the eye; the exact one is beside it, as in the JSON."""
    return tag("data", f"{value:.{digits}f}", value=repr(value), title=repr(value))


def bar(share: float) -> Markup:
    """A share from 0 to 1 as a bar."""
    wide = 100 * max(0.0, min(1.0, share))
    return tag("span", tag("i", style=f"width:{wide:.4f}%"), class_="bar")


def table(rows: Iterable[Sequence[object]], heading: Sequence[object] = ()) -> Markup:
    """Rows of cells, perhaps under a heading."""
    head = [tag("tr", *(tag("th", cell) for cell in heading))] if heading else []
    body = (tag("tr", *(tag("td", cell) for cell in row)) for row in rows)
    return tag("table", *head, *body, class_="rows")  # with a class, for pages dress up tables that have none


def chips(texts: Iterable[str], kind: str = "chip") -> Markup:
    """Actions side by side."""
    return joined(tag("span", tag("code", text), class_=kind) for text in texts)


def listed(items: Iterable[object]) -> Markup:
    """One below the other."""
    return tag("ul", *(tag("li", item) for item in items))


def folded(title: object, *content: object, is_open: bool = True) -> Markup:
    """Something under a title that one can fold."""
    return tag("details", tag("summary", title), *content, open="" if is_open else None)
