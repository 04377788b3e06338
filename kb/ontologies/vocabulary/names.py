"""IRIs as readable names, each its own: ``http://…#PetOwner`` is ``pet_owner``. The way back is stated as iri/2."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Collection, Iterable, Iterator, Mapping
from urllib.parse import unquote

from casper.kb.ontologies.citing import local_name
from casper.kb.ontologies.expressions import OWL, RDF, RDFS, SWRLB, XSD, Iri, Kind, Ontology, parts_of
from casper.kb.text.triples import STANDARD_DATATYPES

OWN = ("thing", "same", "different", "apart", "iri", "data_property", "datatype")  # relations of the written text
_TAKEN = frozenset(
    {
        *OWN,
        *("claim", "did", "valid", "never", "is", "mod", "rem", "xor", "not", "true", "fail", "false", "undefined"),
        *("goal", "step", "before", "optional", "alternative", "uses", "task", "unordered", "steps", "repeat", "by"),
        *("prior", "band", "loop", "body", "shelf", "opens", "mass", "placing", "consumes", "say", "example"),
        *("findall", "forall", "call", "assert", "member", "write", "dynamic", "include", "use", "number", "integer"),
        *("atom", "var", "nonvar", "ground", "length"),
    }
)
_STANDARD = (OWL, RDF, RDFS, XSD, SWRLB)
_OPAQUE = re.compile(r"[A-Za-z]*[_:]?\d{3,}\Z")  # GO_0008150: a number in a register, which only its label explains


def names_of(ontology: Ontology) -> dict[str, str]:
    """A name for every IRI that the ontology speaks of, apart from OWL's own; no two have the same."""
    iris = sorted({iri for iri in _mentioned(ontology) if not iri.startswith(_STANDARD)})
    return _told_apart({iri: _wish(iri, ontology) for iri in iris})


def _wish(iri: str, ontology: Ontology) -> str:
    """The readable name; of a datatype that is called like one of XML Schema's, with a word more."""
    name = readable_name(iri, ontology.labels.get(iri, ()))
    is_datatype = ontology.is_a(iri, Kind.DATATYPE)
    return f"{name}_value" if is_datatype and name in {"text", *STANDARD_DATATYPES} else name


def renamed(names: Mapping[str, str], ontology: Ontology) -> Iterator[tuple[str, str]]:
    """Names that are not what one would expect of the IRI, because that name was taken."""
    for iri, name in names.items():
        if name != readable_name(iri, ontology.labels.get(iri, ())):
            yield iri, name


def readable_name(iri: str, labels: Iterable[str] = ()) -> str:
    """The local name in lower case with ``_`` between its words; of a mere number, the label instead."""
    local = unquote(local_name(iri))
    if _OPAQUE.match(local):
        local = next(iter(sorted(labels)), local)
    return _snake(local) or (local if any(c.isalpha() for c in local) else "nameless")


def _snake(text: str) -> str:
    plain = "".join(c for c in unicodedata.normalize("NFKD", text) if not unicodedata.combining(c))
    plain = re.sub(r"([A-Z]+)([A-Z][a-z])", r"\1_\2", plain)
    plain = re.sub(r"([a-z0-9])([A-Z])", r"\1_\2", plain)
    if re.search(r"[^\x00-\x7f]", plain):
        return ""  # another script stays as it is, in quotes
    words = re.sub(r"[^A-Za-z0-9]+", "_", plain).strip("_").lower()
    return f"n{words}" if words[:1].isdigit() else words


def _told_apart(wished: Mapping[str, str]) -> dict[str, str]:
    """The wished names where they are free; others get a number. Names without one go to those who come first."""
    names: dict[str, str] = {}
    used: set[str] = set(_TAKEN)
    for iri, wish in wished.items():
        names[iri] = _free(wish, used, wished.values())
        used.add(names[iri])
    return names


def _free(wish: str, used: Collection[str], wishes: Collection[str]) -> str:
    if wish not in used:
        return wish
    number = 2
    while f"{wish}_{number}" in used or f"{wish}_{number}" in wishes:
        number += 1
    return f"{wish}_{number}"


def _mentioned(ontology: Ontology) -> Iterator[str]:
    yield from (iri for iri, kinds in ontology.kinds.items() if kinds != {Kind.ANNOTATION})
    for axiom in ontology.axioms:
        for part in parts_of(axiom.expression):
            if isinstance(part, Iri):
                yield part.text
