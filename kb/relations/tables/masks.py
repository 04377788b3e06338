"""Comparisons and arithmetic on whole columns: a mask of the partial solutions that pass, or a column of values.

Exactly what `kb.terms.comparison` says of each row, or `NotOnColumns`: whole numbers stay below 2**53, where a float
has their very value, and whatever has no value on some row (a division by zero, an atom in a sum) is left to rows,
which tell it from a *no*.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from casper.kb.errors import NotOnColumns
from casper.kb.relations.coded import number_of
from casper.kb.relations.columns import Ids
from casper.kb.relations.constants import EXACT, Constants, Numbers
from casper.kb.terms.clauses import Literal
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, Variable
from casper.kb.terms.unification import is_ground, variables_of

Mask: TypeAlias = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Values:
    """A column of computed numbers, which have no number in the interner."""

    array: Numbers


Column: TypeAlias = Ids | Values
Frame: TypeAlias = dict[Variable, Column]  # the values of each variable in all partial solutions, in parallel

_ORDER: dict[str, Callable[[Any, Any], Any]] = {
    "<": operator.lt,
    ">": operator.gt,
    "=<": operator.le,
    ">=": operator.ge,
    "=:=": operator.eq,
    "=\\=": operator.ne,
}
_EQUAL = {"=": True, "==": True, "\\=": False, "\\==": False}
_RING: dict[str, Callable[[Any, Any], Any]] = {"+": np.add, "-": np.subtract, "*": np.multiply}
_WHOLE: dict[str, Callable[[Any, Any], Any]] = {
    "//": lambda a, b: np.sign(a) * np.sign(b) * (abs(a) // abs(b)),  # towards zero
    "div": np.floor_divide,
    "mod": np.mod,
}
_CHOICE: dict[str, Callable[[Any, Any], Any]] = {"min": np.minimum, "max": np.maximum}
_PAIRS = {*_RING, *_WHOLE, *_CHOICE, "/"}
_SINGLE: dict[str, Callable[[Any], Any]] = {"-": np.negative, "+": np.positive, "abs": np.abs}


def check_condition(literal: Literal, known: set[Variable]) -> None:
    """Whether a comparison can be worked out on columns, once some variables are known.

    Raises:
        NotOnColumns: it cannot.
    """
    operator_, left, right = literal.atom
    sides = (right,) if operator_ == "is" else (left, right)
    if operator_ in _EQUAL:
        if not all(isinstance(side, Variable) or is_ground(side) for side in sides):
            raise NotOnColumns(f"{literal} looks into terms")
        if _EQUAL[operator_] and not literal.negated and operator_ == "=":
            sides = tuple(side for side in sides if not isinstance(side, Variable) or side in known) or sides
    else:
        for side in sides:
            _check_expression(side)
    if operator_ == "is" and isinstance(left, Compound):
        raise NotOnColumns(f"{literal} looks into terms")
    needed = sides if operator_ != "is" or not literal.negated else (left, right)
    if not known.issuperset(variables_of(*needed)):
        raise NotOnColumns(f"{literal} has a variable that nothing binds")


def _check_expression(term: Term) -> None:
    plain = isinstance(term, Variable) or type(term) in (int, float)
    if plain and (not isinstance(term, (int, float)) or abs(term) <= EXACT):
        return
    if isinstance(term, Compound) and term.functor in {1: _SINGLE.keys(), 2: _PAIRS}.get(term.arity, ()):
        for arg in term.args:
            _check_expression(arg)
        return
    raise NotOnColumns(f"{term_text(term)} is worked out row by row")


def compared(literal: Literal, frame: Frame, size: int, constants: Constants) -> tuple[Frame, Mask | None]:
    """A comparison: the frame, with a column more where it binds a variable, and which of its solutions pass.

    Raises:
        NotOnColumns: the values are not those that columns can compare.
    """
    operator_, left, right = literal.atom
    if operator_ in _ORDER:
        one, other = (_value(side, frame, constants) for side in (left, right))
        mask = _ORDER[operator_](one, other)
        return frame, np.broadcast_to(np.logical_xor(mask, literal.negated), size)
    wanted = _EQUAL.get(operator_, True) != literal.negated
    if operator_ == "is":
        value = np.broadcast_to(_value(right, frame, constants), size)
        if isinstance(left, Variable) and left not in frame and wanted:
            return {**frame, left: Values(value)}, None
        return frame, _equal(_side(left, frame, size, constants), Values(value), constants) == wanted
    for one, other in ((left, right), (right, left)):
        if isinstance(one, Variable) and one not in frame and wanted:
            return {**frame, one: _side(other, frame, size, constants)}, None
    one, other = (_side(side, frame, size, constants) for side in (left, right))
    return frame, _equal(one, other, constants) == wanted


def _side(side: Term, frame: Frame, size: int, constants: Constants) -> Column:
    return frame[side] if isinstance(side, Variable) else np.full(size, number_of(side, constants), np.int64)


def _equal(one: Column, other: Column, constants: Constants) -> Mask:
    same: Mask = codes(one, constants) == codes(other, constants)
    return same


def codes(column: Column, constants: Constants) -> Ids:
    """A column as numbers of constants; computed values become such."""
    if not isinstance(column, Values):
        return column
    distinct, places = np.unique(column.array, return_inverse=True)
    numbers = [number_of(value, constants) for value in distinct.tolist()]
    return np.array(numbers, np.int64)[places.reshape(-1)] if numbers else np.empty(0, np.int64)


def numbers(column: Column, constants: Constants) -> Numbers:
    """A column as numbers.

    Raises:
        NotOnColumns: some are none, or of too many digits.
    """
    found = column.array if isinstance(column, Values) else constants.numbers(column)
    if found is None or (found.dtype == np.int64 and len(found) and _most(found) > EXACT):
        raise NotOnColumns("not all values are numbers below 2**53")
    return found


def _value(term: Term, frame: Mapping[Variable, Column], constants: Constants) -> Any:
    """The value of an expression: an array, or a scalar of numpy."""
    if isinstance(term, Variable):
        return numbers(frame[term], constants)
    if not isinstance(term, Compound):
        return np.int64(term) if isinstance(term, int) else np.float64(term)
    values = [_value(arg, frame, constants) for arg in term.args]
    with np.errstate(all="ignore"):  # what is not finite is refused
        return _SINGLE[term.functor](*values) if len(values) == 1 else _applied(term.functor, *values)


def _applied(name: str, one: Any, other: Any) -> Any:
    are_whole = one.dtype == np.int64, other.dtype == np.int64
    if name in _RING:
        most = (_most(one) * _most(other)) if name == "*" else _most(one) + _most(other)
        if all(are_whole) and most > EXACT:
            raise NotOnColumns("the values grow above 2**53")
        return _finite(_RING[name](one, other))
    if name in _CHOICE and len(set(are_whole)) == 1:
        return _CHOICE[name](one, other)
    if name == "/" and not any(are_whole) and np.all(other):
        return _finite(one / other)
    if name in _WHOLE and all(are_whole) and np.all(other):
        return _WHOLE[name](one, other)
    raise NotOnColumns(f"{name} of these values is worked out row by row")


def _most(values: Any) -> int:
    """The greatest absolute value of whole numbers; 0 for floats."""
    if values.dtype != np.int64 or not values.size:
        return 0
    return max(abs(int(values.min())), abs(int(values.max())))


def _finite(values: Any) -> Any:
    if values.dtype != np.int64 and not np.isfinite(values).all():
        raise NotOnColumns("a value is too large for a float")
    return values
