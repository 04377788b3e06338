"""RDF: the generated ontology as triples, read until the first answer, and closed under OWL 2 RL."""

import re
import tempfile
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

from casper.kb.ontologies.importing import import_ontologies

from ..bounds import Bound
from ..deriving.ontology import Ontology, generated
from ..figures import OURS, Amounts, Figure, Found, Sizes, attempt, fingerprint, timed

TITLE = "RDF"
TIMED = (
    "Shares of the generated ontology as triples in a file. Reading: from the file to the rows of one property "
    "(casper: `import_ontologies`, its findings and names included, and the knowledge base; rdflib: `Graph.parse`, "
    "which draws no conclusions). Closing: from the file to every type of every individual (owlrl: "
    "`OWLRL_Semantics`)."
)
BASE = "http://example.org/large#"
OWL, RDFS = "http://www.w3.org/2002/07/owl#", "http://www.w3.org/2000/01/rdf-schema#"
TYPE = "<http://www.w3.org/1999/02/22-rdf-syntax-ns#type>"
UNTOUCHED = "p30"  # a property of which no axiom says which rows it has
AXIOMS = {  # by kind: the triple's middle; of those with one part, its class
    "subclass": f"<{RDFS}subClassOf>",
    "subproperty": f"<{RDFS}subPropertyOf>",
    "domain": f"<{RDFS}domain>",
    "range": f"<{RDFS}range>",
    "inverse": f"<{OWL}inverseOf>",
    "transitive": f"<{OWL}TransitiveProperty>",
    "symmetric": f"<{OWL}SymmetricProperty>",
}
SYNTAXES = {"N-Triples": "nt", "Turtle": "ttl"}
READ, CLOSED = "reading {triples:,} triples of {syntax}", "closing {triples:,} triples"


def triples(ontology: Ontology) -> list[str]:
    """The ontology in N-Triples, its classes and properties declared."""
    classes = sorted({str(c) for pair in ontology.axioms["subclass"] for c in pair})
    properties = sorted(
        {str(p) for _, p, _ in ontology.links}
        | {str(r[0]) for k in ("inverse", "subproperty") for r in ontology.axioms[k]}
        | {UNTOUCHED}
    )
    found = [f"{_iri(c)} {TYPE} <{OWL}Class> ." for c in classes]
    found += [f"{_iri(p)} {TYPE} <{OWL}ObjectProperty> ." for p in properties]
    for kind, rows in ontology.axioms.items():
        found += [
            f"{_iri(r[0])} {TYPE} {AXIOMS[kind]} ." if len(r) == 1 else f"{_iri(r[0])} {AXIOMS[kind]} {_iri(r[1])} ."
            for r in rows
        ]
    found += [f"{_iri(x)} {TYPE} {_iri(c)} ." for x, c in ontology.types]
    found += [f"{_iri(x)} {_iri(p)} {_iri(y)} ." for x, p, y in ontology.links]
    return found


def _iri(name: object) -> str:
    return f"<{BASE}{name}>"


def measure(sizes: Sizes) -> Found:
    """Reading in two syntaxes, and closing."""
    lines = triples(generated(sizes.triples))
    with tempfile.TemporaryDirectory() as folder:
        for syntax, suffix in SYNTAXES.items():
            task, file = READ.format(triples=len(lines), syntax=syntax), Path(folder) / f"large.{suffix}"
            file.write_text("\n".join(lines) + "\n" if suffix == "nt" else _turtle(lines))
            yield Figure(task, OURS, *_rows(file))
            yield attempt(task, "rdflib", partial(_rows_of_rdflib, file, suffix))
        ontology = generated(sizes.closed)
        lines, file = triples(ontology), Path(folder) / "small.nt"
        file.write_text("\n".join(lines) + "\n")
        task, classes = (
            CLOSED.format(triples=len(lines)),
            {str(c) for pair in ontology.axioms["subclass"] for c in pair},
        )
        yield Figure(task, OURS, *_types(file, classes))
        yield attempt(task, "owlrl", partial(_types_of_owlrl, file, classes))


def _turtle(lines: list[str]) -> str:
    """The same triples with a prefix."""
    return f"@prefix : <{BASE}> .\n" + re.sub(f"<{re.escape(BASE)}([a-z0-9]+)>", r":\1", "\n".join(lines)) + "\n"


def _rows(file: Path) -> tuple[float, Any]:
    seconds, found = timed(lambda: list(import_ontologies([file]).knowledge_base().rows(UNTOUCHED, 2)))
    return seconds, fingerprint(found)


def _rows_of_rdflib(file: Path, suffix: str) -> tuple[float, Any] | str:
    try:
        from rdflib import Graph, URIRef
    except ImportError:
        return "the Python package rdflib is not installed"
    seconds, found = timed(lambda: list(Graph().parse(file, format=suffix).subject_objects(URIRef(BASE + UNTOUCHED))))
    return seconds, fingerprint((_name(x), _name(y)) for x, y in found)


def _name(iri: object) -> str:
    return str(iri).removeprefix(BASE)


def _types(file: Path, classes: set[str]) -> tuple[float, Any]:
    def closed() -> list[tuple[object, str]]:
        kb = import_ontologies([file]).knowledge_base()
        return [(row[0], c) for c in classes for row in kb.rows(c, 1)]

    seconds, found = timed(closed)
    return seconds, fingerprint(found)


def _types_of_owlrl(file: Path, classes: set[str]) -> tuple[float, Any] | str:
    try:
        from owlrl import DeductiveClosure, OWLRL_Semantics
        from rdflib import RDF, Graph, URIRef
    except ImportError:
        return "the Python package owlrl is not installed"

    def closed() -> list[tuple[str, str]]:
        graph = Graph().parse(file, format="nt")
        DeductiveClosure(OWLRL_Semantics).expand(graph)
        found = ((_name(x), c) for c in classes for x in graph.subjects(RDF.type, URIRef(BASE + c)))
        return [(x, c) for x, c in found if x.startswith("i")]

    seconds, found = timed(closed)
    return seconds, fingerprint(found)


def promises(amounts: Amounts, sizes: Sizes) -> Iterator[Bound]:
    """None: these figures are there to be known."""
    yield from ()
