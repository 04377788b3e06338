"""OWL/XML to nodes: its elements are the functional syntax's constructors, with IRIs and numbers as attributes."""

from __future__ import annotations

from dataclasses import dataclass, field
from urllib.parse import urljoin
from xml.parsers import expat

from casper.kb.errors import Place, ReadError
from casper.kb.ontologies.expressions import OWL, RDF, RDFS, XSD, Anonymous, Iri, Value
from casper.kb.ontologies.reading.nodes import Entity, Item, Node

_ENTITIES = ("Class", "ObjectProperty", "DataProperty", "AnnotationProperty", "NamedIndividual", "Datatype")
_STANDARD = {"owl": OWL, "rdf": RDF, "rdfs": RDFS, "xsd": XSD}
_XML_BASE, _XML_LANGUAGE = (f"http://www.w3.org/XML/1998/namespace {name}" for name in ("base", "lang"))


@dataclass
class _Element:
    name: str
    attributes: dict[str, str]
    base: str
    place: Place
    items: list[Item] = field(default_factory=list)
    texts: list[str] = field(default_factory=list)

    @property
    def text(self) -> str:
        """What stands between the tags."""
        return "".join(self.texts)


def read_owl_xml(content: bytes, file: str) -> Node:
    """The ``<Ontology>`` of an OWL/XML document.

    Raises:
        ReadError: with the line at which it is no well-formed XML, or no OWL/XML.
    """
    reader = _Reader(file)
    try:
        reader.parser.Parse(content, True)
    except expat.ExpatError as mistake:
        raise _mistake(mistake, file, content.rstrip().count(b"\n") + 1) from None
    if reader.root is None:
        raise ReadError("there is no <Ontology> in this file", Place(file, 1, 1))
    return reader.root


def _mistake(mistake: expat.ExpatError, file: str, lines: int) -> ReadError:
    """A sentence for XML that is not well-formed; most often the file was cut short."""
    words = expat.ErrorString(mistake.code)
    cut = mistake.lineno >= lines
    advice = "the file was cut short; get the whole file" if cut else "mend the file, or save it anew from your editor"
    place = Place(file, lines) if cut else Place(file, mistake.lineno, mistake.offset + 1)
    return ReadError(f"this is no XML any more ({words}): {advice}", place)


class _Reader:
    """Builds nodes while expat reads; elements under way are on a stack."""

    def __init__(self, file: str) -> None:
        self._file, self._prefixes = file, dict(_STANDARD)
        self._open: list[_Element] = []
        self.root: Node | None = None
        self.parser = expat.ParserCreate(namespace_separator=" ")
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.CharacterDataHandler = self._characters

    def _place(self) -> Place:
        return Place(self._file, self.parser.CurrentLineNumber, self.parser.CurrentColumnNumber + 1)

    def _start(self, qualified: str, attributes: dict[str, str]) -> None:
        namespace, _, name = qualified.rpartition(" ")
        if namespace != OWL:
            raise ReadError(f"<{name}> is no element of OWL/XML; save the ontology anew", self._place())
        base = attributes.get(_XML_BASE) or (self._open[-1].base if self._open else "")
        if name == "Ontology" and not base:
            base = attributes.get("ontologyIRI", "")
        self._open.append(_Element(name, attributes, base, self._place()))

    def _characters(self, text: str) -> None:
        if self._open:
            self._open[-1].texts.append(text)

    def _end(self, _: str) -> None:
        element = self._open.pop()
        if element.name == "Prefix":
            self._prefixes[element.attributes.get("name", "")] = element.attributes.get("IRI", "")
            return
        item = self._item(element)
        if self._open:
            self._open[-1].items.append(item)
        elif isinstance(item, Node) and item.name == "Ontology":
            self.root = item

    def _item(self, element: _Element) -> Item:
        name, attributes = element.name, element.attributes
        iri = self._iri(element)
        if name in _ENTITIES and iri is not None:
            return Entity(name, iri)
        if name == "Literal":
            language = attributes.get(_XML_LANGUAGE, "")
            datatype = attributes.get("datatypeIRI") or (f"{RDF}langString" if language else f"{XSD}string")
            return Value(element.text, datatype, language.lower())
        if name == "AnonymousIndividual":
            return Anonymous(attributes.get("nodeID", "").removeprefix("_:"))
        if name in ("IRI", "Import", "AbbreviatedIRI"):
            spelt = element.text.strip()
            full = self._expanded(spelt, element.place) if name == "AbbreviatedIRI" else _joined(element.base, spelt)
            return Node("Import", (Iri(full),), element.place) if name == "Import" else Iri(full)
        front: list[Item] = [] if iri is None else [iri]
        if "cardinality" in attributes:
            front.append(self._number(element))
        if "facet" in attributes:
            front.append(Iri(attributes["facet"]))
        if name == "Ontology" and attributes.get("ontologyIRI"):
            front.append(Iri(attributes["ontologyIRI"]))
        return Node(name, (*front, *element.items), element.place)

    def _number(self, element: _Element) -> int:
        spelt = element.attributes["cardinality"].strip()
        if not (spelt.isascii() and spelt.isdigit() and len(spelt) < 10):
            raise ReadError(f"{spelt!r} is no cardinality; write a number", element.place)
        return int(spelt)

    def _iri(self, element: _Element) -> Iri | None:
        if "IRI" in element.attributes:
            return Iri(_joined(element.base, element.attributes["IRI"]))
        if "abbreviatedIRI" in element.attributes:
            return Iri(self._expanded(element.attributes["abbreviatedIRI"], element.place))
        return None

    def _expanded(self, spelt: str, place: Place) -> str:
        prefix, _, name = spelt.partition(":")
        if prefix not in self._prefixes:
            sentence = f'nobody declares the prefix {prefix}: of {spelt}; add <Prefix name="{prefix}" IRI="…"/>'
            raise ReadError(sentence, place)
        return self._prefixes[prefix] + name


def _joined(base: str, iri: str) -> str:
    """An IRI reference resolved; ``urljoin`` knows no fragments of ``urn:``."""
    if iri.startswith("#"):
        return base.partition("#")[0] + iri
    return iri if ":" in iri.split("/")[0] else urljoin(base, iri)
