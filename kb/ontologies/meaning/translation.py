"""A whole ontology to clauses: every axiom by its own function, then the rules that hold for all."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

from casper.kb.errors import Place
from casper.kb.ontologies.citing import cited
from casper.kb.ontologies.expressions import Axiom, Expression, Iri, Ontology, Part, Value
from casper.kb.ontologies.meaning import class_axioms as classes
from casper.kb.ontologies.meaning import property_axioms as properties
from casper.kb.ontologies.meaning.arities import check_arities
from casper.kb.ontologies.meaning.equality import SAME, Cited, general_rules
from casper.kb.ontologies.meaning.rules import rule
from casper.kb.ontologies.meaning.tidying import tidied
from casper.kb.ontologies.vocabulary.anonymous import number_anonymous
from casper.kb.ontologies.vocabulary.kinds import settle_kinds, settle_names
from casper.kb.ontologies.vocabulary.names import names_of
from casper.kb.ontologies.vocabulary.refusals import Beyond, Said
from casper.kb.ontologies.vocabulary.scope import Scope, Vocabulary
from casper.kb.terms.clauses import Clause

_Translate = Callable[..., Iterator[Said]]
_AXIOMS: dict[str, tuple[int | None, _Translate]] = {  # how many arguments (None: two or more), and the translation
    "SubClassOf": (2, classes.sub_class),
    "EquivalentClasses": (2, classes.equivalent_classes),
    "DisjointClasses": (None, classes.disjoint_classes),
    "DisjointUnion": (None, classes.disjoint_union),
    "ClassAssertion": (2, classes.class_assertion),
    "PropertyAssertion": (3, classes.property_assertion),
    "NegativePropertyAssertion": (3, classes.negative_assertion),
    "SameIndividual": (2, classes.same_individual),
    "DifferentIndividuals": (None, classes.different_individuals),
    "HasKey": (None, classes.has_key),
    "DatatypeDefinition": (2, classes.datatype_definition),
    "SubPropertyOf": (2, properties.sub_property),
    "EquivalentProperties": (2, properties.equivalent_properties),
    "InverseProperties": (2, properties.inverse_properties),
    "DisjointProperties": (None, properties.disjoint_properties),
    "PropertyDomain": (2, properties.property_domain),
    "PropertyRange": (2, properties.property_range),
    "FunctionalProperty": (1, properties.functional),
    "InverseFunctionalProperty": (1, properties.objects_only(properties.inverse_functional)),
    "ReflexiveProperty": (1, properties.objects_only(properties.reflexive)),
    "IrreflexiveProperty": (1, properties.objects_only(properties.irreflexive)),
    "SymmetricProperty": (1, properties.objects_only(properties.symmetric)),
    "AsymmetricProperty": (1, properties.objects_only(properties.asymmetric)),
    "TransitiveProperty": (1, properties.objects_only(properties.transitive)),
    "Rule": (2, rule),
}
_EITHER_WAY = (
    "EquivalentClasses", "EquivalentProperties", "DisjointClasses", "DisjointProperties", "InverseProperties",
    "SameIndividual", "DifferentIndividuals",
)  # whose arguments have no order


@dataclass(frozen=True)
class Translation:
    """What became of an ontology.

    ``clauses`` come with the axiom each cites (``""``: a plain fact), ``general`` with what such rules are for (that
    equal things share everything); ``refusals`` and ``notes`` are places and sentences of what no clause says, and of
    what the clauses take for granted.
    """

    vocabulary: Vocabulary
    clauses: tuple[Cited, ...]
    general: tuple[Cited, ...]
    refusals: tuple[tuple[Place, str], ...]
    notes: tuple[tuple[Place, str], ...]


def translate(ontology: Ontology) -> Translation:
    """The clauses of an ontology, in an order that depends on nothing but what it says."""
    mixed = settle_kinds(ontology)
    settle_names(ontology)
    number_anonymous(ontology)
    axioms = sorted(map(_ordered, ontology.axioms), key=_key)
    vocabulary = _vocabulary(ontology, axioms)
    work = _Work(vocabulary)
    work.run(axioms)
    if any(clause.head.indicator == SAME for clause in work.clauses):  # then every condition has to reckon with it
        work = _Work(replace(vocabulary, equality=True, groups={}))
        work.run(axioms)
    stated = tuple(work.clauses.items())
    general = tuple(pair for pair in general_rules(work.vocabulary, stated) if pair[0] not in work.clauses)
    confused = [(Place(), f"{cited(Iri(x))} relates individuals and values; make two properties of it") for x in mixed]
    return Translation(work.vocabulary, stated, general, (*work.refusals, *confused), tuple(work.notes))


def _ordered(axiom: Axiom) -> Axiom:
    """The axiom with arguments that have no order in one: names first."""
    name, args = axiom.expression.name, axiom.expression.args
    if name not in _EITHER_WAY:
        return axiom
    by_text = sorted(args, key=lambda part: (isinstance(part, Expression), cited(part), repr(part)))
    return Axiom(Expression(name, tuple(by_text)), axiom.place, axiom.label)


def _key(axiom: Axiom) -> tuple[int, str, str]:
    names = list(_AXIOMS)
    name = axiom.expression.name
    return names.index(name) if name in names else len(names), cited(axiom.expression), repr(axiom.expression)


def _vocabulary(ontology: Ontology, axioms: list[Axiom]) -> Vocabulary:
    ranges: dict[str, list[Part]] = {}
    spelt: dict[str, set[str]] = {}
    datatypes: dict[str, Part] = {}
    for axiom in axioms:
        match axiom.expression:
            case Expression("PropertyRange", (Iri(text), range_)):
                ranges.setdefault(text, []).append(range_)
            case Expression("PropertyAssertion", (Iri(text), _, Value(datatype=datatype))):
                spelt.setdefault(text, set()).add(datatype)
            case Expression("DatatypeDefinition", (Iri(text), range_)):
                datatypes[text] = range_
    return Vocabulary(ontology, names_of(ontology), False, ranges, spelt, datatypes)


class _Work:
    """The clauses so far, each once with the first axiom that gives it."""

    def __init__(self, vocabulary: Vocabulary) -> None:
        self.vocabulary = vocabulary
        self.clauses: dict[Clause, str] = {}
        self.refusals: list[tuple[Place, str]] = []
        self.notes: list[tuple[Place, str]] = []

    def run(self, axioms: list[Axiom]) -> None:
        for axiom in axioms:
            self._translate(axiom)

    def _translate(self, axiom: Axiom) -> None:
        sentence = cited(axiom.expression)
        if axiom.label:
            sentence = f"{axiom.label}: {sentence}"
        scope = Scope(self.vocabulary, sentence)
        try:
            for found in _said(axiom.expression, scope):
                self._keep(found, scope, axiom)
        except Beyond as reason:
            self._refuse(axiom, sentence, reason)
        except RecursionError:
            self._refuse(axiom, sentence, Beyond("it is nested too deeply, or a datatype is defined by itself"))
        self.notes += [(axiom.place, f"{sentence}: {note}") for note in dict.fromkeys(scope.notes)]

    def _keep(self, found: Said, scope: Scope, axiom: Axiom) -> None:
        if isinstance(found, Beyond):
            self._refuse(axiom, scope.sentence, found)
            return
        try:
            clause = tidied(found, scope.data, rename=not scope.has_unknowns)
        except Beyond as reason:
            self._refuse(axiom, scope.sentence, reason)
            return
        if clause is not None:
            self.clauses.setdefault(clause, scope.sentence if clause.body else "")

    def _refuse(self, axiom: Axiom, sentence: str, reason: Beyond) -> None:
        refusal = axiom.place, f"{sentence}: {reason}"
        if refusal not in self.refusals[-5:]:
            self.refusals.append(refusal)


def _said(expression: Expression, scope: Scope) -> Iterator[Said]:
    if expression.name not in _AXIOMS:
        raise Beyond("it is no axiom that rules have a counterpart for")
    number, make = _AXIOMS[expression.name]
    given = len(expression.args)
    if (number is None and given < 2) or (number is not None and given != number):
        raise Beyond("it has the wrong number of arguments; mend the axiom")
    check_arities(expression)
    return make(scope, *expression.args)
