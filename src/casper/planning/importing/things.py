"""Types, objects, fluents and the initial state, as facts and rules."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from unified_planning.model import Fluent, Type
from unified_planning.model.fluent import get_all_fluent_exp

from casper.kb.terms.syntax import atom_text
from casper.kb.terms.terms import Compound, Term, Variable
from casper.planning.importing.alternatives import Unsaid
from casper.planning.importing.names import outward
from casper.planning.importing.vocabulary import Vocabulary, number
from casper.planning.importing.wording import clause_text, thing

_X = Variable("X")


def type_lines(vocabulary: Vocabulary) -> Iterator[str]:
    """Every type with what it is a kind of."""
    types = vocabulary.problem.user_types
    parents = {kind.father for kind in types}
    filled = {thing.type for thing in vocabulary.problem.all_objects}
    for kind in types:
        yield clause_text(Compound(("type", kind.name)), ())
    for kind in types:
        if kind.father is not None:
            yield clause_text(Compound(("subtype", kind.name, kind.father.name)), ())
            yield clause_text(Compound((outward(kind.father.name), _X)), [Compound((outward(kind.name), _X))])
        if kind not in parents and kind not in filled:
            yield dynamic(outward(kind.name), 1)


def object_lines(vocabulary: Vocabulary) -> Iterator[str]:
    """Every object with its type."""
    for each in vocabulary.problem.all_objects:
        yield clause_text(vocabulary.of_type(each.type, each.name), ())


def agent_lines(vocabulary: Vocabulary) -> Iterator[str]:
    """Who is watched, who helps, and who may act where no parameter says who does."""
    for role, name in (("partner", vocabulary.partner), ("robot", vocabulary.robot)):
        yield clause_text(Compound(("setting", "agents", role, name)), ())
    named = dict.fromkeys((vocabulary.partner, vocabulary.robot))
    if vocabulary.agent_type is None:
        yield from (clause_text(Compound(("actor", name)), ()) for name in named)
        return
    yield clause_text(Compound(("actor", _X)), [vocabulary.of_type(vocabulary.agent_type, _X)])
    for action in vocabulary.problem.actions:
        at = vocabulary.agent_index(action)
        if at is not None:
            yield clause_text(Compound(("agent_parameter", outward(action.name), at + 1)), ())


def fluent_lines(vocabulary: Vocabulary) -> Iterator[str]:
    """Every fluent with the types of its parameters and of its value."""
    for fluent in said_fluents(vocabulary):
        types = [vocabulary.type_name(parameter.type) for parameter in fluent.signature]
        yield clause_text(Compound(("fluent", thing(fluent.name, types), _value_type(fluent.type))), ())


def said_fluents(vocabulary: Vocabulary) -> list[Fluent]:
    """Those that can be said, by name."""
    said = [fluent for fluent in vocabulary.problem.fluents if fluent.name not in vocabulary.unsaid]
    return sorted(said, key=lambda fluent: str(fluent.name))


def _value_type(kind: Type) -> Term:
    if kind.is_bool_type():
        return "boolean"
    if kind.is_user_type():
        return str(kind.name)
    name = "integer" if kind.is_int_type() else "real"
    if kind.lower_bound is None and kind.upper_bound is None:
        return name
    least = Compound(("-", "inf")) if kind.lower_bound is None else number(kind.lower_bound)
    return Compound((name, least, "inf" if kind.upper_bound is None else number(kind.upper_bound)))


def initial_lines(vocabulary: Vocabulary) -> Iterator[str]:
    """What holds at first, sorted; what may change as ``initially``, what does not as it is."""
    changing = {"initially": 1, "initial_value": 2}
    for fluent in said_fluents(vocabulary):
        lines = sorted({clause_text(fact, ()) for fact in _initial(vocabulary, fluent)})
        yield from lines
        if fluent.name not in vocabulary.facts:
            if lines:
                changing.pop("initially" if fluent.type.is_bool_type() else "initial_value", None)
        elif not lines:
            yield dynamic(outward(fluent.name), fluent.arity + (not fluent.type.is_bool_type()))
    for name, arity in changing.items():
        yield dynamic(name, arity)


def _initial(vocabulary: Vocabulary, fluent: Fluent) -> Iterator[Term]:
    for expression, value in _values(vocabulary, fluent):
        arguments = [_constant(argument) for argument in expression.args]
        if value.is_bool_constant():
            if value.bool_constant_value():
                known = thing(fluent.name, arguments)
                is_fact = fluent.name in vocabulary.facts
                yield _fact(fluent.name, arguments) if is_fact else Compound(("initially", known))
        elif fluent.name in vocabulary.facts:
            yield _fact(fluent.name, [*arguments, _constant(value)])
        else:
            yield Compound(("initial_value", thing(fluent.name, arguments), _constant(value)))


def _fact(name: str, arguments: list[Term]) -> Term:
    return Compound((outward(name), *arguments))


def _values(vocabulary: Vocabulary, fluent: Fluent) -> Iterator[tuple[Any, Any]]:
    """The fluent's ground expressions with their first values; where it is false unless stated, the stated ones."""
    problem = vocabulary.problem
    stated = {e: v for e, v in problem.explicit_initial_values.items() if e.fluent() == fluent}
    if not vocabulary.defaults(fluent):
        yield from stated.items()
        return
    default = problem.fluents_defaults[fluent]
    for expression in get_all_fluent_exp(problem, fluent):
        yield expression, stated.get(expression, default)


def _constant(expression: Any) -> Term:
    if expression.is_object_exp():
        return str(expression.object().name)
    if expression.is_int_constant() or expression.is_real_constant():
        return number(expression.constant_value())
    raise Unsaid(f"{expression} is no object and no number")


def dynamic(name: str, arity: int) -> str:
    """The directive that a predicate is known, though it has no facts."""
    return f":- dynamic {atom_text(name)}/{arity}."


