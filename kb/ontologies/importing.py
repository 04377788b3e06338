"""The whole way: files of ontologies become a folder of text, and every doubt becomes a finding.

    >>> imported = import_ontologies([Path("zoo.ttl")])                     # doctest: +SKIP
    >>> findings = imported.write(Path("zoo"))                              # doctest: +SKIP
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from casper.kb.base import KnowledgeBase
from casper.kb.checks.finding import Finding, error, finding_of, note, sorted_findings, warning
from casper.kb.errors import CasperError, Place
from casper.kb.ontologies.expressions import Ontology
from casper.kb.ontologies.meaning.translation import Translation, translate
from casper.kb.ontologies.reading.source import read_ontology
from casper.kb.ontologies.vocabulary.anonymous import relabelled
from casper.kb.ontologies.vocabulary.names import renamed
from casper.kb.ontologies.writing import MAIN, NAMES, names_text, ontology_text
from casper.kb.store.loading import loading
from casper.kb.terms.clauses import Directive
from casper.kb.text.files import write_texts
from casper.kb.text.reader import read_blocks
from casper.kb.text.sources import Sources


@dataclass(frozen=True)
class Imported:
    """An ontology as text.

    ``files`` maps file names to their texts; ``findings`` is what was not understood, what no rule can say, and what
    the rules take for granted, each with the file and, where the syntax has lines, the line of the axiom.
    """

    files: dict[str, str]
    findings: list[Finding]

    def knowledge_base(self) -> KnowledgeBase:
        """What the texts say, without writing them."""
        kb = KnowledgeBase()
        with loading():
            for name, text in self.files.items():
                read, blocks = read_blocks(text, name)
                kb.add(s for s in read if not (isinstance(s, Directive) and s.term.functor == "include"))
                kb.add_blocks(blocks)
            kb.compile()
        return kb

    def write(self, folder: Path, *, replace: bool = False) -> list[Finding]:
        """Write the texts, and look whether the ontology contradicts itself.

        Returns:
            All findings; a contradiction is an error that cites the axiom.

        Raises:
            DomainError: the folder has such files already, or cannot be written.
        """
        write_texts(folder, self.files, replace=replace)
        return sorted_findings([*self.findings, *contradictions(folder)])


def import_ontologies(files: Sequence[Path]) -> Imported:
    """Several files as one ontology.

    Raises:
        DomainError, ReadError: as `reading.source.read_ontology`; nothing is made of files that cannot all be read.
    """
    ontology = Ontology()
    for number, file in enumerate(files):
        found = read_ontology(file)
        relabelled(found, lambda label, number=number: f"{number}.{label}")  # type: ignore[misc]
        ontology.merge(found)
    translation = translate(ontology)
    texts = {MAIN: ontology_text(translation), NAMES: names_text(translation)}
    whole = Place(str(files[0]))
    return Imported(texts, sorted_findings(_findings(ontology, translation, whole)))


def _findings(ontology: Ontology, translation: Translation, whole: Place) -> Iterator[Finding]:
    for place, sentence in ontology.puzzles:
        yield warning(place if place.file != Place().file else whole, sentence)
    for place, sentence in translation.refusals:
        make = error if "contradicts itself" in sentence else warning
        yield make(place if place.file != Place().file else whole, sentence)
    for place, sentence in translation.notes:
        yield note(place, sentence)
    for iri, place in ontology.imports:
        if iri not in ontology.iris:
            yield warning(place, f"the ontology needs {iri}, which was not read; give its file, too")
    for iri, name in renamed(translation.vocabulary.names, ontology):
        yield note(whole, f"<{iri}> is called {name} here: its own name is another's, or has a meaning to the system")
    if not ontology.axioms and not ontology.kinds:
        yield warning(whole, "nothing is stated in it")


def contradictions(folder: Path) -> Iterator[Finding]:
    """The axioms that cannot all be so, each told where its constraint stands in the written text."""
    kb = KnowledgeBase()
    try:
        kb.add(Sources().sentences(folder / MAIN))
        for violation in kb.broken():
            clash = ", ".join(str(x.atom) for x in violation.clash if not x.is_comparison)
            yield error(violation.clause.place, f"the ontology contradicts itself: {violation.sentence} ({clash})")
    except CasperError as mistake:
        yield finding_of(mistake, Place(str(folder / MAIN)))
    with suppress(CasperError):  # what fails here has failed above
        yield from _endless(kb)  # it may be why the search above was given up


def _endless(kb: KnowledgeBase) -> Iterator[Finding]:
    """Predicates that cannot be listed, because a rule computes what it needs itself."""
    rules = {c.head.indicator: c for c in kb.clauses if c.body and not c.is_constraint}
    found = [rule for indicator, rule in rules.items() if kb.stored(indicator) is None]
    if found:
        names = ", ".join(f"{name}/{arity}" for name, arity in (rule.head.indicator for rule in found[:3]))
        more = f" and {len(found) - 3} more" if len(found) > 3 else ""
        reason = "a rule computes what it needs itself, so answers are searched for and may be unknown"
        yield warning(found[0].place, f"{names}{more}: {reason}; state the results as facts")
