"""A graph of RDF triples that remembers which of them have been understood."""

from __future__ import annotations

import logging
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from functools import cached_property
from typing import TYPE_CHECKING, Any

from casper.kb.errors import Place, ReadError
from casper.kb.ontologies.expressions import RDF, XSD, Anonymous, Iri, Value

if TYPE_CHECKING:
    from rdflib import Graph

_FIRST, _REST, _NIL = f"{RDF}first", f"{RDF}rest", Iri(f"{RDF}nil")


class Misread(Exception):
    """Triples that make no sense together; the message says which."""


class Triples:
    """Triples by subject and by predicate, in a fixed order, with `used` for those that have been understood."""

    def __init__(self, triples: Iterable[tuple[Any, str, Any]]) -> None:
        self._by_subject: dict[Any, dict[str, list[Any]]] = {}
        self._by_predicate: dict[str, list[tuple[Any, Any]]] = {}
        self.used: set[tuple[Any, str, Any]] = set()
        for subject, predicate, value in triples:
            self._by_subject.setdefault(subject, {}).setdefault(predicate, []).append(value)
            self._by_predicate.setdefault(predicate, []).append((subject, value))

    def __iter__(self) -> Iterator[tuple[Any, str, Any]]:
        for predicate, pairs in self._by_predicate.items():
            for subject, value in pairs:
                yield subject, predicate, value

    def pairs(self, predicate: str) -> list[tuple[Any, Any]]:
        """Subjects and values of a predicate."""
        return self._by_predicate.get(predicate, [])

    def of_type(self, kind: Any) -> list[Any]:
        """The subjects that have this type, in order."""
        return self._by_type.get(kind, [])

    @cached_property
    def _by_type(self) -> dict[Any, list[Any]]:
        found: dict[Any, list[Any]] = {}
        for subject, kind in self.pairs(f"{RDF}type"):
            found.setdefault(kind, []).append(subject)
        return found

    def about(self, subject: Any) -> list[tuple[str, Any]]:
        """Every predicate of the subject with its values; all count as used."""
        found = [(p, value) for p, values in self._by_subject.get(subject, {}).items() for value in values]
        self.used.update((subject, predicate, value) for predicate, value in found)
        return found

    def states(self, subject: Any, predicate: str, value: Any) -> bool:
        """Whether the triple is there."""
        return value in self._by_subject.get(subject, {}).get(predicate, ())

    def take(self, predicate: str) -> Iterator[tuple[Any, Any]]:
        """Subjects and values of a predicate that were not used yet; they are now."""
        for subject, value in self.pairs(predicate):
            if (subject, predicate, value) not in self.used:
                self.used.add((subject, predicate, value))
                yield subject, value

    def has(self, subject: Any, predicate: str) -> bool:
        """Whether the subject has a value for the predicate."""
        return predicate in self._by_subject.get(subject, {})

    def values(self, subject: Any, predicate: str) -> list[Any]:
        """The values of a predicate of the subject; they count as used."""
        found = self._by_subject.get(subject, {}).get(predicate, [])
        self.used.update((subject, predicate, value) for value in found)
        return found

    def value(self, subject: Any, predicate: str) -> Any:
        """The only value of a predicate, or None.

        Raises:
            Misread: there are several.
        """
        found = self.values(subject, predicate)
        if len(found) > 1:
            raise Misread(f"there are {len(found)} values of {predicate} where one can be")
        return found[0] if found else None

    def items(self, head: Any) -> list[Any]:
        """The items of an RDF list.

        Raises:
            Misread: it has no end, or no beginning.
        """
        found: list[Any] = []
        seen: set[Any] = set()
        while head != _NIL:
            if head in seen or not self.has(head, _REST):
                raise Misread("a list of RDF has no end")
            seen.add(head)
            found.append(self.value(head, _FIRST))
            self.values(head, f"{RDF}type")
            head = self.value(head, _REST)
        return found


def read_triples(content: bytes, syntax: str, file: str) -> Triples:
    """The triples of a document.

    Args:
        content: the document.
        syntax: rdflib's name for it: ``xml``, ``turtle`` or ``nt``.
        file: its name, for places.

    Raises:
        ReadError: with the line, where the parser tells one.
    """
    from rdflib import Graph

    graph = Graph()
    try:
        with _quiet():
            graph.parse(data=content, format=syntax, publicID=f"file:///{file.rsplit('/', 1)[-1]}")
    except RecursionError:
        raise ReadError("this file is nested too deeply to be read", Place(file)) from None
    except Exception as mistake:  # each of rdflib's parsers has exceptions of its own
        raise _mistake(mistake, content, file, syntax) from None
    return Triples(_plain(graph))


@contextmanager
def _quiet() -> Iterator[None]:
    """Without rdflib's own log of values that are misspelt: they are findings."""
    logger = logging.getLogger("rdflib")
    before = logger.level
    logger.setLevel(logging.CRITICAL)
    try:
        yield
    finally:
        logger.setLevel(before)


def _mistake(mistake: Exception, content: bytes, file: str, syntax: str) -> ReadError:
    lines, said = content.rstrip().count(b"\n") + 1, " ".join(str(mistake).split())
    line = 0
    if hasattr(mistake, "getLineNumber"):  # xml.sax
        line, said = mistake.getLineNumber() or 0, mistake.getMessage()  # type: ignore[attr-defined]
    elif isinstance(getattr(mistake, "lines", None), int):  # Turtle
        line, said = mistake.lines + 1, str(getattr(mistake, "_why", "") or said)  # type: ignore[attr-defined]
    elif isinstance(mistake, IndexError):  # Turtle, where the text ends within a name
        line, said = lines, "it ends in the middle of something"
    elif syntax == "nt":
        line = _faulty_line(content)
    ends = line >= lines
    advice = "the file was cut short; get the whole file" if ends else "mend the file, or save it anew from your editor"
    return ReadError(f"this cannot be read ({said[:120]}): {advice}", Place(file, min(line, lines)))


def _faulty_line(content: bytes) -> int:
    """The first line of N-Triples that cannot be read by itself: each is a sentence of its own."""
    from rdflib import Graph

    for number, line in enumerate(content.split(b"\n"), 1):
        try:
            Graph().parse(data=line, format="nt")
        except Exception:  # as above
            return number
    return 0


def _plain(graph: Graph) -> list[tuple[Any, str, Any]]:
    """The triples as our own data, in the order of their text (blank nodes as they come)."""
    triples = [(_part(s), str(p), _part(o)) for s, p, o in graph]
    return sorted(triples, key=lambda t: (repr(t[0]), t[1], repr(t[2])))


def _part(node: Any) -> Iri | Anonymous | Value:
    from rdflib import BNode, Literal, URIRef

    if isinstance(node, URIRef):
        return Iri(str(node))
    if isinstance(node, BNode):
        return Anonymous(str(node))
    assert isinstance(node, Literal)
    if node.language:
        return Value(str(node), f"{RDF}langString", node.language.lower())
    return Value(str(node), str(node.datatype or f"{XSD}string"))
