"""Bodies by themselves, whatever the facts: conditions that contradict each other, and clauses said twice."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from casper.kb.checks.finding import Finding, warning
from casper.kb.errors import Place
from casper.kb.terms.clauses import Clause, Directive, Literal, Sentence
from casper.kb.terms.comparison import compare
from casper.kb.terms.terms import Compound, Term, Variable
from casper.kb.terms.unification import Bindings, is_ground, substitute, unify, variables_of
from casper.kb.terms.values.arithmetic import EvaluationFailed
from casper.kb.text.writer import literal_text

_DIFFERENT = ("\\=", "\\==", "<", ">")  # what never holds between a thing and itself
_MIRRORED = {"<": ">", ">": "<", "=<": ">=", ">=": "=<"}
_EXCLUDED = {"<": (">", ">=", "=", "=="), ">": ("<", "=<", "=", "=="), "=<": (">",), ">=": ("<",)}


def contradictions(clause: Clause) -> Iterator[Finding]:
    """The first contradiction in a clause's body: it can never hold, so the clause says nothing."""
    clash = next(_clashes(clause), None)
    if clash is not None:
        shown = " and ".join(map(literal_text, clash))
        verb = "can never hold" if len(clash) == 1 else "can never hold together"
        nothing = "the constraint can never be broken" if clause.is_constraint else "the rule gives nothing"
        yield warning(clash[-1].place, f"{shown} {verb}; {nothing}")


def _clashes(clause: Clause) -> Iterator[tuple[Literal, ...]]:
    bindings: Bindings = {}
    equalities: list[Literal] = []
    for literal in clause.body:
        if _is_equality(literal):
            extended = unify(literal.atom[1], literal.atom[2], bindings)
            if extended is None:
                yield (*_about(literal, equalities), literal)
                return
            equalities.append(literal)
            bindings = extended
    for literal in clause.body:
        if literal.is_comparison and literal not in equalities and _fails(literal, bindings):
            yield (*_about(literal, equalities), literal)
    yield from _denied(clause.body, bindings)
    yield from _out_of_order(clause.body, bindings)


def _is_equality(literal: Literal) -> bool:
    return literal.is_comparison and literal.atom[0] in ("=", "==") and not literal.negated


def _about(literal: Literal, equalities: Iterable[Literal]) -> Iterator[Literal]:
    """The equalities that speak of the condition's variables."""
    variables = set(literal.variables())
    return (x for x in equalities if variables & set(x.variables()))


def _fails(literal: Literal, bindings: Bindings) -> bool:
    """Whether a comparison is false under the equalities of the body, whatever else is known."""
    operator, left, right = (substitute(part, bindings) for part in literal.atom)
    if is_ground(left) and is_ground(right):
        try:
            return compare(literal, bindings) is None
        except EvaluationFailed:
            return False  # it is undefined
    return left == right and operator in _DIFFERENT and not literal.negated


def _denied(body: Iterable[Literal], bindings: Bindings) -> Iterator[tuple[Literal, Literal]]:
    """A condition that is asked for and denied."""
    stated: dict[Compound, Literal] = {}
    for literal in body:
        atom = Compound((literal.negated, substitute(literal.atom, bindings)))
        opposite = stated.get(Compound((not literal.negated, atom[1])))
        if opposite is not None and not any(v.is_anonymous for v in literal.variables()):
            yield opposite, literal
        stated[atom] = literal


def _out_of_order(body: Iterable[Literal], bindings: Bindings) -> Iterator[tuple[Literal, Literal]]:
    """Two comparisons of the same sides that exclude each other: X < Y and Y < X, X < 2 and X > 3."""
    ordered: list[tuple[Literal, str, Term, Term]] = []
    for literal in body:
        if literal.is_comparison and not literal.negated and literal.atom[0] in _MIRRORED:
            operator, left, right = literal.atom[0], *(substitute(x, bindings) for x in literal.atom.args)
            if isinstance(right, Variable) and not isinstance(left, Variable):
                operator, left, right = _MIRRORED[operator], right, left
            for other, sign, a, b in ordered:
                if _exclude((operator, left, right), (sign, a, b)):
                    yield other, literal
            ordered.append((literal, operator, left, right))


def _exclude(one: tuple[str, Term, Term], two: tuple[str, Term, Term]) -> bool:
    (sign, left, right), (other, a, b) = one, two
    if (left, right) == (b, a):
        other, a, b = _MIRRORED[other], b, a
    if left != a:
        return False
    if right == b:
        return other in _EXCLUDED[sign]
    if not (isinstance(right, (int, float)) and isinstance(b, (int, float))):
        return False
    low, low_is_in, high, high_is_in = -math.inf, True, math.inf, True
    for operator, limit in ((sign, right), (other, b)):
        if operator in (">", ">=") and limit >= low:
            low, low_is_in = limit, operator == ">="
        if operator in ("<", "=<") and limit <= high:
            high, high_is_in = limit, operator == "=<"
    return low > high or (low == high and not (low_is_in and high_is_in))


def duplicates(sentences: Iterable[Sentence]) -> Iterator[Finding]:
    """Clauses and productions that say the same as an earlier one, be it with other names for their variables."""
    first: dict[object, Place] = {}
    for sentence in sentences:
        if isinstance(sentence, Directive):
            continue
        earlier = first.setdefault(_general(sentence), sentence.place)
        if earlier is not sentence.place:  # alternatives of one rule share theirs
            where = f"line {earlier.line}"
            if earlier.file != sentence.place.file:
                where = f"{earlier.file.rsplit('/', 1)[-1]}:{earlier.line}"
            yield warning(sentence.place, f"this says the same as {where}; take one of them out")


def _general(sentence: Sentence) -> object:
    """The sentence with its variables numbered: equal for sentences that differ in their names only."""
    if isinstance(sentence, Directive):
        return sentence
    parts: list[Term] = [sentence.head]
    if isinstance(sentence, Clause):
        parts += [Compound((x.negated, x.atom)) for x in sentence.body]
    else:
        parts.append(Compound(("-->", sentence.body)))
    names = {v: Variable("V", number) for number, v in enumerate(variables_of(*parts), 1)}
    return type(sentence), tuple(substitute(part, names) for part in parts)
