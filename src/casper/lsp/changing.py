"""Renaming, everywhere in a domain; and repairs of what was misspelt."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from difflib import SequenceMatcher
from pathlib import Path

from casper.kb.errors import CasperError
from casper.kb.terms.syntax import atom_text
from casper.kb.text.parsing.tokens import VARIABLE, sentences_of
from casper.lsp.documents import Document
from casper.lsp.names import Name
from casper.lsp.workspace import Domain, Use

_MEANT = re.compile(r"did you mean (\{?[^?]+?\}?)\?")
_ALONE = re.compile(r"^(.+?) stands? only once here")
LEAST_ALIKE = 0.5


@dataclass(frozen=True, slots=True)
class Edit:
    """A piece of a text, and what stands there instead."""

    path: Path
    start: int
    end: int
    text: str


def uses_of(domain: Domain, doc: Document, offset: int) -> list[Use]:
    """Every use of what stands at an offset: of a variable in its clause, of anything else in the domain."""
    found = doc.name_at(offset)
    if found is None:
        return []
    start, name = found
    if name.role != "variable":
        return domain.uses.get(domain.symbol(name), [])
    piece = doc.piece_at(start)
    names = () if piece is None else piece[1].names
    same = (n for n in names if n.role == "variable" and n.name == name.name)
    return [Use(doc, n, start + n.start, start + n.end) for n in same]


def renamed(domain: Domain, doc: Document, offset: int, new: str) -> list[Edit]:
    """What must change for a name to be another one everywhere.

    Raises:
        CasperError: there is no name, the new one cannot stand there, or it is taken.
    """
    found = doc.name_at(offset)
    if found is None:
        raise CasperError("there is no name here")
    name, new = found[1], new.strip()
    if name.role == "variable":
        taken = {n.name for n in _of_piece(doc, found[0]) if n.role == "variable"}
        if not _is_variable(new) or new == "_":
            raise CasperError(f"{new} is no variable: it starts with a capital letter or with _")
        if new in taken - {name.name}:
            raise CasperError(f"{new} is another variable of this clause already")
        written = new
    else:
        written = _checked(domain, name, new)
    edits = [Edit(use.doc.path, use.start, use.end, written) for use in uses_of(domain, doc, offset)]
    return edits + (_in_sentence(doc, found[0], name.name, new) if name.role == "variable" else [])


def _checked(domain: Domain, name: Name, new: str) -> str:
    """How the new name is written, if it may be taken."""
    symbol = domain.symbol(name)
    if domain.is_system(symbol):
        raise CasperError(f"{name.name} has a meaning to the system, and keeps its name")
    if not new or _is_variable(new) or "\n" in new:
        raise CasperError(f"{new or 'nothing'} is no name: it starts with a small letter, or stands in quotes")
    for use in domain.uses.get(symbol, ()):
        if domain.is_foreign(use.doc):
            raise CasperError(f"{name.name} stands in {use.doc.path.name}, which comes with casper, and keeps its name")
    plain = new[1:-1] if len(new) > 1 and new[0] == new[-1] and new[0] in "'\"" else new
    if (plain, symbol[1]) in domain.uses and plain != name.name:
        other = plain if symbol[1] is None else f"{plain}/{symbol[1]}"
        raise CasperError(f"there is a {other} already: the two would be one")
    return atom_text(plain)


def _is_variable(text: str) -> bool:
    tokens = next(iter(sentences_of(text)), None)
    return tokens is not None and tokens.kinds[0] == VARIABLE and tokens.texts[0] == text


def _of_piece(doc: Document, start: int) -> tuple[Name, ...]:
    piece = doc.piece_at(start)
    return () if piece is None else piece[1].names


def _in_sentence(doc: Document, start: int, old: str, new: str) -> list[Edit]:
    """The places of a variable in the sentence of a say: ``{X}``."""
    piece = doc.piece_at(start)
    if piece is None or not piece[1].text.lstrip().startswith("say"):
        return []
    places = re.finditer(r"(?<!\{)\{\s*(" + re.escape(old) + r")\s*\}", piece[1].text)
    return [Edit(doc.path, start + found.start(1), start + found.end(1), new) for found in places]


# --- repairs --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Repair:
    """What would mend a finding: a title, and the change."""

    title: str
    edit: Edit


def repairs_of(doc: Document, start: int, end: int, message: str) -> Iterator[Repair]:
    """Repairs of a finding between two offsets: the name that was meant, or a variable that is marked as alone."""
    alone = _ALONE.match(message)
    if alone is not None:
        yield from _marked(doc, start, re.split(r", | and ", alone[1]))
    for meant in _MEANT.findall(message):
        edit = _misspelt(doc, start, end, message.partition("did you mean")[0], meant)
        if edit is not None:
            yield Repair(f"write {meant}", edit)


def _marked(doc: Document, offset: int, variables: list[str]) -> Iterator[Repair]:
    found = doc.piece_at(offset)
    for at, name in () if found is None else ((found[0], n) for n in found[1].names):
        if name.role == "variable" and name.name in variables:
            where = (doc.path, at + name.start, at + name.end)
            yield Repair(f"write _{name.name}", Edit(*where, f"_{name.name}"))
            yield Repair(f"write _ for {name.name}", Edit(*where, "_"))


def _misspelt(doc: Document, start: int, end: int, said: str, meant: str) -> Edit | None:
    """The text that should be what was meant: the one most alike of those that the finding speaks of."""
    piece = doc.piece_at(start)
    first, last = (start, end) if piece is None else (piece[0], piece[0] + len(piece[1].text))
    words = set(re.findall(r"\w+", said))
    pattern = r"\{\s*\w+\s*\}" if meant.startswith("{") else r"\w+"
    best: tuple[float, Edit] | None = None
    for found in re.finditer(pattern, doc.text[first:last]):
        if found[0].strip("{} ") in words and found[0] != meant:
            alike = SequenceMatcher(None, found[0], meant).ratio() + (first + found.start() >= start) / 100
            if alike >= LEAST_ALIKE and (best is None or alike > best[0]):
                best = alike, Edit(doc.path, first + found.start(), first + found.end(), meant)
    return None if best is None else best[1]
