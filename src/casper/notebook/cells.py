"""The domain of a notebook: a shipped one or a folder to begin with, and clauses from cells.

A cell that is run again takes the place of what it said before, so a domain never has a clause twice because somebody
pressed a key twice; a mistake in a cell leaves the domain as it was.
"""

from __future__ import annotations

from pathlib import Path

from casper.engine.domain.domain import FILES, ONTOLOGY, SHIPPED, Domain, build, find_domain
from casper.kb.terms.clauses import Sentence
from casper.kb.text.files import is_there
from casper.kb.text.reader import read_text
from casper.kb.text.sources import Sources

NAME = "notebook"


class Cells:
    """What a notebook has said so far; ``domain`` is what that means."""

    def __init__(self) -> None:
        self._base: dict[str, list[Sentence]] = {}
        self._cells: dict[str, list[Sentence]] = {}
        self.domain = Domain.from_text("", name=NAME)

    def begin_with(self, name: str) -> Domain:
        """Begin anew with a shipped domain, or a folder.

        Raises:
            CasperError: as `Domain.load`.
        """
        self.domain = Domain.load(name)
        folder, sources = find_domain(name), Sources((SHIPPED,))
        self._base = {file: sources.sentences(folder / file) for file in FILES if is_there(folder / file)}
        self._cells = {}
        return self.domain

    def take(self, key: str, text: str, place: str) -> Domain:
        """Let a cell say this, and nothing else any more.

        Args:
            key: which cell it is.
            text: its clauses.
            place: what proofs and mistakes call it.

        Raises:
            CasperError: a mistake in the text, or in what the cells mean together; the domain stays as it was.
        """
        cells = {**self._cells, key: read_text(text, place)}
        said = [sentence for sentences in cells.values() for sentence in sentences]
        stated = {ONTOLOGY: [], **self._base, f"<{NAME}>": said}
        self.domain = build(self.domain.name, Path(f"<{NAME}>"), stated)
        self._cells = cells
        return self.domain
