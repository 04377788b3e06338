"""Conditions of clauses as expressions of a problem: the inverse of `importing.wording`."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any, NoReturn, TypeAlias

from unified_planning.model import Variable as Bound

from casper.kb.errors import Place
from casper.kb.terms.terms import Compound, Term, Variable, predication
from casper.planning.exporting.target import Target, Unplanned, number_of, shown
from casper.planning.importing.names import inward, parameter_name

_ARITHMETIC = {"+": "Plus", "-": "Minus", "*": "Times", "/": "Div"}
_Case: TypeAlias = "Callable[[Scope, Compound], list[Any]]"


class Scope:
    """What the variables of one clause stand for.

    Args:
        target: the problem that is being made.
        known: parameters by variable.
        place: the clause's, for mistakes.
    """

    def __init__(self, target: Target, known: dict[Variable, Any], place: Place) -> None:
        self.target, self.known, self.place = target, dict(known), place
        self.bound: list[Any] = []  # the variables that the body brings in, in order

    def within(self) -> Scope:
        """A scope inside this one."""
        return Scope(self.target, self.known, self.place)

    def conditions(self, terms: Sequence[Term], free: Sequence[Any] = ()) -> list[Any]:
        """Conditions that hold together; variables that the body brings in exist, but for those that are ``free``."""
        terms = [part for term in terms for part in _parts(term, ",")]
        found: list[list[Any]] = [[] for _ in terms]
        for at in sorted(range(len(terms)), key=lambda at: _waits(terms[at])):  # a name means what binds it, wherever
            found[at] = self._condition(terms[at])
        together = [condition for conditions in found for condition in conditions]
        return self._closed(together, [variable for variable in self.bound if variable not in free])

    def condition(self, term: Term) -> Any:
        """One condition, which may be made of others."""
        inner = self.within()
        return self.target.manager.And(inner.conditions([term]))

    def fluent(self, term: Term) -> Any:
        """A fluent with its arguments.

        Raises:
            Unplanned: there is none of the name.
        """
        name, *arguments = predication(term)
        fluent = self.target.fluents.get(name)
        if fluent is None or fluent.arity != len(arguments):
            self._refuse(f"{shown(term)} is no fluent: state fluent({name}(Types…), boolean)")
        return self.target.manager.FluentExp(fluent, [self.value(argument) for argument in arguments])

    def value(self, term: Term) -> Any:
        """An object, a number, a parameter, or a sum of such."""
        if isinstance(term, Variable):
            if term not in self.known:
                self._refuse(f"nothing says what {term} is; give it a type")
            return self.known[term]
        number = number_of(term)
        if number is not None:
            return self._number(number)
        if isinstance(term, Compound) and term.arity == 2 and term.functor in _ARITHMETIC:
            return getattr(self.target.manager, _ARITHMETIC[term.functor])(*map(self.value, term.args))
        return self.target.thing(term, self.place)

    def _number(self, number: Fraction) -> Any:
        manager = self.target.manager
        return manager.Int(int(number)) if number.denominator == 1 else manager.Real(number)

    # --- conditions ------------------------------------------------------------------------------------------------

    def _condition(self, term: Term) -> list[Any]:
        if not isinstance(term, (str, Compound)):
            self._refuse(f"{shown(term)} is no condition")
        said = predication(term)
        case = _CASES.get(said.functor)
        return self._stated(said) if case is None else case(self, said)

    def _stated(self, said: Compound) -> list[Any]:
        """A type, or a fluent that nothing changes."""
        name, arguments = inward(said.functor), said.args
        if name in self.target.types and len(arguments) == 1:
            return self._typed(self.target.types[name], arguments[0])
        fluent = self.target.fluents.get(name)
        if fluent is None:
            self._refuse(f"{shown(said)} is about no type and no fluent of the problem")
        if fluent.arity == len(arguments):
            return [self.fluent(Compound((name, *arguments)))]
        if fluent.arity == len(arguments) - 1:
            return self._valued(Compound((name, *arguments[:-1])), arguments[-1])
        self._refuse(f"{shown(said)} has another number of arguments than the fluent {name}")

    def _typed(self, kind: Any, thing: Term) -> list[Any]:
        if not isinstance(thing, Variable) or thing in self.known:
            self._refuse(f"the type of {shown(thing)} cannot be asked in a problem; make it the type of the parameter")
        bound = Bound(parameter_name(thing.name), kind, self.target.problem.environment)
        self.bound.append(bound)
        self.known[thing] = self.target.manager.VariableExp(bound)
        return []

    def _valued(self, fluent: Term, value: Term) -> list[Any]:
        expression = self.fluent(fluent)
        if isinstance(value, Variable) and value not in self.known:
            if not value.is_anonymous:  # a fluent of a problem always has a value
                self.known[value] = expression
            return []
        return [self.target.manager.Equals(expression, self.value(value))]

    def _not(self, said: Compound) -> list[Any]:
        return [self.target.manager.Not(self.condition(said[1]))]

    def _either(self, said: Compound) -> list[Any]:
        return [self.target.manager.Or([self.condition(each) for each in _parts(said, ";")])]

    def _every(self, said: Compound) -> list[Any]:
        inner = self.within()
        for each in _parts(said[1], ","):
            if inner._condition(each):
                self._refuse(f"{shown(said)}: forall takes types, and then what holds")
        rows = [inner.condition(each) for each in _parts(said[2], ";")]
        return [self.target.manager.Forall(self.target.manager.Or(rows), *inner.bound)]

    def _compared(self, said: Compound) -> list[Any]:
        manager = self.target.manager
        one, other = map(self.value, said.args)
        table: dict[str, Callable[[], Any]] = {
            "=": lambda: manager.Equals(one, other),
            "=:=": lambda: manager.Equals(one, other),
            "\\=": lambda: manager.Not(manager.Equals(one, other)),
            "=\\=": lambda: manager.Not(manager.Equals(one, other)),
            "<": lambda: manager.LT(one, other),
            "=<": lambda: manager.LE(one, other),
            ">": lambda: manager.LT(other, one),
            ">=": lambda: manager.LE(other, one),
        }
        return [table[said.functor]()]

    def _holds(self, said: Compound) -> list[Any]:
        return [self.fluent(said[1])]

    def _asked(self, said: Compound) -> list[Any]:
        return self._valued(said[1], said[2])

    def _closed(self, conditions: list[Any], variables: list[Any]) -> list[Any]:
        """Conditions that share variables as one: there are such things."""
        groups: list[tuple[set[Any], list[Any]]] = []
        for condition in conditions:
            free = self.target.problem.environment.free_vars_oracle.get_free_variables(condition)
            own = {variable for variable in variables if variable in free}
            joined = [group for group in groups if group[0] & own]
            if not joined:
                groups.append((own, [condition]))
                continue
            for other in joined[1:]:
                joined[0][0].update(other[0])
                joined[0][1].extend(other[1])
                groups.remove(other)
            joined[0][0].update(own)
            joined[0][1].append(condition)
        idle = [variable for variable in variables if not any(variable in own for own, _ in groups)]
        found = [self._there_is([variable], [self.target.manager.TRUE()]) for variable in idle]
        for own, members in groups:
            found += [self._there_is([v for v in variables if v in own], members)] if own else members
        return found

    def _there_is(self, variables: list[Any], conditions: list[Any]) -> Any:
        return self.target.manager.Exists(self.target.manager.And(conditions), *variables)

    def _refuse(self, sentence: str) -> NoReturn:
        raise Unplanned(sentence, self.place)


def _parts(term: Term, joint: str) -> list[Term]:
    """What stands between the commas or semicolons of a term, however they are nested."""
    if not (isinstance(term, Compound) and term.functor == joint and term.arity > 1):
        return [term]
    return [part for each in term.args for part in _parts(each, joint)]


def _waits(term: Term) -> bool:
    """Whether a condition binds nothing: what it is about is said elsewhere, maybe behind it."""
    return isinstance(term, Compound) and term.functor in _BINDS_NOTHING


_COMPARISONS = ("=", "\\=", "=:=", "=\\=", "<", "=<", ">", ">=")
_BINDS_NOTHING = frozenset({";", "\\+", "forall", *_COMPARISONS})
_CASES: dict[str, _Case] = {
    "true": lambda scope, said: [],
    "moment": lambda scope, said: [],  # any
    "fail": lambda scope, said: [scope.target.manager.FALSE()],
    ";": Scope._either,
    "\\+": Scope._not,
    "forall": Scope._every,
    "holds": Scope._holds,
    "value": Scope._asked,
    **dict.fromkeys(_COMPARISONS, Scope._compared),
}
