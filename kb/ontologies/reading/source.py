"""Which syntax a file is in, by its name and its first characters, and its ontology."""

from __future__ import annotations

from pathlib import Path

from casper.kb.errors import DomainError, Place, ReadError
from casper.kb.ontologies.expressions import Ontology
from casper.kb.ontologies.reading import canonical, rdf_axioms
from casper.kb.ontologies.reading.entities import check_entities
from casper.kb.ontologies.reading.functional import read_functional
from casper.kb.ontologies.reading.owl_xml import read_owl_xml
from casper.kb.ontologies.reading.triples import read_triples

SUFFIXES = (".owl", ".rdf", ".ttl", ".nt", ".owx", ".ofn")
_LARGEST = 256 * 2**20  # bytes; a larger file would not fit into the memory as axioms


def read_ontology(file: Path) -> Ontology:
    """What the file says.

    Raises:
        DomainError: it cannot be read, or has a suffix of no ontology.
        ReadError: with the line, where the file goes wrong.
    """
    if file.suffix not in SUFFIXES:
        raise DomainError(f"{file} is no ontology by its name; files end in {', '.join(SUFFIXES)}")
    try:
        if file.stat().st_size > _LARGEST:
            raise DomainError(f"{file} is larger than {_LARGEST >> 20} MiB; split it")
        content = file.read_bytes()
    except OSError as mistake:
        raise DomainError(f"cannot read {file} ({mistake})") from None
    try:
        return _ontology(content, file)
    except RecursionError:
        raise ReadError("an expression is nested too deeply to be read; name its parts", Place(str(file))) from None


def _ontology(content: bytes, file: Path) -> Ontology:
    name, syntax = str(file), _syntax(content, file.suffix)
    if syntax in ("owx", "xml"):
        check_entities(content, name)
    match syntax:
        case "ofn":
            return canonical.ontology_of(read_functional(_text(content, file), name))
        case "owx":
            return canonical.ontology_of(read_owl_xml(content, name))
        case _:
            return rdf_axioms.ontology_of(read_triples(content, syntax, name), name)


def _text(content: bytes, file: Path) -> str:
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as mistake:
        line = content[: mistake.start].count(b"\n") + 1
        raise ReadError("this is no UTF-8; save the file as UTF-8", Place(str(file), line)) from None


def _syntax(content: bytes, suffix: str) -> str:
    """``ofn``, ``owx``, or rdflib's name; .owl and .rdf may hold any of them, as editors save."""
    if suffix in (".ttl", ".nt", ".owx", ".ofn"):
        return {".ttl": "turtle"}.get(suffix, suffix[1:])
    begin = content[:4096].lstrip(b"\xef\xbb\xbf \t\r\n")
    if begin.startswith(b"<"):
        if b"<Ontology" in begin:
            return "owx"
        is_markup = begin.startswith((b"<?xml", b"<!", b"<rdf:RDF")) or b"<rdf:RDF" in begin
        return "xml" if is_markup or b"xmlns" in begin else "turtle"
    return "ofn" if begin.startswith((b"Prefix(", b"Ontology(")) else "turtle"
