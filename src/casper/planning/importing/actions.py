"""Actions as rules that say when they are valid, and as clauses that say what they change.

    drive(Agent, V, A, B) :- actor(Agent), vehicle(V), place(A), place(B), holds(at(V, A), now), road(A, B).
    initiates(drive(_, V, _, B), at(V, B), _).
    terminates(drive(_, V, A, _), at(V, A), _).
    changes(drive(_, V, _, _), fuel(V), _).
    assigns(drive(_, V, _, _), fuel(V), N, T) :- value(fuel(V), Fuel, T), N is Fuel - 1.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import Any

from unified_planning.model import FNode, InstantaneousAction

from casper.kb.terms.terms import Compound, Term, Variable
from casper.kb.terms.unification import variables_of
from casper.planning.importing.alternatives import Row, Unsaid, all_of, rows_of
from casper.planning.importing.names import outward
from casper.planning.importing.vocabulary import Vocabulary
from casper.planning.importing.wording import Wording, asked_now, clause_text

MOMENT = "t"  # the parameter that stands for when: T
_ANYBODY, _ANY = "agent", Variable("_")


def action_lines(vocabulary: Vocabulary, action: Any) -> list[str]:
    """The rule and the effects of an action.

    Raises:
        Unsaid: something of it has no clause; then none of it is said.
    """
    if not isinstance(action, InstantaneousAction):
        raise Unsaid("it takes time, and actions here happen at one moment; split it into its start and its end")
    if action.simulated_effect is not None:
        raise Unsaid("it has effects that only a program knows; say them as effects")
    return [*dict.fromkeys(_rule(vocabulary, action)), *_effects(vocabulary, action)]


def _rule(vocabulary: Vocabulary, action: Any) -> Iterator[str]:
    for row in all_of(list(action.preconditions)) or (None,):
        wording = Wording(vocabulary, action.parameters)
        body, head = wording.types(action.parameters), None
        if vocabulary.agent_index(action) is None:
            agent = wording.variable(_ANYBODY)
            head = vocabulary.statement(action, wording.arguments, agent)
            body = [Compound(("actor", agent)), *body]
        else:
            head = vocabulary.statement(action, wording.arguments, _ANY)
        yield clause_text(head, asked_now([*body, *(["fail"] if row is None else wording.row(row))]))


def _effects(vocabulary: Vocabulary, action: Any) -> Iterator[str]:
    written = set[str]()
    for effect in _united(action):
        for text in _effect(vocabulary, action, *effect):
            if text not in written:
                written.add(text)
                yield text


def _united(action: Any) -> list[tuple[FNode, FNode, FNode, tuple[Any, ...]]]:
    """Fluent, new value, condition and variables of every effect; what is added to one fluent is added up."""
    manager = action.environment.expression_manager
    found: list[tuple[FNode, FNode, FNode, tuple[Any, ...]]] = []
    for effect in action.effects:
        if not (effect.is_assignment() or effect.is_increase() or effect.is_decrease()):
            raise Unsaid(f"{effect} goes on in time, and actions here happen at one moment")
        fluent, value = effect.fluent, effect.value
        at = next((n for n, other in enumerate(found) if other[0] == fluent), None)
        base = fluent
        if at is not None and not fluent.type.is_bool_type():
            certain = effect.condition.is_true() and found[at][2].is_true() and not effect.forall
            if effect.is_assignment() or not certain or not found[at][1].is_plus() | found[at][1].is_minus():
                raise Unsaid(f"several effects on {fluent} at once; say them as one")
            base = found.pop(at)[1]
        if not effect.is_assignment():
            value = manager.Plus(base, value) if effect.is_increase() else manager.Minus(base, value)
        found.append((fluent, value, effect.condition, tuple(effect.forall)))
    return found


def _effect(
    vocabulary: Vocabulary, action: Any, fluent: FNode, value: FNode, condition: FNode, every: Sequence[Any]
) -> Iterator[str]:
    if fluent.type.is_bool_type():
        manager = action.environment.expression_manager
        for row in rows_of(manager.And(condition, value)):
            yield _clause(vocabulary, action, "initiates", fluent, _with(row, every))
        for row in rows_of(manager.And(condition, manager.Not(value))):
            yield _clause(vocabulary, action, "terminates", fluent, _with(row, every))
        return
    for row in rows_of(condition):
        yield _clause(vocabulary, action, "changes", fluent, _with(row, every))
        yield _clause(vocabulary, action, "assigns", fluent, _with(row, every), value)


def _with(row: Row, every: Sequence[Any]) -> Row:
    return Row((*every, *row.variables), row.tests)


def _clause(
    vocabulary: Vocabulary, action: Any, relation: str, fluent: FNode, row: Row, value: FNode | None = None
) -> str:
    wording = Wording(vocabulary, action.parameters, MOMENT)
    body = wording.row(row)
    asked, changed = wording.fluent(fluent)
    body += asked
    results: list[Term] = []
    if value is not None:
        asked, result = wording.value(value)
        body += asked
        if isinstance(result, Compound):
            new = wording.variable("n")
            body.append(Compound(("is", new, result)))
            result = new
        results = [result]
    used = {*variables_of(changed, *results, *(term for term in body if isinstance(term, Compound)))}
    arguments = [term if term in used else _ANY for term in wording.arguments]
    moment = wording.moment if wording.moment in used else _ANY
    return clause_text(
        Compound((relation, vocabulary.statement(action, arguments, _ANY), changed, *results, moment)), body
    )


def alike(action: Any) -> Iterator[str]:
    """Pairs of effects that are on the same fluent when parameters are the same thing: then both values count."""
    valued = [effect.fluent for effect in getattr(action, "effects", ()) if not effect.fluent.type.is_bool_type()]
    for one, other in combinations(dict.fromkeys(valued), 2):
        if one.fluent() == other.fluent() and all(_may_be(a, b) for a, b in zip(one.args, other.args)):
            told = "say that they are not the same, or it has two values"
            yield f"{outward(action.name)} changes {one} and {other}: {told}"


def _may_be(one: FNode, other: FNode) -> bool:
    return one == other or not (one.is_constant() and other.is_constant())
