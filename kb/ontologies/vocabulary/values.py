"""Data values as terms: numbers and strings are themselves, all others say their datatype, ``date("2026-01-01")``."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import UTC, datetime
from decimal import Decimal, InvalidOperation

from casper.kb.ontologies.citing import cited, local_name
from casper.kb.ontologies.expressions import RDF, RDFS, XSD, Value
from casper.kb.ontologies.vocabulary.names import readable_name
from casper.kb.ontologies.vocabulary.refusals import Beyond
from casper.kb.terms.terms import Compound, Term

INTEGERS: Mapping[str, tuple[int | None, int | None]] = {  # with the least and the greatest value
    "integer": (None, None),
    "nonNegativeInteger": (0, None),
    "nonPositiveInteger": (None, 0),
    "positiveInteger": (1, None),
    "negativeInteger": (None, -1),
    "long": (-(2**63), 2**63 - 1),
    "int": (-(2**31), 2**31 - 1),
    "short": (-(2**15), 2**15 - 1),
    "byte": (-128, 127),
    "unsignedLong": (0, 2**64 - 1),
    "unsignedInt": (0, 2**32 - 1),
    "unsignedShort": (0, 2**16 - 1),
    "unsignedByte": (0, 255),
}
FRACTIONS = ("decimal", "double", "float")
STRINGS = ("string", "normalizedString", "token")
_TRUE, _FALSE = ("true", "1"), ("false", "0")


def is_number(datatype: str) -> bool:
    """Whether values of the datatype are numbers here."""
    return datatype.startswith(XSD) and datatype.removeprefix(XSD) in (*INTEGERS, *FRACTIONS)


def is_string(datatype: str) -> bool:
    """Whether values of the datatype are plain strings here."""
    return datatype in (f"{XSD}{name}" for name in STRINGS) or datatype == f"{RDF}PlainLiteral"


def term_of(value: Value, names: Mapping[str, str]) -> Term:
    """The value as a term; equal values are equal terms for numbers, strings, booleans and times.

    Raises:
        Beyond: the spelling is none of the datatype's, or the number cannot be kept.
    """
    if value.datatype == f"{RDF}langString":
        return Compound(("text", value.lexical, value.language))
    if is_number(value.datatype):
        return _number(value)
    if is_string(value.datatype):
        return value.lexical
    local = local_name(value.datatype)
    if value.datatype == f"{XSD}boolean":
        return Compound(("boolean", _boolean(value)))
    lexical = _time(value) if value.datatype in (f"{XSD}dateTime", f"{XSD}dateTimeStamp") else value.lexical
    if value.datatype.startswith((XSD, RDF, RDFS)):
        return Compound((readable_name(local), lexical))
    return Compound((names.get(value.datatype, readable_name(value.datatype)), lexical))


def _number(value: Value) -> int | float:
    kind, spelt = value.datatype.removeprefix(XSD), value.lexical.strip()
    if kind in INTEGERS:
        digits = spelt.lstrip("+-")
        if not (digits.isascii() and digits.isdigit() and len(spelt) - len(digits) <= 1):
            raise _misspelt(value)
        if len(digits) > 1000:
            raise Beyond("the number is too large to be kept")
        number = int(spelt)
        low, high = INTEGERS[kind]
        if (low is not None and number < low) or (high is not None and number > high):
            raise _misspelt(value)
        return number
    return _fraction(value, spelt)


def _fraction(value: Value, spelt: str) -> float:
    try:
        exact = Decimal(spelt if spelt.isascii() and "_" not in spelt else "")  # Python spells more than XML
    except InvalidOperation:
        raise _misspelt(value) from None
    if not exact.is_finite():
        raise Beyond("INF and NaN are no numbers of the language; give a number, or leave the value out")
    number = float(exact)
    if number in (float("inf"), float("-inf")):
        raise Beyond("the number is too large to be kept")
    if value.datatype == f"{XSD}decimal" and Decimal(repr(number)) != exact:
        raise Beyond("the decimal has more digits than can be kept; round it, or write it as a string")
    return number


def _boolean(value: Value) -> str:
    spelt = value.lexical.strip()
    if spelt not in (*_TRUE, *_FALSE):
        raise _misspelt(value)
    return "true" if spelt in _TRUE else "false"


def _time(value: Value) -> str:
    """A point in time as one spelling: with a time zone, in UTC."""
    try:
        moment = datetime.fromisoformat(value.lexical.strip())
    except ValueError:
        raise _misspelt(value) from None
    return (moment if moment.tzinfo is None else moment.astimezone(UTC)).isoformat()


def _misspelt(value: Value) -> Beyond:
    return Beyond(f"{cited(value)} is no {local_name(value.datatype)}; mend the value")
