"""OWL as frozen data: axioms are terms of the functional syntax, without its difference of Object and Data.

``SubClassOf(Dog SomeValuesFrom(hasOwner Person))`` is one `Expression` within another. Which property has individuals
and which has data values is a matter of the ontology as a whole (`Ontology.kinds`), as it is in RDF.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import StrEnum
from typing import TypeAlias

from casper.kb.errors import Place
from casper.kb.terms.clauses import NOWHERE

OWL = "http://www.w3.org/2002/07/owl#"
RDF = "http://www.w3.org/1999/02/22-rdf-syntax-ns#"
RDFS = "http://www.w3.org/2000/01/rdf-schema#"
XSD = "http://www.w3.org/2001/XMLSchema#"
SWRL = "http://www.w3.org/2003/11/swrl#"
SWRLB = "http://www.w3.org/2003/11/swrlb#"


@dataclass(frozen=True, slots=True, order=True)
class Iri:
    """The name of a class, a property, an individual or a datatype."""

    text: str


@dataclass(frozen=True, slots=True, order=True)
class Anonymous:
    """An individual without a name, by its label in the file."""

    label: str


@dataclass(frozen=True, slots=True, order=True)
class Value:
    """A data value as it is spelt, with its datatype's IRI and its language, if any."""

    lexical: str
    datatype: str = f"{XSD}string"
    language: str = ""


@dataclass(frozen=True, slots=True, order=True)
class Unknown:
    """A variable of a SWRL rule."""

    name: str


@dataclass(frozen=True, slots=True)
class Expression:
    """A constructor with its arguments; cardinalities are plain integers."""

    name: str
    args: tuple[Part, ...] = ()


Part: TypeAlias = Iri | Anonymous | Value | Unknown | Expression | int

THING, NOTHING = Iri(f"{OWL}Thing"), Iri(f"{OWL}Nothing")


@dataclass(frozen=True, slots=True)
class Axiom:
    """What an ontology states, where, and how its author calls it (a label of the axiom itself, as SWRL rules have)."""

    expression: Expression
    place: Place = field(default=NOWHERE, compare=False)
    label: str = field(default="", compare=False)


class Kind(StrEnum):
    """What an IRI is declared or used as; one may be several (punning)."""

    CLASS = "Class"
    OBJECT = "ObjectProperty"
    DATA = "DataProperty"
    ANNOTATION = "AnnotationProperty"
    INDIVIDUAL = "NamedIndividual"
    DATATYPE = "Datatype"


@dataclass
class Ontology:
    """Everything that was read: of one file, or of several that belong together.

    ``puzzles`` are places and sentences of what was not understood while reading: nothing is dropped in silence.
    """

    iris: list[str] = field(default_factory=list)
    axioms: list[Axiom] = field(default_factory=list)
    kinds: dict[str, set[Kind]] = field(default_factory=dict)
    labels: dict[str, list[str]] = field(default_factory=dict)
    imports: list[tuple[str, Place]] = field(default_factory=list)
    puzzles: list[tuple[Place, str]] = field(default_factory=list)

    def declare(self, iri: str, kind: Kind) -> None:
        """Note what an IRI is."""
        self.kinds.setdefault(iri, set()).add(kind)

    def is_a(self, iri: str, kind: Kind) -> bool:
        """Whether an IRI is declared or used as this."""
        return kind in self.kinds.get(iri, ())

    def merge(self, other: Ontology) -> None:
        """Take in what another file says."""
        self.iris += other.iris
        self.axioms += other.axioms
        self.imports += other.imports
        self.puzzles += other.puzzles
        for iri, kinds in other.kinds.items():
            self.kinds.setdefault(iri, set()).update(kinds)
        for iri, labels in other.labels.items():
            self.labels.setdefault(iri, []).extend(labels)


def parts_of(part: Part) -> Iterator[Part]:
    """The part and everything in it."""
    waiting = [part]
    while waiting:
        found = waiting.pop()
        yield found
        if isinstance(found, Expression):
            waiting.extend(reversed(found.args))
