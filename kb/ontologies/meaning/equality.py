"""Rules about all there is: things that are equal, that differ, and that there are. Only where an axiom needs them.

``same/2`` relates different names of one thing. It is closed by rules, not worked out while importing, so that what
is stated later can make things equal, too. n names of one thing cost n² rows of ``same`` and n copies of each fact.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator

from casper.kb.ontologies.expressions import Kind
from casper.kb.ontologies.vocabulary.scope import Vocabulary, literal
from casper.kb.terms.builtins import BUILTINS
from casper.kb.terms.clauses import Clause, Indicator
from casper.kb.terms.terms import Compound, Term, Variable

SAME, DIFFERENT, THING = ("same", 2), ("different", 2), ("thing", 1)
_X, _Y, _Z = (Variable(name) for name in "XYZ")
_ANY = Variable("_#1")
Cited = tuple[Clause, str]


def _rule(head: tuple[Term, ...], *body: tuple[Term, ...]) -> Clause:
    return Clause(Compound(head), tuple(literal(*condition) for condition in body))


def predicates(vocabulary: Vocabulary) -> list[tuple[str, Kind]]:
    """Every class and property by its name, with what it is."""
    found: dict[tuple[str, Kind], None] = {}
    for iri, kinds in sorted(vocabulary.ontology.kinds.items()):
        for kind in (Kind.CLASS, Kind.OBJECT, Kind.DATA):
            if kind in kinds and iri in vocabulary.names:
                found[(vocabulary.names[iri], kind)] = None
    return sorted(found)


def general_rules(vocabulary: Vocabulary, stated: Collection[Cited]) -> Iterator[Cited]:
    """The rules about sameness, difference and things that the clauses so far need."""
    used = {x.atom.indicator for clause, _ in stated for x in clause.body}
    concluded = {clause.head.indicator for clause, _ in stated}
    is_equality = SAME in concluded
    if is_equality:
        yield from _sameness(vocabulary, [clause for clause, _ in stated])
    if DIFFERENT in used:
        yield from _difference(is_equality)
    if THING in used:
        yield from _things(vocabulary, is_equality, [clause for clause, _ in stated])
    else:
        known = {arg for clause, _ in stated if not clause.body for arg in clause.head.args}
        yield from ((fact, "") for fact in _facts(vocabulary) if fact.head[1] not in known)


def _sameness(vocabulary: Vocabulary, clauses: Collection[Clause]) -> Iterator[Cited]:
    yield _rule(("same", _Y, _X), ("same", _X, _Y)), "what is the same is so both ways"
    yield _rule(("same", _X, _Z), ("same", _X, _Y), ("same", _Y, _Z), ("\\=", _X, _Z)), "and all the way"
    computed = _computed(clauses)
    for name, kind in predicates(vocabulary):
        if (name, 2) in computed and kind is not Kind.CLASS:
            rules = _shared_facts(name, kind, clauses)
        else:
            rules = _shared(name, kind)
        yield from ((rule, "what is the same shares everything") for rule in rules)


def _shared(name: str, kind: Kind) -> Iterator[Clause]:
    """What holds of a thing under one name holds under the others."""
    if kind is Kind.CLASS:
        yield _rule((name, _Y), (name, _X), ("same", _X, _Y))
        return
    yield _rule((name, _Y, _Z), (name, _X, _Z), ("same", _X, _Y))
    if kind is Kind.OBJECT:
        yield _rule((name, _X, _Z), (name, _X, _Y), ("same", _Y, _Z))


def _shared_facts(name: str, kind: Kind, clauses: Iterable[Clause]) -> Iterator[Clause]:
    """The same for a property that is computed, fact by fact: a rule that needs itself and computes has no end.

    What its rules conclude is shared already, since all they need is.
    """
    for clause in clauses:
        if clause.head.indicator == (name, 2) and not clause.body:
            subject, value = clause.head.args
            yield _rule((name, _X, value), ("same", subject, _X))


def _difference(is_equality: bool) -> Iterator[Cited]:
    group = Variable("G")
    apart = (("apart", group, _X), ("apart", group, _Y), ("\\=", _X, _Y))
    yield _rule(("different", _X, _Y), *apart), "what is stated to differ differs"
    yield _rule(("different", _Y, _X), ("different", _X, _Y)), "both ways"
    if is_equality:
        yield _rule(("different", _X, _Z), ("different", _X, _Y), ("same", _Y, _Z)), "whatever it is called"


def _computed(clauses: Iterable[Clause]) -> set[Indicator]:
    """Predicates with a rule that computes: they must not need themselves, or they would have no end."""
    return {clause.head.indicator for clause in clauses if any(x.atom[0] == "is" for x in clause.body)}


def _things(vocabulary: Vocabulary, is_equality: bool, clauses: Iterable[Clause]) -> Iterator[Cited]:
    computed = _computed(clauses)
    for name, kind in predicates(vocabulary):
        if kind is Kind.DATA and (name, 2) in computed:
            continue  # its rules say of what is a thing already
        if kind is Kind.CLASS:
            yield _rule(("thing", _X), (name, _X)), "what is something is a thing"
        else:
            yield _rule(("thing", _X), (name, _X, _ANY)), "what has a property is a thing"
        if kind is Kind.OBJECT:
            yield _rule(("thing", _X), (name, _ANY, _X)), "what a property leads to is a thing"
    if is_equality:
        yield _rule(("thing", _X), ("same", _X, _ANY)), "what has two names is a thing"
    yield from ((fact, "") for fact in _facts(vocabulary))


def _facts(vocabulary: Vocabulary) -> Iterator[Clause]:
    return (Clause(Compound(("thing", vocabulary.names[iri]))) for iri in sorted(_individuals(vocabulary)))


def _individuals(vocabulary: Vocabulary) -> Iterable[str]:
    return (i for i, kinds in vocabulary.ontology.kinds.items() if Kind.INDIVIDUAL in kinds and i in vocabulary.names)


def undefined(clauses: Iterable[Clause]) -> set[Indicator]:
    """Predicates that conditions need and no clause gives."""
    every = list(clauses)
    needed = {x.atom.indicator for clause in every for x in clause.body if not x.is_comparison}
    return needed - {clause.head.indicator for clause in every} - BUILTINS
