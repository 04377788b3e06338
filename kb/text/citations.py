"""Citations: a comment ``%: …`` behind a clause says where it comes from, and proofs show it."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from casper.kb.terms.clauses import Clause, Sentence

MARK = "%:"
_CITATION = re.compile(r"\.\s*%:\s*(\S.*?)\s*$")  # behind the full stop, to the end of the line


def with_citations(sentences: Sequence[Sentence], text: str) -> list[Sentence]:
    """The sentences of a text, each clause with the citation on the line where it begins."""
    lines = text.split("\n")
    return [_cited(sentence, lines) for sentence in sentences]


def _cited(sentence: Sentence, lines: Sequence[str]) -> Sentence:
    line = sentence.place.line
    found = _CITATION.search(lines[line - 1]) if isinstance(sentence, Clause) and 0 < line <= len(lines) else None
    if found is None:
        return sentence
    return replace(sentence, place=replace(sentence.place, citation=found[1]))
