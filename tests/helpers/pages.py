"""Pages of Markdown as data: their code blocks, each with its line, language, title, and why it is not run, if so.

A block is fenced and says its language. What cannot be run, or shows what is no program, has a comment right above:

    <!-- not run: a drawing -->

What a page takes for granted is in a comment, and is run as a block is: ``<!-- given: python`` (or with a title), the
text, and ``-->``.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted(DOCS.rglob("*.md"))]
_FENCE = re.compile(r"^(?P<indent> *)(?P<fence>```+|~~~+)(?P<info>.*)$")
_GIVEN = re.compile(r"^<!-- given: (?P<info>.+)$")
_NOT_RUN = re.compile(r"^ *<!-- not run: (?P<why>.+) -->$")
_TITLE = re.compile(r'title="(?P<title>[^"]+)"')
_LINK = re.compile(r"!?\[[^\]]*\]\((?P<target>[^)\s]+)(?: \"[^\"]*\")?\)")


@dataclass(frozen=True)
class Block:
    """A code block. ``title`` is the file that it is, ``why`` says why it is not run; both may be empty."""

    page: str
    line: int
    language: str
    title: str
    text: str
    why: str

    @property
    def place(self):
        return f"{self.page}:{self.line}"


def name_of(page):
    return str(page.relative_to(ROOT))


def blocks_of(page):
    """The blocks of a page, in order.

    Raises:
        AssertionError: a block that is not fenced, or says no language.
    """
    found, lines, at = [], page.read_text().splitlines(), 0
    while at < len(lines):
        opened = _FENCE.match(lines[at]) or _GIVEN.match(lines[at])
        if opened is None:
            _refuse_indented(page, lines, at)
            at += 1
            continue
        closing = opened["fence"] if "fence" in opened.groupdict() else "-->"
        end = next(n for n in range(at + 1, len(lines)) if lines[n].strip() == closing)
        info, cut = opened["info"].strip(), len(lines[at]) - len(lines[at].lstrip())
        assert info, f"{name_of(page)}:{at + 1}: a block without a language"
        above = _NOT_RUN.match(lines[at - 1]) if at else None
        title = _TITLE.search(info)
        text = "".join(f"{line[cut:]}\n" for line in lines[at + 1 : end])
        block = Block(
            name_of(page), at + 2, info.split()[0], title["title"] if title else "", text, above["why"] if above else ""
        )
        found.append(block)
        at = end + 1
    return found


def _refuse_indented(page, lines, at):
    starts = at and not lines[at - 1].strip() and re.match(r" {4,}\S", lines[at])
    before = next((line for line in reversed(lines[:at]) if line.strip() and not line.startswith("    ")), "")
    in_list = re.match(r" *([-*]|\d+\.) |!!!|\?\?\?|===", before)
    assert not starts or in_list, f"{name_of(page)}:{at + 1}: a block that is not fenced says no language"


def links_of(page):
    """The targets of links and pictures, outside of code."""
    kept, inside = [], False
    for line in page.read_text().splitlines():
        if _FENCE.match(line):
            inside = not inside
        elif not inside:
            kept.append(re.sub(r"`[^`]*`", "", line))
    return [match["target"] for match in _LINK.finditer("\n".join(kept))]
