"""Sentences: what the parser reads becomes clauses, productions and directives, or is refused with its place."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from math import prod
from typing import NoReturn, TypeAlias

from casper.kb.errors import Place
from casper.kb.terms.clauses import Clause, Directive, Literal, Production, Sentence
from casper.kb.terms.syntax import COMPARISONS, term_text
from casper.kb.terms.terms import Compound, Term, Variable, predication
from casper.kb.terms.unification import variables_of
from casper.kb.text.directives import OP, Refused, declare, each_of
from casper.kb.text.namespace import goal_of
from casper.kb.text.parsing.conditions import Condition, ConditionParser
from casper.kb.text.parsing.places import Places

MOST_ALTERNATIVES = 10_000  # of one body
TOO_MANY = f"this body has more than {MOST_ALTERNATIVES:,} alternatives; give groups of them names, as rules"
_TOP = 1199  # the highest priority of a head, or of what follows an arrow
Told: TypeAlias = Callable[[Directive], None]  # who is told of each directive as soon as it is read


def sentences_read(parser: ConditionParser, places: Places, told: Told | None) -> list[Sentence]:
    """The clauses of one sentence: a rule whose body has alternatives is one clause for each."""
    place = places.of(parser.starts[0])
    if parser.texts[0] == ":-" and not parser.opens(0):
        return _directives(parser, place, told)
    start = parser.start_within_brackets()
    term = parser.term(_TOP)
    arrow = parser.texts[parser.at]
    if arrow not in (":-", "-->"):
        parser.stop()
        return [Clause(_statement(term, start, parser), (), place)]
    head = _statement(term, start, parser)
    parser.at += 1
    if arrow == "-->":
        body = parser.sequence(_TOP)
        parser.stop("','")
        return [Production(head, body, place)]
    condition = parser.body()
    parser.stop("','")
    bodies = alternatives(condition, places, parser)
    return [Clause(*_renumbered(head, literals), place) for literals in bodies]


def _directives(parser: ConditionParser, place: Place, told: Told | None) -> list[Sentence]:
    """What follows ``:-``: operators are declared at once, and are no sentence."""
    parser.at = 1
    start = parser.start_within_brackets()
    term = parser.term(_TOP)
    parser.stop()
    try:
        statement = predication(term)
    except TypeError:
        _cannot_stand(term, start, parser)
    if statement.indicator == OP:
        try:
            declare(statement, parser.operators)
        except Refused as mistake:
            parser.refuse(parser.starts[0], mistake.sentence, mistake.quoted)
        return []
    found = [Directive(each, place) for each in each_of(statement)]
    if told is not None:
        for directive in found:
            told(directive)
    return list(found)


def _renumbered(head: Compound, body: list[Literal]) -> tuple[Compound, tuple[Literal, ...]]:
    """The clause with its anonymous variables numbered anew: equal clauses are equal however they were written."""
    anonymous = [v for v in variables_of(head, *(x.atom for x in body)) if v.name.startswith("_#")]
    if not anonymous:
        return head, tuple(body)
    names = {old: Variable(f"_#{number}") for number, old in enumerate(anonymous, 1)}
    literals = tuple(Literal(_renamed(x.atom, names), x.negated, x.place) for x in body)
    return _renamed(head, names), literals


def _renamed(term: Term, names: dict[Variable, Variable]) -> Term:
    if isinstance(term, Compound):
        return Compound([_renamed(part, names) for part in term])
    return names.get(term, term) if isinstance(term, Variable) else term


def _statement(term: Term, start: int, parser: ConditionParser) -> Compound:
    """The term that was just read as something that can be true.

    Raises:
        ReadError: it is a number, a variable, a list, or written with an operator of the standard table.
    """
    if not parser.is_named or (isinstance(term, Compound) and term.indicator == (":", 2)):
        _cannot_stand(term, start, parser)
    return predication(term)


def _cannot_stand(term: Term, start: int, parser: ConditionParser) -> NoReturn:
    quoted = term_text(term)
    parser.refuse(start, f"{quoted} cannot stand here: a name or name(arguments) is needed", quoted)


def alternatives(condition: Condition, places: Places, parser: ConditionParser) -> list[list[Literal]]:
    """A body in disjunctive normal form: alternatives, each a list of literals in the author's order.

    What is negated as a whole, and ``(C -> T ; E)``, stays one literal: `kb.program.control` takes it apart.

    Raises:
        ReadError: there are too many of them.
    """
    if _number_of_alternatives(condition) > MOST_ALTERNATIVES:
        parser.refuse(parser.starts[0], TOO_MANY)
    return _alternatives(condition, places, parser)


def _alternatives(condition: Condition, places: Places, parser: ConditionParser) -> list[list[Literal]]:
    if condition.shape == "or" and all(part.shape != "then" for part in condition.parts):
        return [body for part in condition.parts for body in _alternatives(part, places, parser)]
    if condition.shape == "and":
        parts = [_alternatives(part, places, parser) for part in condition.parts]
        return [[literal for part in choice for literal in part] for choice in product(*parts)]
    return [[_literal(condition, places, parser)]]


def _number_of_alternatives(condition: Condition) -> int:
    """How many clauses `alternatives` makes of a body."""
    counts = [_number_of_alternatives(part) for part in condition.parts] if condition.shape in ("and", "or") else []
    if condition.shape == "or" and all(part.shape != "then" for part in condition.parts):
        return sum(counts)
    return prod(counts) if condition.shape == "and" else 1


def _literal(condition: Condition, places: Places, parser: ConditionParser, negated: bool = False) -> Literal:
    if condition.shape == "not":
        return _literal(condition.parts[0], places, parser, not negated)
    if condition.shape != "goal":
        _check_goals(condition, parser)
        return Literal(predication(goal_of(condition.term())), negated, places.of(condition.start))
    return Literal(_goal(condition, parser), negated, places.of(condition.start))


def _check_goals(condition: Condition, parser: ConditionParser) -> None:
    """Refuse what cannot stand as a condition, wherever it does."""
    if condition.shape == "goal":
        _goal(condition, parser)
    for part in condition.parts:
        _check_goals(part, parser)


def _goal(condition: Condition, parser: ConditionParser) -> Compound:
    """A condition's atom: a name, ``name(arguments)``, with a prefix or not, or a comparison."""
    term = goal_of(condition.goal)
    is_pair = isinstance(term, Compound) and term.indicator == (":", 2)
    is_qualified = term is not condition.goal and not is_pair
    is_comparison = isinstance(term, Compound) and term.arity == 2 and term.functor in COMPARISONS
    if is_pair or not (condition.is_named or is_qualified or is_comparison):
        _cannot_stand(term, condition.start, parser)
    return predication(term)
