"""The common shape of functional syntax and OWL/XML: the same constructors, as text with brackets or as elements."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from casper.kb.errors import Place
from casper.kb.ontologies.expressions import Anonymous, Iri, Value


@dataclass(frozen=True, slots=True)
class Node:
    """A constructor as the file has it; a nameless one is a bracketed group."""

    name: str
    items: tuple[Item, ...]
    place: Place


@dataclass(frozen=True, slots=True)
class Entity:
    """An IRI whose kind the file tells: ``<Class IRI="#Dog"/>``, ``Class(:Dog)``."""

    kind: str
    iri: Iri


Item: TypeAlias = Node | Entity | Iri | Anonymous | Value | int
