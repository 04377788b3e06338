"""Functional syntax to nodes: prefixes resolved, every node with its line."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from typing import Any

from lark import Lark, Token, Tree, UnexpectedInput

from casper.kb.errors import Place, ReadError
from casper.kb.ontologies.expressions import OWL, RDF, RDFS, XSD, Anonymous, Iri, Value
from casper.kb.ontologies.reading.nodes import Entity, Item, Node

_ENTITIES = ("Class", "ObjectProperty", "DataProperty", "AnnotationProperty", "NamedIndividual", "Datatype")
_STANDARD = {"owl:": OWL, "rdf:": RDF, "rdfs:": RDFS, "xsd:": XSD}


def read_functional(text: str, file: str) -> Node:
    """The ``Ontology(…)`` of the text.

    Raises:
        ReadError: with the line at which it is no functional syntax, or a prefix nobody declares.
    """
    try:
        tree = _parser().parse(text)
    except UnexpectedInput as mistake:
        raise _mistake(mistake, text, file) from None
    reader = _Reader(file)
    ontology: Node | None = None
    for child in tree.children:
        assert isinstance(child, Tree)
        if str(child.children[0]) == "Prefix":
            reader.declare(child)
        elif str(child.children[0]) == "Ontology" and ontology is None:
            ontology = reader.node(child)
        else:
            raise ReadError("only Prefix(…) and one Ontology(…) may stand here", reader.place(child))
    if ontology is None:
        sentence = "there is no Ontology(…) in this file: it was cut short; get the whole file"
        raise ReadError(sentence, Place(file, text.rstrip().count("\n") + 1))
    return ontology


@cache
def _parser() -> Lark:
    grammar = Path(__file__).with_name("functional.lark").read_text(encoding="utf-8")
    return Lark(grammar, parser="lalr", propagate_positions=True, maybe_placeholders=False)


def _mistake(mistake: UnexpectedInput, text: str, file: str) -> ReadError:
    token = getattr(mistake, "token", None)
    rest = text[mistake.pos_in_stream or 0 :].strip() if mistake.pos_in_stream is not None else ""
    if (token is not None and token.type == "$END") or (rest and re.fullmatch(r"[^\s()]*", rest)):
        line = text.rstrip().count("\n") + 1
        sentence = "the file ends here, in the middle of the ontology: it was cut short; get the whole file"
        return ReadError(sentence, Place(file, line))
    if text.count('"', mistake.pos_in_stream or 0) == 1:
        sentence = "this text is never closed: the file was cut short; get the whole file"
        return ReadError(sentence, Place(file, mistake.line, mistake.column))
    shown = str(token) if token is not None else text[mistake.pos_in_stream or 0 :][:1]
    sentence = f"{shown!r} does not belong here in functional syntax; mend the file, or save it as Turtle"
    return ReadError(sentence, Place(file, mistake.line, mistake.column))


class _Reader:
    """Makes nodes of parse trees, with the prefixes declared so far."""

    def __init__(self, file: str) -> None:
        self._file = file
        self._prefixes = dict(_STANDARD)

    def place(self, tree: Tree[Any] | Token) -> Place:
        meta = tree if isinstance(tree, Token) else tree.meta
        return Place(self._file, getattr(meta, "line", 0) or 0, getattr(meta, "column", 0) or 0)

    def declare(self, tree: Tree[Any]) -> None:
        for binding in tree.children[1:]:
            if not (isinstance(binding, Tree) and binding.data == "binding"):
                raise ReadError("a prefix is declared as Prefix(name:=<iri>)", self.place(tree))
            self._prefixes[str(binding.children[0])] = str(binding.children[1])[1:-1]

    def node(self, tree: Tree[Any]) -> Node:
        name, *parts = tree.children
        return Node(str(name), tuple(self.item(part) for part in parts), self.place(tree))

    def item(self, tree: Tree[Any]) -> Item:
        match tree.data:
            case "node":
                node = self.node(tree)
                is_entity = node.name in _ENTITIES and len(node.items) == 1 and isinstance(node.items[0], Iri)
                return Entity(node.name, node.items[0]) if is_entity else node  # type: ignore[arg-type]
            case "iri":
                return self.iri(tree)
            case "anonymous":
                return Anonymous(str(tree.children[0])[2:])
            case "number":
                return int(str(tree.children[0]))
            case "value":
                return self.value(tree)
            case "group":
                return Node("", tuple(self.item(part) for part in tree.children), self.place(tree))
        raise ReadError("a prefix is declared before the ontology", self.place(tree))

    def iri(self, tree: Tree[Any]) -> Iri:
        text = str(tree.children[0])
        if text.startswith("<"):
            return Iri(text[1:-1])
        prefix, name = text.split(":", 1)
        if f"{prefix}:" not in self._prefixes:
            sentence = f"nobody declares the prefix {prefix}: of {text}; add Prefix({prefix}:=<…>)"
            raise ReadError(sentence, self.place(tree))
        return Iri(self._prefixes[f"{prefix}:"] + name)

    def value(self, tree: Tree[Any]) -> Value:
        text = str(tree.children[0])[1:-1].replace('\\"', '"').replace("\\\\", "\\")
        if len(tree.children) == 1:
            return Value(text)
        tail = tree.children[1]
        if isinstance(tail, Token):
            return Value(text, f"{RDF}langString", str(tail)[1:].lower())
        return Value(text, self.iri(tail).text)
