"""Class expressions as conclusions: what follows for a thing that is one, as rules and constraints."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from casper.kb.ontologies.citing import cited
from casper.kb.ontologies.expressions import NOTHING, THING, Expression, Iri, Part
from casper.kb.ontologies.meaning.class_bodies import conditions
from casper.kb.ontologies.meaning.data_ranges import Body, outside, within
from casper.kb.ontologies.vocabulary.refusals import Beyond, Said
from casper.kb.ontologies.vocabulary.scope import Scope, literal
from casper.kb.terms.clauses import Clause, Literal
from casper.kb.terms.terms import Compound, Term

_EXISTS = "it says that there is something, which no rule can name; state it as a fact where it is known"


def never(scope: Scope, body: Body) -> Clause:
    """A constraint that cites the axiom."""
    return Clause(Compound(("never", scope.sentence)), body)


def said(make: Callable[[], Iterator[Said]]) -> Iterator[Said]:
    """What a translation gives; a reason it raises is handed on like any other."""
    try:
        yield from make()
    except Beyond as reason:
        yield reason


def implied(concept: Part, thing: Term, body: Body, scope: Scope) -> Iterator[Said]:
    """What follows when the body holds and the thing is therefore one."""
    return said(lambda: _implied(concept, thing, body, scope))


def _implied(concept: Part, thing: Term, body: Body, scope: Scope) -> Iterator[Said]:
    if concept == THING:
        return
    if concept == NOTHING:
        yield never(scope, body or (literal("=", thing, thing),))
        return
    match concept:
        case Iri():
            yield Clause(Compound((scope.vocabulary.name(concept), thing)), body)
        case Expression("IntersectionOf", parts):
            for part in parts:
                yield from implied(part, thing, body, scope)
        case Expression("ComplementOf", (part,)):
            for more in conditions(part, thing, scope):
                yield never(scope, (*body, *more))
        case Expression("HasValue", (on, value)) | Expression("SomeValuesFrom", (on, Expression("OneOf", (value,)))):
            yield Clause(scope.held(on, thing, scope.vocabulary.constant(value)), body)
        case Expression("HasSelf", (on,)):
            yield Clause(scope.held(on, thing, thing), body)
        case Expression("AllValuesFrom", (on, filler)):
            yield from _all(on, filler, thing, body, scope)
        case Expression("MaxCardinality" | "ExactCardinality" | "MinCardinality"):
            yield from _counted(concept, thing, body, scope)
        case Expression("OneOf", (only,)):
            yield equal(thing, scope.vocabulary.constant(only), body)
        case Expression("UnionOf", (only,)):
            yield from implied(only, thing, body, scope)
        case _:
            raise Beyond(_reason(concept))


def equal(one: Term, other: Term, body: Body) -> Clause:
    """That two individuals are the same; same/2 relates different names only."""
    return Clause(Compound(("same", one, other)), (*body, literal("\\=", one, other)))


def _all(on: Part, filler: Part, thing: Term, body: Body, scope: Scope) -> Iterator[Said]:
    is_data = scope.vocabulary.is_data(on)
    other = scope.fresh(is_data)
    edge = (*body, literal(*scope.held(on, thing, other)))
    if not is_data or filler == NOTHING:
        yield from implied(filler, other, edge, scope)
        return
    for way in outside(filler, other, scope, on):
        yield never(scope, (*edge, *way))


def _counted(concept: Expression, thing: Term, body: Body, scope: Scope) -> Iterator[Said]:
    number, on, *qualified = concept.args
    filler = qualified[0] if qualified else THING
    if concept.name == "MinCardinality":
        if number != 0:
            yield Beyond(_reason(concept))
        return
    if concept.name == "ExactCardinality" and number != 0:
        yield Beyond(f"of {cited(concept)} only the most is used: {_EXISTS}")
    if number not in (0, 1):
        yield Beyond(f"{cited(concept)} counts further than 1, which rules of the profile cannot")
        return
    yield from at_most(int(str(number)), on, filler, thing, body, scope)


def at_most(number: int, on: Part, filler: Part, thing: Term, body: Body, scope: Scope) -> Iterator[Said]:
    """That a thing has none, or at most one, of the values in question."""
    is_data = scope.vocabulary.is_data(on)
    found: list[tuple[Term, list[Body]]] = []
    for _ in range(number + 1):
        value = scope.fresh(is_data)
        edge: Literal = literal(*scope.held(on, thing, value))
        found.append((value, [(edge, *rest) for rest in _fillers(filler, value, on, scope)]))
    if number == 0:
        yield from (never(scope, (*body, *way)) for way in found[0][1])
        return
    (one, ways), (other, more) = found
    for way, second in ((a, b) for a in ways for b in more):
        if is_data:
            yield never(scope, (*body, *way, *second, literal("\\=", one, other)))
        else:
            yield equal(one, other, (*body, *way, *second))


def _fillers(filler: Part, value: Term, on: Part, scope: Scope) -> list[Body]:
    if filler == THING:
        return [()]
    return within(filler, value, scope, on) if scope.vocabulary.is_data(on) else conditions(filler, value, scope)


def _reason(concept: Part) -> str:
    name = concept.name if isinstance(concept, Expression) else ""
    if name in ("SomeValuesFrom", "MinCardinality"):
        return f"of {cited(concept)} nothing is used: {_EXISTS}"
    if name in ("UnionOf", "OneOf"):
        return f"from {cited(concept)} nothing follows for certain: rules have no conclusion with a choice"
    return f"{cited(concept)} is no class expression that rules can conclude"
