"""Small ontologies for tests: axioms in functional syntax, read, translated and asked."""

from __future__ import annotations

import tempfile
from pathlib import Path

from casper.kb.base import KnowledgeBase
from casper.kb.ontologies.importing import Imported, import_ontologies

PREFIXES = """Prefix(:=<http://z.org/zoo#>)
Prefix(xsd:=<http://www.w3.org/2001/XMLSchema#>)
Prefix(rdfs:=<http://www.w3.org/2000/01/rdf-schema#>)
Prefix(owl:=<http://www.w3.org/2002/07/owl#>)
Prefix(swrlb:=<http://www.w3.org/2003/11/swrlb#>)
Prefix(v:=<urn:swrl:var#>)
"""


def functional(*axioms: str) -> str:
    """A document of the axioms: the first one stands in line 8."""
    return PREFIXES + "Ontology(<http://z.org/zoo>\n" + "\n".join(axioms) + "\n)\n"


def imported(*axioms: str) -> Imported:
    """What becomes of the axioms."""
    return imported_text(functional(*axioms), "ofn")


def imported_text(text: str, suffix: str) -> Imported:
    """What becomes of a document."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / f"zoo.{suffix}"
        file.write_text(text, encoding="utf-8")
        return import_ontologies([file])


def kb_of(*axioms: str) -> KnowledgeBase:
    """The axioms as a knowledge base; every one of them can be said by rules.

    Raises:
        AssertionError: one of them cannot.
    """
    found = imported(*axioms)
    assert [f.message for f in found.findings if f.severity != "note"] == []
    return found.knowledge_base()


def reasons(*axioms: str) -> list[str]:
    """What cannot be said, or is doubtful."""
    return [f.message for f in imported(*axioms).findings]


def broken(kb: KnowledgeBase) -> list[str]:
    """The sentences of the broken constraints, each once."""
    return list(dict.fromkeys(violation.sentence for violation in kb.broken()))


def rows(kb: KnowledgeBase, goal: str) -> list[tuple[object, ...]]:
    """The answers to a goal, sorted."""
    return sorted((tuple(answer.values()) for answer in kb.query(goal)), key=repr)
