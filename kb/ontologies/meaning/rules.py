"""SWRL rules to clauses: one for every atom of the head and every alternative of the body."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from casper.kb.ontologies.citing import cited
from casper.kb.ontologies.expressions import SWRLB, Expression, Iri, Part, Unknown, parts_of
from casper.kb.ontologies.meaning.built_ins import ORDERING, built_in
from casper.kb.ontologies.meaning.class_bodies import conditions, is_same
from casper.kb.ontologies.meaning.class_heads import equal, implied, never, said
from casper.kb.ontologies.meaning.data_ranges import Body, conjoined, outside, within
from casper.kb.ontologies.vocabulary.refusals import Beyond, Said
from casper.kb.ontologies.vocabulary.scope import Scope, literal
from casper.kb.ontologies.vocabulary.values import is_number
from casper.kb.terms.clauses import Clause
from casper.kb.terms.terms import Compound, Variable


def rule(scope: Scope, body: Part, head: Part) -> Iterator[Said]:
    """What a rule says.

    Raises:
        Beyond: a condition has no counterpart, so nothing can be made of the rule.
    """
    scope.know(part.name for half in (body, head) for part in parts_of(half) if isinstance(part, Unknown))
    atoms, conclusions = (half.args if isinstance(half, Expression) else () for half in (body, head))
    _check_ordering(atoms, scope)
    ordered = sorted(atoms, key=_is_test)  # tests behind what binds, otherwise as the author has it
    alternatives = conjoined(*(_condition(atom, atoms, scope) for atom in ordered))
    for found in alternatives:
        if not conclusions:
            yield never(scope, found)
        for atom in conclusions:
            yield from _conclusion(atom, found, scope)


def _is_test(atom: Part) -> bool:
    tests = ("BuiltInAtom", "RangeAtom", "DifferentIndividualsAtom", "SameIndividualAtom")
    return isinstance(atom, Expression) and atom.name in tests


def _condition(atom: Part, atoms: Sequence[Part], scope: Scope) -> list[Body]:
    match atom:
        case Expression("ClassAtom", (concept, thing)):
            return conditions(concept, scope.term(thing), scope)
        case Expression("PropertyAtom", (on, subject, value)):
            return [(literal(*scope.held(on, scope.term(subject), scope.term(value))),)]
        case Expression("RangeAtom", (range_, value)):
            term = scope.term(value)
            _note_data(term, scope)
            return within(range_, term, scope, _property_of(value, atoms))
        case Expression("SameIndividualAtom", (one, other)):
            return is_same(scope.term(one), scope.term(other), scope)
        case Expression("DifferentIndividualsAtom", (one, other)):
            return [(literal("different", scope.term(one), scope.term(other)),)]
        case Expression("BuiltInAtom", (Iri(text), *args)):
            if not text.startswith(SWRLB):
                raise Beyond(f"{cited(Iri(text))} is no built-in of SWRL; state its results as facts")
            terms = [scope.term(arg) for arg in args]
            for term in terms:
                _note_data(term, scope)
            return [built_in(text.removeprefix(SWRLB), terms, scope)]
    raise Beyond(f"{cited(atom)} is no atom of SWRL")


def _note_data(term: object, scope: Scope) -> None:
    if isinstance(term, Variable):
        scope.data.add(term)


def _property_of(value: Part, atoms: Sequence[Part]) -> Part | None:
    """The data property that gives a variable its value."""
    for atom in atoms:
        if isinstance(atom, Expression) and atom.name == "PropertyAtom" and atom.args[-1] == value:
            return atom.args[0]
    return None


def _check_ordering(atoms: Sequence[Part], scope: Scope) -> None:
    """Refuse to compare what is known to be no number: it would never hold, and nobody would be told."""
    for atom in atoms:
        match atom:
            case Expression("BuiltInAtom", (Iri(text), *args)) if text.removeprefix(SWRLB) in ORDERING:
                for arg in args:
                    on = _property_of(arg, atoms) if isinstance(arg, Unknown) else None
                    if on is not None and not _has_numbers(on, scope):
                        raise Beyond(f"{cited(on)} has values that are no numbers; the language compares numbers")


def _has_numbers(on: Part, scope: Scope) -> bool:
    stated = {x.text for x in scope.vocabulary.ranges_of(on) if isinstance(x, Iri) and x.text.find("#Literal") < 0}
    spelt = scope.vocabulary.spelt.get(on.text, set()) if isinstance(on, Iri) else set()
    return all(is_number(x) or x in scope.vocabulary.datatypes for x in stated | spelt)


def _conclusion(atom: Part, body: Body, scope: Scope) -> Iterator[Said]:
    return said(lambda: _concluded(atom, body, scope))


def _concluded(atom: Part, body: Body, scope: Scope) -> Iterator[Said]:
    match atom:
        case Expression("ClassAtom", (concept, thing)):
            yield from implied(concept, scope.term(thing), body, scope)
        case Expression("PropertyAtom", (on, subject, value)):
            yield Clause(scope.held(on, scope.term(subject), scope.term(value)), body)
        case Expression("SameIndividualAtom", (one, other)):
            yield equal(scope.term(one), scope.term(other), body)
        case Expression("DifferentIndividualsAtom", (one, other)):
            yield Clause(Compound(("different", scope.term(one), scope.term(other))), body)
            for alike in is_same(scope.term(one), scope.term(other), scope):
                yield never(scope, (*body, *alike))
        case Expression("RangeAtom", (range_, value)):
            yield from (never(scope, (*body, *way)) for way in outside(range_, scope.term(value), scope))
        case _:
            raise Beyond(f"{cited(atom)} can be no conclusion of a rule")


