"""Functional syntax to nodes: prefixes resolved, every node with its line.

The syntax is constructors in brackets and nothing else, so a stack reads it, however deeply it is nested.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from casper.kb.errors import Place, ReadError
from casper.kb.ontologies.expressions import OWL, RDF, RDFS, XSD, Anonymous, Iri, Value
from casper.kb.ontologies.reading.nodes import Entity, Item, Node

_ENTITIES = ("Class", "ObjectProperty", "DataProperty", "AnnotationProperty", "NamedIndividual", "Datatype")
_STANDARD = {"owl": OWL, "rdf": RDF, "rdfs": RDFS, "xsd": XSD}
_TOKEN = re.compile(
    r"""(?P<blank>(?:\s+|\#[^\n]*)+)
    |(?P<name>[A-Za-z]+)(?=\s*\()
    |(?P<full><[^<>"{}|^`\\\s]*>)
    |(?P<node>_:\w[\w.\-]*)
    |(?P<prefix>(?:[^\W\d_][\w.\-]*)?:)(?=\s*=)
    |(?P<short>(?:[^\W\d_][\w.\-]*)?:[^\s()<>"=@^#,;]*)
    |(?P<text>"(?:[^"\\]|\\["\\])*")
    |(?P<language>@[A-Za-z]+(?:-[A-Za-z0-9]+)*)
    |(?P<typed>\^\^)
    |(?P<number>\d{1,9}(?!\d))
    |(?P<open>\()
    |(?P<close>\))
    |(?P<equals>=)""",
    re.VERBOSE,
)
_CUT = "it was cut short; get the whole file"


def read_functional(text: str, file: str) -> Node:
    """The ``Ontology(…)`` of the text.

    Raises:
        ReadError: with the line at which it is no functional syntax, or a prefix nobody declares.
    """
    return _Reader(text, file).ontology()


@dataclass
class _Open:
    """A constructor whose closing bracket has not come yet."""

    name: str
    place: Place
    items: list[Item] = field(default_factory=list)


class _Reader:
    """Goes through the tokens once; constructors under way are on a stack."""

    def __init__(self, text: str, file: str) -> None:
        self._text, self._file = text, file
        self._prefixes = dict(_STANDARD)
        self._open: list[_Open] = []
        self._found: Node | None = None
        self._seen, self._line, self._line_start = 0, 1, 0
        self._name = self._prefix = ""  # of the constructor, or of the prefix, that begins here
        self._is_typed = False  # what follows is the datatype of the last text

    def ontology(self) -> Node:
        for kind, token, at in self._tokens():
            self._take(kind, token, at)
        if self._open:
            raise self._at_end(f"the file ends here, in the middle of the ontology: {_CUT}")
        if self._found is None:
            raise self._at_end(f"there is no Ontology(…) in this file: {_CUT}")
        return self._found

    def _tokens(self) -> Iterator[tuple[str, str, int]]:
        at, match, end = 0, _TOKEN.match, len(self._text)
        while at < end:
            found = match(self._text, at)
            if found is None:
                raise self._mistake(at)
            kind = str(found.lastgroup)
            if kind != "blank":
                yield kind, found[kind], at
            at = found.end()

    def _take(self, kind: str, token: str, at: int) -> None:
        if kind == "name" and not self._name:
            self._name = token
        elif kind == "open" and (self._name or self._open):
            self._open.append(_Open(self._name, self._place(at)))
            self._name = ""
        elif not self._open or self._name:
            raise self._mistake(at)
        elif kind == "close":
            self._close(at)
        elif kind in ("prefix", "equals"):
            self._prefix = token if kind == "prefix" else self._prefix
        else:
            self._item(kind, token, at)

    def _item(self, kind: str, token: str, at: int) -> None:
        items = self._open[-1].items
        if kind in ("full", "short"):
            iri = Iri(token[1:-1]) if kind == "full" else self._expanded(token, at)
            if self._prefix:
                self._prefixes[self._prefix[:-1]] = iri.text
                self._prefix = ""
            elif self._is_typed:
                items[-1], self._is_typed = Value(self._last_text(at), iri.text), False
            else:
                items.append(iri)
        elif kind == "language":
            items[-1:] = [Value(self._last_text(at), f"{RDF}langString", token[1:].lower())]
        elif kind == "typed":
            self._last_text(at)
            self._is_typed = True
        elif kind == "text":
            items.append(Value(re.sub(r"\\(.)", r"\1", token[1:-1])))
        else:
            items.append(Anonymous(token[2:]) if kind == "node" else int(token))

    def _last_text(self, at: int) -> str:
        items = self._open[-1].items
        if not items or not isinstance(items[-1], Value):
            raise self._mistake(at)
        return items[-1].lexical

    def _close(self, at: int) -> None:
        done = self._open.pop()
        node = Node(done.name, tuple(done.items), done.place)
        if self._open:
            is_entity = node.name in _ENTITIES and len(node.items) == 1 and isinstance(node.items[0], Iri)
            self._open[-1].items.append(Entity(node.name, node.items[0]) if is_entity else node)  # type: ignore[arg-type]
        elif node.name == "Ontology" and self._found is None:
            self._found = node
        elif node.name != "Prefix":
            raise ReadError("only Prefix(…) and one Ontology(…) may stand here", node.place)

    def _expanded(self, token: str, at: int) -> Iri:
        prefix, name = token.split(":", 1)
        if prefix not in self._prefixes:
            sentence = f"nobody declares the prefix {prefix}: of {token}; add Prefix({prefix}:=<…>)"
            raise ReadError(sentence, self._place(at))
        return Iri(self._prefixes[prefix] + name)

    # --- places and mistakes ---------------------------------------------------------------------------------------

    def _place(self, at: int) -> Place:
        """The place of an offset that is not before the last one asked for: nothing is counted twice."""
        new_lines = self._text.count("\n", self._seen, at)
        if new_lines:
            self._line += new_lines
            self._line_start = self._text.rfind("\n", self._seen, at) + 1
        self._seen = at
        return Place(self._file, self._line, at - self._line_start + 1)

    def _at_end(self, sentence: str) -> ReadError:
        return ReadError(sentence, Place(self._file, self._text.rstrip().count("\n") + 1))

    def _mistake(self, at: int) -> ReadError:
        rest = self._text[at:].rstrip()
        if self._open and (rest[:1] == '"' or re.fullmatch(r"[^\s()]*", rest)):
            return self._at_end(f"the file ends here, in the middle of the ontology: {_CUT}")
        shown = re.match(r"\w+|.", rest or " ", re.DOTALL)
        sentence = f"{shown[0] if shown else rest!r} does not belong here in functional syntax"
        return ReadError(f"{sentence}; mend the file, or save it as Turtle", self._place(at))
