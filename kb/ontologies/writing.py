"""A translated ontology as a folder of text: ``ontology.pl`` to read and ``names.pl`` with the IRI of every name."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from casper.kb.ontologies.citing import local_name
from casper.kb.ontologies.expressions import OWL, XSD, Kind
from casper.kb.ontologies.meaning.equality import predicates, undefined
from casper.kb.ontologies.meaning.translation import Translation
from casper.kb.ontologies.vocabulary.scope import Vocabulary
from casper.kb.ontologies.vocabulary.values import is_number
from casper.kb.terms.clauses import Clause
from casper.kb.terms.syntax import atom_text
from casper.kb.terms.terms import Compound
from casper.kb.text.citations import MARK
from casper.kb.text.writer import sentence_text

_OWL_WORDS = {"same": "sameAs", "different": "differentFrom", "thing": "Thing"}
MAIN, NAMES = "ontology.pl", "names.pl"


def ontology_text(translation: Translation) -> str:
    """The readable text: vocabulary, rules, constraints and facts, each clause with the axiom it cites."""
    return "\n".join("".join(f"{line}\n" for line in section) for section in _sections(translation) if section)


def _sections(translation: Translation) -> Iterator[list[str]]:
    clauses = translation.clauses
    yield list(_head(translation.vocabulary))
    yield list(_vocabulary(translation))
    yield _titled("Rules", ((c, told) for c, told in clauses if c.body and not c.is_constraint))
    yield _titled("What is never so", ((c, told) for c, told in clauses if c.is_constraint))
    yield _titled("Facts", ((c, told) for c, told in (*clauses, *translation.general) if not c.body))
    yield _individuals(translation.vocabulary)
    yield _titled("What holds of whatever there is", ((c, told) for c, told in translation.general if c.body))
    refused = [f"% - {_one_line(sentence)}" for _, sentence in translation.refusals]
    yield ["% What no clause here says", *refused] if refused else []


def _head(vocabulary: Vocabulary) -> Iterator[str]:
    iris = ", ".join(sorted(set(vocabulary.ontology.iris))) or "without a name"
    yield f"% The ontology {_one_line(iris)}, as text. Behind {MARK} stands the axiom that a clause says."
    yield f':- include("{NAMES}").'


def _titled(title: str, cited: Iterable[tuple[Clause, str]]) -> list[str]:
    lines = [_line(clause, told) for clause, told in cited]
    return [f"% {title}", *lines] if lines else []


def _line(clause: Clause, told: str) -> str:
    text = sentence_text(clause)
    return f"{text}  {MARK} {_one_line(told)}" if told and not clause.is_constraint else text


def _vocabulary(translation: Translation) -> Iterator[str]:
    """Every predicate with its label; those that nothing defines are declared, for facts that come later."""
    vocabulary, clauses = translation.vocabulary, [c for c, _ in (*translation.clauses, *translation.general)]
    known = {clause.head.indicator for clause in clauses}
    by_name = {name: iri for iri, name in vocabulary.names.items()}
    told = predicates(vocabulary)
    if told:
        yield "% Classes and properties"
    for name, kind in told:
        iri, arity = by_name[name], 1 if kind is Kind.CLASS else 2
        args = {Kind.CLASS: "X", Kind.OBJECT: "X, Y", Kind.DATA: "X, Value"}[kind]
        labels = "".join(f', "{_one_line(label)}"' for label in sorted(vocabulary.ontology.labels.get(iri, ())))
        yield f"% {atom_text(name)}({args}): {_one_line(local_name(iri))}{labels}"
        if (name, arity) not in known:
            known.add((name, arity))
            yield _dynamic(name, arity)
    for name, arity in sorted(undefined(clauses) - known):
        yield _dynamic(name, arity)


def _individuals(vocabulary: Vocabulary) -> list[str]:
    """The labels of individuals, as comments."""
    labels, kinds = vocabulary.ontology.labels, vocabulary.ontology.kinds
    told = [
        f'% {atom_text(name)}: {", ".join(_one_line(label) for label in sorted(labels[iri]))}'
        for iri, name in vocabulary.names.items()
        if iri in labels and Kind.INDIVIDUAL in kinds.get(iri, ())
    ]
    return ["% Individuals by their labels", *told] if told else []


def _dynamic(name: str, arity: int) -> str:
    return f":- dynamic({atom_text(name)}/{arity})."


def names_text(translation: Translation) -> str:
    """The IRI of every name, and which properties have values: the way back to RDF."""
    vocabulary = translation.vocabulary
    lines = ["% The IRI behind every name; the way back to RDF."]
    facts: list[tuple[str, ...]] = [("iri", name, iri) for iri, name in vocabulary.names.items()]
    used = {c.head.functor for c, _ in (*translation.clauses, *translation.general)}
    facts += [("iri", name, OWL + word) for name, word in _OWL_WORDS.items() if name in used]
    data = [iri for iri, kinds in sorted(vocabulary.ontology.kinds.items()) if Kind.DATA in kinds]
    named = [iri for iri in data if iri in vocabulary.names]
    facts += [("data_property", vocabulary.names[iri]) for iri in named]
    for iri in named:
        numbers = {x for x in vocabulary.spelt.get(iri, ()) if is_number(x)}
        if len(numbers) == 1 and not numbers <= {f"{XSD}integer", f"{XSD}decimal"}:
            facts.append(("datatype", vocabulary.names[iri], numbers.pop()))
    lines += [sentence_text(Clause(Compound(fact))) for fact in facts]
    return "".join(f"{line}\n" for line in lines)


def _one_line(text: str) -> str:
    return " ".join(text.split())
