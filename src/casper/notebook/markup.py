"""Tags: the one place where text becomes HTML or SVG, and every text in it is escaped.

    >>> tag("b", "x < y", title='"')
    '<b title="&quot;">x &lt; y</b>'

Colours are the text's own (`currentColor`), lighter, or of a middle brightness that can be read on white and on black.
"""

from __future__ import annotations

from collections.abc import Iterable
from html import escape
from typing import Final

from casper.kb.text.lines import visible


class Markup(str):
    """Text that is HTML or SVG already."""

    __slots__ = ()


NOTHING: Final = Markup("")
_EMPTY = frozenset({"br", "rect", "line", "polyline", "path", "circle"})

STYLE: Final = Markup("""<style>
.casper{--share:#3a86c8;--good:#2f9e5f;--bad:#d64a5f;--warn:#c4850c;
--faint:color-mix(in srgb,currentColor 62%,transparent);
--rule:color-mix(in srgb,currentColor 24%,transparent);--soft:color-mix(in srgb,currentColor 7%,transparent);
font:13px/1.5 system-ui,sans-serif;color:inherit;max-width:60em}
.casper code,.casper pre,.casper svg text{font:12px/1.5 ui-monospace,"DejaVu Sans Mono",Menlo,Consolas,monospace}
.casper code,.casper pre{background:none;color:inherit;padding:0;margin:0;border:0;white-space:pre-wrap}
.casper .strong,.casper h4{font-weight:600}.casper h4{font-size:13px;margin:.2em 0}.casper p{margin:.3em 0}
.casper .faint{color:var(--faint)}.casper .outcome{font-weight:600}
.casper .good,.casper .outcome{color:color-mix(in srgb,var(--good) 70%,currentColor)}
.casper .bad,.casper .error{color:color-mix(in srgb,var(--bad) 70%,currentColor)}
.casper .warning,.casper .grasp{color:color-mix(in srgb,var(--warn) 70%,currentColor)}
.casper .share,.casper .note,.casper .walk{color:color-mix(in srgb,var(--share) 70%,currentColor)}
.casper table{border-collapse:collapse;border:0;margin:.3em 0;font-size:13px;display:table}
.casper tr,.casper tbody tr:nth-child(odd){background:none}
.casper td,.casper th{padding:.1em .7em .1em 0;border:0;text-align:left;vertical-align:top;min-width:0;
max-width:none;white-space:normal}
.casper th{font-weight:600;border-bottom:1px solid var(--rule)}
.casper .bar{display:block;width:11em;height:.8em;margin-top:.35em;background:var(--soft);border-radius:2px}
.casper .bar i{display:block;height:100%;background:var(--share);border-radius:2px}
.casper ul{list-style:none;margin:0 0 0 .45em!important;padding:0 0 0 .9em!important;border-left:1px solid var(--rule)}
.casper li{margin:.1em 0!important}.casper details{border:0;padding:0!important;margin:.1em 0!important;background:none;
box-shadow:none;font-size:inherit}.casper summary{display:list-item;cursor:pointer;list-style:disclosure-closed inside;
margin:0!important;padding:0!important;min-height:0;background:none;font-weight:inherit;border:0}
.casper details[open]>summary{list-style-type:disclosure-open}.casper summary::marker{color:var(--faint)}
.casper summary::before,.casper summary::after{display:none}
.casper .chip{display:inline-block;padding:.1em .6em;margin:.15em .3em .15em 0;border:1px solid var(--rule);
border-radius:1em}.casper .chip.ours{border-color:var(--good)}
.casper svg{display:block;max-width:100%;height:auto;margin:.3em 0;overflow:visible}
</style>""")
"""Of everything here; each output has it, for a notebook shows each on its own."""


def text(value: object) -> Markup:
    """A text, escaped, and with characters that a page would obey instead of showing them spelt out."""
    return value if isinstance(value, Markup) else Markup(escape(visible(str(value), keep="\n\t")))


def joined(parts: Iterable[object]) -> Markup:
    """The parts side by side."""
    return Markup("".join(map(text, parts)))


def tag(name: str, *children: object, **attributes: object) -> Markup:
    """An element. A child that is no `Markup` is escaped, and so is every attribute; one that is None is left out.

    ``_`` in an attribute's name is ``-``, and ``class_`` is ``class``.
    """
    given = ((key.rstrip("_").replace("_", "-"), value) for key, value in attributes.items() if value is not None)
    written = "".join(f' {key}="{text(value)}"' for key, value in given)
    if name in _EMPTY and not children:
        return Markup(f"<{name}{written}/>")
    return Markup(f"<{name}{written}>{joined(children)}</{name}>")


def page(*children: object) -> str:
    """What a notebook is given: everything in one element that has the style."""
    return str(tag("div", STYLE, *children, class_="casper"))
