"""Settings of one stage, read from a domain's facts ``setting(Section, Name, Value)`` into its dataclass."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterable
from difflib import get_close_matches
from numbers import Integral
from typing import Any, TypeVar

from casper.kb.errors import DomainError
from casper.kb.terms.numbers import as_float

Rows = Callable[[str, int], Iterable[tuple[Any, ...]]]
"""``rows(name, arity)`` yields the tuples of constants of one predicate; an undefined one yields nothing."""

S = TypeVar("S")


def read_settings(kind: type[S], rows: Rows, section: str, **given: Any) -> S:
    """The settings dataclass ``kind`` with what the facts of one section say, and its defaults elsewhere.

    ``given`` are fields that come from other facts; they cannot be set by ``setting/3``.

    Raises:
        DomainError: an unknown name, a value of the wrong kind, or one name with two values.
    """
    defaults = {f.name: f.default for f in dataclasses.fields(kind) if f.name not in given}  # type: ignore[arg-type]
    found: dict[str, Any] = {}
    for of, name, value in rows("setting", 3):
        if of != section:
            continue
        if name not in defaults:
            known = ", ".join(sorted(defaults))
            close = get_close_matches(str(name), defaults, n=1)
            hint = f"; did you mean {close[0]}?" if close else ""
            raise DomainError(f"setting({section}, {name}, …) is unknown; {section} has {known}{hint}")
        read = _value(defaults[name], value, f"setting({section}, {name}, {value})")
        if found.setdefault(name, read) != read:
            raise DomainError(f"setting({section}, {name}, …) has two values, {found[name]} and {read}")
    return kind(**given, **found)


def number(value: Any, where: str) -> float:
    """A number of a fact; the atoms ``infinite`` and ``inf`` stand for infinity.

    Raises:
        DomainError: anything else; the sentence quotes ``where``.
    """
    if value in ("infinite", "inf"):
        return math.inf
    read = as_float(value)
    if math.isnan(read):
        raise DomainError(f"{where:.200}: {value!r:.40} should be a number")
    return read


def require(holds: bool, sentence: str) -> None:
    """Raise DomainError with this sentence unless ``holds``."""
    if not holds:
        raise DomainError(sentence)


def check_seed(seed: Any) -> None:
    """Refuse a seed that no generator of random numbers takes.

    Raises:
        DomainError: it is no whole number from 0.
    """
    require(isinstance(seed, Integral) and int(seed) >= 0, f"a seed is a whole number from 0, not {seed}")


def _value(default: Any, value: Any, where: str) -> Any:
    if isinstance(default, bool):
        truths = {True: True, False: False, "true": True, "false": False}
        require(isinstance(value, (bool, str)) and value in truths, f"{where} should be true or false")
        return truths[value]
    if isinstance(default, int):
        require(isinstance(value, int) and not isinstance(value, bool), f"{where} should be a whole number")
        return value
    if isinstance(default, float):
        return number(value, where)
    require(isinstance(value, str), f"{where} should be a name")
    return value
