"""Findings as one types: those of single clauses, names that nobody defines, sentences for nothing, actions of plans.

The whole of ``casper check`` (`lsp.whole`) follows when the typing rests; what it found of clauses that did not change
since is shown on.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

from casper.kb.checks.finding import Finding, Severity, error, finding_of, sorted_findings
from casper.kb.checks.says import wrong_says
from casper.kb.errors import CasperError, Place
from casper.kb.program.refusals import undefined_sentence
from casper.kb.terms.clauses import Indicator, Sentence
from casper.lsp.documents import Document, Piece
from casper.lsp.workspace import Domain
from casper.plans.checks.check import check_plans

MOST_HINTS = 20  # names for which a near one is looked for at once
MOST_PRODUCTIONS = 300  # that are checked at once


def quick_findings(domain: Domain) -> list[Finding]:
    """What is wrong, as far as it can be told at once."""
    found = list(domain.findings)
    for doc in domain.docs:
        for start, piece in doc.pieces:
            found += (doc.moved(finding, start) for finding in piece.findings)
    if not domain.lost:
        found += _undefined(domain)
        found += _of_sentences(domain)
    return sorted_findings(found)


def _undefined(domain: Domain) -> Iterator[Finding]:
    """Every condition whose predicate nobody defines."""
    known, told = domain.known, dict[Indicator, str]()
    for doc in domain.docs:
        for start, piece in doc.pieces:
            for needed, literal in piece.needs:
                name = needed[0]
                if needed in known or name in domain.half_read or name.partition(":")[0] in domain.prefixes:
                    continue
                if needed not in told:
                    near = known if len(told) < MOST_HINTS else ()
                    told[needed] = undefined_sentence(needed, near)
                yield doc.moved(error(literal.place, told[needed]), start)


def _of_sentences(domain: Domain) -> Iterator[Finding]:
    """Of sentences and plans, which are checked as a whole: their clauses, each where it stands."""
    if domain.says:
        whole = [(doc, start, piece) for doc in domain.docs for start, piece in doc.pieces]
        checked = wrong_says(_numbered(tuple(piece for *_, piece in whole)), domain.known, domain.half_read)
        yield from _placed(whole, (f for f in checked if f.severity is not Severity.ERROR))
    plans = [(doc, start, piece) for doc in domain.docs for start, piece in doc.pieces if piece.of_plans]
    if domain.productions and len(domain.productions) <= MOST_PRODUCTIONS:
        verifies = any(doc.path.name == "ontology.pl" for doc in domain.docs)
        steps = {(n.name, n.arity + 1) for *_, piece in plans for n in piece.names if n.arity is not None}
        known = frozenset(steps & domain.known) if verifies else None
        yield from _placed(plans, _of_plans(tuple(piece for *_, piece in plans), known, domain.half_read))


def _placed(pieces: list[tuple[Document, int, Piece]], findings: Iterable[Finding]) -> Iterator[Finding]:
    """Findings of numbered clauses, each where its clause stands."""
    for finding in findings:
        if finding.place.file.isdigit():
            doc, start, _ = pieces[int(finding.place.file)]
            yield doc.moved(finding, start)


def _numbered(pieces: tuple[Piece, ...]) -> list[Sentence]:
    """The sentences of clauses, the file of each being the number of its clause."""
    return [
        replace(sentence, place=Place(str(number), sentence.place.line, sentence.place.column))
        for number, piece in enumerate(pieces)
        for sentence in piece.sentences
    ]


@lru_cache(maxsize=8)
def _of_plans(
    pieces: tuple[Piece, ...], known: frozenset[Indicator] | None, half_read: frozenset[str]
) -> list[Finding]:
    """What is wrong with plans; kept, for most changes are none of theirs."""

    def is_action(indicator: Indicator) -> bool:
        return known is not None and ((indicator[0], indicator[1] + 1) in known or indicator[0] in half_read)

    try:
        return list(check_plans(_numbered(pieces), None if known is None else is_action))
    except CasperError as mistake:
        return [finding_of(mistake)]


@dataclass(frozen=True, slots=True)
class Kept:
    """What the whole check found of a clause: by its text, with places from its start."""

    by_piece: dict[tuple[Path, str], list[Finding]]
    of_files: list[Finding]


def kept(findings: list[Finding], domain: Domain) -> Kept:
    """The findings of the whole check by clause, so that they are shown wherever the clause moves to."""
    docs = {str(doc.path): doc for doc in domain.docs}
    by_piece: dict[tuple[Path, str], list[Finding]] = defaultdict(list)
    of_files = []
    for finding in findings:
        doc = docs.get(finding.place.file)
        found = None
        if doc is not None and finding.place.line:
            found = doc.piece_at(doc.lines.of_place(finding.place.line, finding.place.column))
        if doc is None or found is None:
            of_files.append(finding)
        else:
            by_piece[doc.path, found[1].text].append(_within(finding, doc, *found))
    return Kept(by_piece, of_files)


def still(found: Kept, domain: Domain) -> Iterator[Finding]:
    """What was found of clauses that are still there."""
    yield from found.of_files
    for doc in domain.docs:
        for start, piece in doc.pieces:
            for finding in found.by_piece.get((doc.path, piece.text), ()):
                yield doc.moved(finding, start)


def _within(finding: Finding, doc: Document, start: int, piece: Piece) -> Finding:
    line = doc.text.count("\n", 0, start)
    column = start - (doc.text.rfind("\n", 0, start) + 1)
    place = finding.place
    shift = column if place.line == line + 1 else 0
    return replace(finding, place=Place(place.file, place.line - line, place.column - shift if place.column else 0))
