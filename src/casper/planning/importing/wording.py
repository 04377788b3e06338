"""Tests of problems as conditions of clauses: one `Wording` for each clause, with its variables.

A fluent is asked at a moment: ``holds(at(V, L), now)``, and where it has a value, ``value(fuel(V), Fuel, now)``. What
nothing changes is a plain fact: ``road(A, B)``, ``length(A, B, Length)``.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from typing import Any

from unified_planning.model import FNode, OperatorKind, Parameter

from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, Variable
from casper.planning.importing.alternatives import APART, Every, Row, Test, Unsaid
from casper.planning.importing.names import Fresh, outward, variable_name
from casper.planning.importing.vocabulary import Vocabulary, number

NOW = "now"
_ARITHMETIC = {OperatorKind.PLUS: "+", OperatorKind.MINUS: "-", OperatorKind.TIMES: "*", OperatorKind.DIV: "/"}


class Wording:
    """The variables of one clause, and what of fluents it has asked.

    Args:
        vocabulary: the problem's names.
        parameters: those of the clause, which are variables from the beginning.
        moment: when fluents are asked: the name of a variable, or ``now``.
    """

    def __init__(self, vocabulary: Vocabulary, parameters: Sequence[Parameter], moment: str = NOW) -> None:
        self.vocabulary, self._fresh = vocabulary, Fresh()
        self._known: dict[Any, Variable] = {p.name: self.variable(p.name) for p in parameters}
        self.arguments: list[Term] = [self._known[p.name] for p in parameters]
        self.moment: Term = NOW if moment == NOW else self.variable(moment)
        self._values: dict[FNode, Term] = {}  # what fluents are, as far as it was asked
        self._asked: list[Term] = []

    def variable(self, wanted: str) -> Variable:
        """A new variable."""
        return Variable(self._fresh.name(variable_name(wanted)))

    def types(self, parameters: Sequence[Parameter]) -> list[Term]:
        """The types of the parameters, as conditions."""
        return [self.vocabulary.of_type(p.type, self._known[p.name]) for p in parameters]

    def row(self, row: Row) -> list[Term]:
        """A row of tests as conditions."""
        said: list[Term] = self.bound(row.variables)
        for test in row.tests:
            said += self._test(test)
        return said

    def alternatives(self, rows: Sequence[Row]) -> Term:
        """Rows of which one holds, as one condition.

        What one of them asks is known in it alone. No two stand together, so they share names; what follows does not,
        for a name that stands within and without would be one thing.
        """
        values, fresh, met = dict(self._values), self._fresh, self._fresh.copy()
        found: list[Term] = []
        for row in rows:
            self._values, self._fresh = dict(values), fresh.copy()
            said = conjunction(self.row(row))
            found += [said] if said not in found else []
            met.take(self._fresh)
        self._values, self._fresh = values, met
        return _chained(";", found) if found else "fail"

    def bound(self, variables: Sequence[Any]) -> list[Term]:
        """New variables with their types."""
        for variable in variables:
            self._known[variable] = self.variable(variable.name.split(APART)[0])
        return [self.vocabulary.of_type(v.type, self._known[v]) for v in variables]

    def value(self, expression: FNode) -> tuple[list[Term], Term]:
        """What must be asked for the value of an expression, and the value: a term, or a sum to be worked out."""
        found = self._term(expression)
        return self._taken(), found

    def fluent(self, expression: FNode) -> tuple[list[Term], Term]:
        """What must be asked for the arguments of a fluent, and the fluent as a thing that changes."""
        arguments = [self._term(argument) for argument in expression.args]
        return self._taken(), thing(self._name(expression), arguments)

    def _taken(self) -> list[Term]:
        asked, self._asked = self._asked, []
        return asked

    # --- tests -----------------------------------------------------------------------------------------------------

    def _test(self, test: Test | Every) -> list[Term]:
        if isinstance(test, Every):
            return [self._every(test)]
        said = self._said(test.expression, test.positive)
        return [*self._taken(), said]

    def _every(self, test: Every) -> Term:
        types = self.bound(test.variables)
        return Compound(("forall", conjunction(types), self.alternatives(test.alternatives)))

    def _said(self, expression: FNode, positive: bool) -> Term:
        if expression.is_fluent_exp():
            asked = self._holds(expression)
            return asked if positive else Compound(("\\+", asked))
        if expression.is_equals():
            one, other = (self._term(each) for each in expression.args)
            signs = ("=:=", "=\\=") if _is_number(expression.arg(0)) else ("=", "\\=")
            return Compound((signs[not positive], one, other))
        if expression.is_le() or expression.is_lt():
            one, other = (self._term(each) for each in (expression.args if positive else reversed(expression.args)))
            return Compound(("<" if expression.is_lt() is positive else "=<", one, other))
        raise Unsaid(f"{expression} is a condition that clauses do not have")

    def _holds(self, expression: FNode) -> Term:
        name = self._name(expression)
        arguments = [self._term(argument) for argument in expression.args]
        if name in self.vocabulary.facts:
            return Compound((outward(name), *arguments))
        return Compound(("holds", thing(name, arguments), self.moment))

    def _name(self, expression: FNode) -> str:
        self.vocabulary.check(expression.fluent())
        return str(expression.fluent().name)

    # --- values ----------------------------------------------------------------------------------------------------

    def _term(self, expression: FNode) -> Term:
        if expression.is_object_exp():
            return str(expression.object().name)
        if expression.is_parameter_exp():
            return self._known[expression.parameter().name]
        if expression.is_variable_exp():
            return self._known[expression.variable()]
        if expression.is_int_constant() or expression.is_real_constant():
            return number(expression.constant_value())
        if expression.node_type in _ARITHMETIC:
            sign = _ARITHMETIC[expression.node_type]
            return reduce(lambda one, other: Compound((sign, one, other)), map(self._term, expression.args))
        if expression.is_fluent_exp() and not expression.fluent().type.is_bool_type():
            return self._looked_up(expression)
        raise Unsaid(f"{expression} stands for a value, which clauses do not have")

    def _looked_up(self, expression: FNode) -> Term:
        if expression not in self._values:
            name = self._name(expression)
            arguments = [self._term(argument) for argument in expression.args]
            found = self.variable(name)
            if name in self.vocabulary.facts:
                asked = Compound((outward(name), *arguments, found))
            else:
                asked = Compound(("value", thing(name, arguments), found, self.moment))
            self._asked.append(asked)
            self._values[expression] = found
        return self._values[expression]


def thing(name: str, arguments: Sequence[Term]) -> Term:
    """A fluent as a thing that changes."""
    return Compound((name, *arguments)) if arguments else name


def conjunction(terms: Sequence[Term]) -> Term:
    """Conditions as one."""
    return _chained(",", terms) if terms else "true"


def _chained(joint: str, terms: Sequence[Term]) -> Term:
    """Terms as the language has them between commas or semicolons: two by two, from the right."""
    return reduce(lambda rest, term: Compound((joint, term, rest)), reversed(terms))


def asked_now(body: Sequence[Term]) -> list[Term]:
    """Conditions that are asked at a moment, if need be of no fluent: what only depends on types would be listed, and
    there are as many rows as ways to fill the parameters."""
    return list(body) if any(map(_looks_back, body)) else [Compound(("moment", NOW)), *body]


def _looks_back(term: Term) -> bool:
    if not isinstance(term, Compound):
        return False
    return term.indicator in (("holds", 2), ("value", 3)) or any(map(_looks_back, term.args))


def clause_text(head: Term, body: Sequence[Term]) -> str:
    """A clause as it is written."""
    said = ", ".join(term_text(term, 999) for term in body)
    return f"{term_text(head)} :- {said}." if said else f"{term_text(head)}."


def _is_number(expression: FNode) -> bool:
    kind = expression.type
    return bool(kind.is_int_type() or kind.is_real_type())
