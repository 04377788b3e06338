"""What an aggregate was worked out of, in words: "3 of at most 2 helpers: ann, bob, eve"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from casper.kb.reasons.wording import noun_phrase
from casper.kb.terms.clauses import Literal
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, Variable
from casper.kb.terms.unification import Bindings, is_ground, substitute, variables_of
from casper.kb.terms.unknown import DOUBT
from casper.kb.top_down.solve import Solver

MOST_NAMED = 10
_BOUNDS = {"=<": "at most", "<": "fewer than", ">=": "at least", ">": "more than", "=:=": "exactly", "=": "exactly"}
_MIRRORED = {"=<": ">=", "<": ">", ">=": "=<", ">": "<"}


def told(literal: Literal, body: Sequence[Literal], solution: Bindings, solver: Solver) -> Literal:
    """The instance of a failing condition, with a remark where it fails by what an aggregate came to."""
    instance = literal.instance(solution)
    if literal.is_aggregate:
        return replace(instance, remark=_other_value(literal, solution, solver))
    for other in body if literal.is_comparison and not literal.negated else ():
        if other.is_aggregate and other.atom[1] == "count" and other.atom[3] in literal.atom.args:
            return replace(instance, remark=_too_many(literal, other, solution, solver))
    return instance


def counted(literal: Literal, solver: Solver) -> str:
    """The answers that an aggregate was worked out of, in a few words."""
    found = _answers(literal, {}, solver)
    named = ", ".join(found[:MOST_NAMED]) + (", …" if len(found) > MOST_NAMED else "")
    return f"of {named}" if found else "of nothing"


def _too_many(literal: Literal, count: Literal, solution: Bindings, solver: Solver) -> str:
    operator, left, right = literal.atom
    if left != count.atom[3]:
        operator, left, right = _MIRRORED.get(operator, operator), right, left
    limit = substitute(right, solution)
    if operator not in _BOUNDS or not isinstance(limit, (int, float)):
        return ""
    found = _answers(count, solution, solver)
    named = ", ".join(found[:MOST_NAMED]) + (", …" if len(found) > MOST_NAMED else "")
    noun = _noun(count, solution, one=limit == 1)
    return f"{len(found)} of {_BOUNDS[operator]} {term_text(limit)} {noun}" + (f": {named}" if found else "")


def _noun(count: Literal, solution: Bindings, one: bool) -> str:
    """What is counted: a predicate's name, or the goal as it was written."""
    goal = count.instance(solution).shown
    goal = goal[2] if isinstance(goal, Compound) and goal.arity == 3 else goal
    if isinstance(goal, Compound) and goal.arity == 1:
        noun = noun_phrase(goal.functor).removeprefix("a ").removeprefix("an ")
        return noun if one or noun.endswith("s") else f"{noun}s"
    return term_text(goal)


def _other_value(literal: Literal, solution: Bindings, solver: Solver) -> str:
    """What the aggregate comes to instead of the result that was asked for."""
    value = Variable("Value", -1)
    asked = replace(literal, atom=Compound((*literal.atom[:3], value)))
    shown = literal.instance(solution).shown
    found = next(iter(solver.solve([asked], solution)), None)
    if found is None or not isinstance(shown, Compound):
        return ""
    written = term_text(Compound((*shown[:-1], Variable("N"))))
    return f"{written} gives {term_text(substitute(value, found))}, not {term_text(shown[-1])}"


def _answers(literal: Literal, solution: Bindings, solver: Solver) -> list[str]:
    """The answers of what is counted, each by the values of its own variables."""
    atom: Compound = substitute(literal.atom[2], solution)
    own: list[Term] = [v for v in variables_of(atom) if not v.name.startswith("_#tag")]
    found: dict[Compound, str] = {}
    for answer in solver.possible([Literal(atom)]):
        instance = substitute(atom, answer)
        if DOUBT not in answer and is_ground(instance):
            found.setdefault(instance, " ".join(term_text(substitute(v, answer)) for v in own))
    return list(found.values())
