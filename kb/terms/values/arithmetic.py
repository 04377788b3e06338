"""Arithmetic as in ISO and SWI-Prolog: exact integers of any size, floats, and a sentence where there is no value.

Integers divide exactly where they can (``4 / 2`` is 2, ``1 / 2`` is 0.5); ``//`` cuts towards zero, ``div`` downwards;
``mod`` has the divisor's sign, ``rem`` the dividend's. A result of more than ``MOST_BITS`` bits is no value.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, TypeAlias

from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import NIL, Compound, Term, Variable
from casper.kb.terms.unification import substitute, variables_of
from casper.kb.terms.values.effort import charge_integer
from casper.kb.terms.values.failure import EvaluationFailed as EvaluationFailed
from casper.kb.terms.values.moments import Moment

Number: TypeAlias = int | float
MOST_BITS = 1 << 20  # of an integer; a power or a shift would otherwise fill the memory in one step


class _NoValue(Exception):
    """Why the outermost operation of an expression has no value."""


_SMALL = 1 << 62  # results below it need no look at their size
_PLAIN: dict[str, Callable[[int, int], int]] = {"+": operator.add, "-": operator.sub, "*": operator.mul}
CONSTANTS: dict[str, float] = {"pi": math.pi, "e": math.e, "inf": math.inf, "epsilon": 2.0**-52}


def evaluate(term: Term) -> Number:
    """The value of a ground arithmetic term; a time of which only the order is known is its own.

    Raises:
        EvaluationFailed: not a number, a division by zero, outside a function's domain, or too large.
    """
    if type(term) is int or type(term) is float:
        return term
    if isinstance(term, Compound) and term.indicator in FUNCTIONS:
        values = [evaluate(arg) for arg in term.args]
        try:
            return _bounded(FUNCTIONS[term.indicator](*values))
        except TypeError:
            unknown = next((value for value in values if isinstance(value, Moment)), None)
            if unknown is None:
                raise
            shown = term_text(Compound((term[0], *values)))
            because = f"{unknown} is known by its order only, not in seconds"
            raise EvaluationFailed(f"{shown} has no value: {because}") from None
        except (_NoValue, OverflowError, ValueError, ZeroDivisionError) as mistake:
            shown = term_text(Compound((term[0], *values)))
            raise EvaluationFailed(f"{shown} has no value: {_reason(mistake)}") from None
    if isinstance(term, Compound) and term.indicator == (".", 2) and term[2] == NIL:
        return evaluate(term[1])  # [X] is X
    if isinstance(term, str) and term in CONSTANTS:
        return CONSTANTS[term]
    if isinstance(term, (int, float)) and not isinstance(term, bool):
        return term
    if isinstance(term, Moment):
        return term  # type: ignore[return-value]
    raise EvaluationFailed(f"{term_text(term)} is not a number")


def compiled(term: Term, slots: Mapping[Variable, int]) -> Callable[[Sequence[Term]], Number]:
    """`evaluate` for a term whose variables have their values in an environment; raises as it does."""
    if isinstance(term, Variable):
        slot = slots[term]

        def look_up(environment: Sequence[Term]) -> Number:
            value = environment[slot]
            return value if type(value) is int or type(value) is float else evaluate(value)

        return look_up
    if isinstance(term, Compound) and term.arity == 2 and term.indicator in FUNCTIONS:
        return _compiled_pair(term[0], compiled(term[1], slots), compiled(term[2], slots))
    names = list(variables_of(term))
    return lambda environment: evaluate(substitute(term, {v: environment[slots[v]] for v in names}))


def _compiled_pair(
    name: str, left: Callable[[Sequence[Term]], Number], right: Callable[[Sequence[Term]], Number]
) -> Callable[[Sequence[Term]], Number]:
    plain = _PLAIN.get(name)

    def apply(environment: Sequence[Term]) -> Number:
        one, other = left(environment), right(environment)
        if plain is not None and type(one) is int and type(other) is int:
            result = plain(one, other)
            if -_SMALL < result < _SMALL:
                return result
        return evaluate(Compound((name, one, other)))

    return apply


def unknown_functions(term: Term) -> Iterator[str]:
    """Names of the functions and constants of an expression that nothing computes, with their arity: ``foo/1``."""
    waiting = [term]
    while waiting:
        part = waiting.pop()
        if isinstance(part, Compound):
            if part.indicator in FUNCTIONS:
                waiting.extend(reversed(part.args))
            elif part.indicator == (".", 2) and part[2] == NIL:
                waiting.append(part[1])
            else:
                yield f"{part.functor}/{part.arity}"
        elif not isinstance(part, (Variable, int, float)) and part not in CONSTANTS:
            yield f"{term_text(part)}/0"


def _reason(mistake: Exception) -> str:
    if isinstance(mistake, ZeroDivisionError):
        return "division by zero"
    if isinstance(mistake, OverflowError):
        return "the result is too large for a float"
    return str(mistake) if isinstance(mistake, _NoValue) else "it is undefined there"


def _bounded(value: Any) -> Number:
    if isinstance(value, int):
        if value.bit_length() > MOST_BITS:
            raise _NoValue(f"the result has more than {MOST_BITS} bits")
        if not -_SMALL < value < _SMALL:
            charge_integer(value.bit_length())
        return value
    if value != value:
        raise _NoValue("it is undefined there")
    return float(value)


def _finite(function: Callable[..., float]) -> Callable[..., Number]:
    """A function on floats whose result is infinite only for infinite arguments."""

    def checked(*values: Number) -> Number:
        result = function(*values)
        if isinstance(result, float) and math.isinf(result) and not any(map(_is_infinite, values)):
            raise OverflowError
        return result

    return checked


def _is_infinite(value: Number) -> bool:
    return isinstance(value, float) and math.isinf(value)


def _on_integers(function: Callable[..., int]) -> Callable[..., Number]:
    """A function that only integers have."""

    def checked(*values: Number) -> Number:
        for value in values:
            if not isinstance(value, int):
                raise _NoValue(f"{value} is not an integer")
        return function(*values)

    return checked


def _divide(left: Number, right: Number) -> Number:
    if isinstance(left, int) and isinstance(right, int) and right != 0 and left % right == 0:
        return left // right
    return left / right


def _cut(left: int, right: int) -> int:
    quotient = abs(left) // abs(right)
    return quotient if (left < 0) == (right < 0) else -quotient


def _remainder(left: int, right: int) -> int:
    return left - right * _cut(left, right)


def _power(base: Number, exponent: Number) -> Number:
    if isinstance(base, int) and isinstance(exponent, int):
        return _integer_power(base, exponent)
    if base == 0 and exponent < 0:
        raise ZeroDivisionError
    if exponent == 0 or (isinstance(base, int) and base in (0, 1)):
        return 1 if exponent == 0 else base  # the integer, as in SWI-Prolog
    return _finite(math.pow)(base, exponent)


def _integer_power(base: int, exponent: int) -> Number:
    if exponent < 0:
        return (base if exponent % 2 else 1) if abs(base) == 1 else float(base) ** exponent
    if abs(base) > 1 and (base.bit_length() - 1) * exponent > MOST_BITS:
        raise _NoValue(f"the result has more than {MOST_BITS} bits")
    result: int = base**exponent
    return result


def _shift_left(value: int, by: int) -> int:
    if by < 0:
        return value >> -by
    if value and value.bit_length() + by > MOST_BITS:
        raise _NoValue(f"the result has more than {MOST_BITS} bits")
    return value << by if value else 0


def _shift_right(value: int, by: int) -> int:
    return value >> by if by >= 0 else _shift_left(value, -by)


def _rounded(how: Callable[[float], int]) -> Callable[[Number], Number]:
    """A way to an integer; an infinite value stays as it is."""

    def to_integer(value: Number) -> Number:
        return value if isinstance(value, int) or math.isinf(value) else how(value)

    return to_integer


def _nearest(value: float) -> int:
    whole = math.trunc(value)  # value + 0.5 may round up on its own
    return whole + (0 if abs(value - whole) < 0.5 else 1 if value > 0 else -1)


def _least(left: Number, right: Number) -> Number:
    return _float_of(left, right) if left == right else min(left, right)


def _greatest(left: Number, right: Number) -> Number:
    return _float_of(left, right) if left == right else max(left, right)


def _float_of(left: Number, right: Number) -> Number:
    """Of two equal numbers the float, if one is."""
    return left if isinstance(left, float) else right


def _sign(value: Number) -> Number:
    if isinstance(value, float):
        return math.copysign(1.0, value) if value else value
    return (value > 0) - (value < 0)


def _msb(value: int) -> int:
    if value < 1:
        raise _NoValue(f"{value} is not positive")
    return value.bit_length() - 1


def _log(value: Number) -> float:
    if value == 0:
        raise _NoValue("the logarithm of zero is infinite")
    return math.log(value)


def _float_part(value: Number) -> Number:
    return value - math.trunc(value)


def _whole_part(value: Number) -> Number:
    return value if isinstance(value, int) else float(math.trunc(value))


FUNCTIONS: dict[tuple[str, int], Callable[..., Any]] = {
    ("+", 2): _finite(operator.add),
    ("-", 2): _finite(operator.sub),
    ("*", 2): _finite(operator.mul),
    ("/", 2): _finite(_divide),
    ("//", 2): _on_integers(_cut),
    ("div", 2): _on_integers(operator.floordiv),
    ("mod", 2): _on_integers(operator.mod),
    ("rem", 2): _on_integers(_remainder),
    ("**", 2): _power,
    ("^", 2): _power,
    ("min", 2): _least,
    ("max", 2): _greatest,
    ("gcd", 2): _on_integers(math.gcd),
    ("atan2", 2): math.atan2,
    ("atan", 2): math.atan2,
    (">>", 2): _on_integers(_shift_right),
    ("<<", 2): _on_integers(_shift_left),
    ("/\\", 2): _on_integers(operator.and_),
    ("\\/", 2): _on_integers(operator.or_),
    ("xor", 2): _on_integers(operator.xor),
    ("\\", 1): _on_integers(operator.invert),
    ("msb", 1): _on_integers(_msb),
    ("-", 1): operator.neg,
    ("+", 1): operator.pos,
    ("abs", 1): abs,
    ("sign", 1): _sign,
    ("log", 1): _log,
    ("floor", 1): _rounded(math.floor),
    ("ceiling", 1): _rounded(math.ceil),
    ("round", 1): _rounded(_nearest),
    ("integer", 1): _rounded(_nearest),
    ("truncate", 1): _rounded(math.trunc),
    ("float", 1): float,
    ("float_integer_part", 1): _whole_part,
    ("float_fractional_part", 1): _float_part,
}
for _name in ("sqrt", "exp", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "asinh", "acosh"):
    FUNCTIONS[_name, 1] = getattr(math, _name)
FUNCTIONS["atanh", 1] = math.atanh
