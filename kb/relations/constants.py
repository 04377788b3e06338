"""What the numbers of an interner stand for, as arrays: for arithmetic, comparisons and answers on whole columns."""

from __future__ import annotations

import math
from collections.abc import Sequence
from threading import Lock
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from casper.kb.relations.columns import Ids, Interner
from casper.kb.terms.terms import Term

Numbers: TypeAlias = NDArray[np.int64] | NDArray[np.float64]
OTHER, STRANGE, LONG, WHOLE, REAL = range(5)  # no number; none for arrays; an integer above 2**53; any other; a float
EXACT = 1 << 53  # whole numbers up to which a float has the very value


class Constants:
    """The constants of an interner, which may grow meanwhile."""

    def __init__(self, interner: Interner) -> None:
        self.interner = interner
        self._kinds, self._whole = np.empty(0, np.int8), np.empty(0, np.int64)
        self._real, self._terms = np.empty(0, np.float64), np.empty(0, object)
        self._lock = Lock()

    def kinds(self, column: Ids) -> NDArray[np.int8]:
        """Of which kind each value of a column is."""
        self._grow()
        found: NDArray[np.int8] = self._kinds[column]
        return found

    def terms(self, column: Ids) -> NDArray[Any]:
        """The values of a column, as Python objects."""
        self._grow()
        found: NDArray[Any] = self._terms[column]
        return found

    def typed(self, column: Ids) -> NDArray[Any]:
        """The values of a column, in the narrowest type that keeps every one of them."""
        kinds = self.kinds(column)
        if not len(kinds) or kinds.min() == OTHER:
            return self.terms(column)
        found = self.numbers(column)
        return typed(self.terms(column).tolist()) if found is None else found

    def numbers(self, column: Ids) -> Numbers | None:
        """The values of a column, when all are whole numbers, or all are numbers none of which is above 2**53."""
        kinds = self.kinds(column)
        least, most = (int(kinds.min()), int(kinds.max())) if len(kinds) else (WHOLE, WHOLE)
        if least <= STRANGE or (least == LONG and most == REAL):
            return None
        return self._real[column] if most == REAL else self._whole[column]

    def _grow(self) -> None:
        """Take in the constants that came since."""
        if len(self._terms) == len(self.interner):
            return
        with self._lock:
            new = self.interner.constants[len(self._terms) :]
            kinds = np.fromiter(map(kind_of, new), np.int8, len(new))
            numeric = [value if kind > STRANGE else 0 for value, kind in zip(new, kinds.tolist())]
            whole = [0 if kind == REAL else value for value, kind in zip(numeric, kinds.tolist())]
            self._whole = np.concatenate((self._whole, np.array(whole, np.int64)))
            self._real = np.concatenate((self._real, np.array(numeric, np.float64)))
            self._kinds = np.concatenate((self._kinds, kinds))
            self._terms = np.concatenate((self._terms, np.fromiter(new, object, len(new))))


def kind_of(value: Term) -> int:
    """Of which kind a constant is."""
    if type(value) is int:
        return WHOLE if -EXACT <= value <= EXACT else LONG if -(1 << 63) <= value < 1 << 63 else STRANGE
    return OTHER if type(value) is not float else REAL if math.isfinite(value) else STRANGE


def typed(values: Sequence[Term]) -> NDArray[Any]:
    """An array of the values with the narrowest type that keeps every one of them."""
    kinds = set(map(type, values))
    whole = [value for value in values if type(value) is int] if kinds <= {int, float} else []
    if kinds == {int} and all(-(1 << 63) <= value < 1 << 63 for value in whole):
        return np.array(values, np.int64)
    if kinds in ({float}, {int, float}) and all(abs(value) <= EXACT for value in whole):
        return np.array(values, np.float64)
    return np.fromiter(values, dtype=object, count=len(values))
