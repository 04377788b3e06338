"""Facts as RDF: rows of one argument are types, rows of two are triples, others are nodes with numbered members.

    >>> print(triples_text([("dog", ("rex",))], {"dog": "http://z.org/Dog"}), end="")
    <urn:casper:rex> <http://www.w3.org/1999/02/22-rdf-syntax-ns#type> <http://z.org/Dog> .
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from urllib.parse import quote

from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term

_RDF = "http://www.w3.org/1999/02/22-rdf-syntax-ns#"
_XSD = "http://www.w3.org/2001/XMLSchema#"
_OURS = "urn:casper:"
STANDARD_DATATYPES = {  # the compound terms that spell values of XML Schema
    name: _XSD + datatype
    for name, datatype in {
        "boolean": "boolean", "date": "date", "date_time": "dateTime", "date_time_stamp": "dateTimeStamp",
        "time": "time", "duration": "duration", "any_uri": "anyURI", "g_year": "gYear", "g_month": "gMonth",
        "g_day": "gDay", "g_year_month": "gYearMonth", "g_month_day": "gMonthDay", "hex_binary": "hexBinary",
        "base64_binary": "base64Binary", "language": "language", "name": "Name", "ncname": "NCName",
        "nmtoken": "NMTOKEN",
    }.items()
}  # fmt: skip
_ESCAPED = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\r": "\\r", "\t": "\\t"}


def triples_text(
    rows: Iterable[tuple[str, Sequence[Term]]],
    iris: Mapping[str, str],
    data: Collection[str] = (),
    datatypes: Mapping[str, str] | None = None,
) -> str:
    """Rows as N-Triples, one a line (which is Turtle, too).

    Args:
        rows: predicates with their arguments, all ground.
        iris: the IRI of each name; what has none is under ``urn:casper:``.
        data: predicates whose second argument is a value.
        datatypes: of the numbers of a predicate, where it is neither integer nor decimal.
    """
    writer = _Writer(iris, datatypes or {})
    return "".join(writer.row(number, name, args, name in data) for number, (name, args) in enumerate(rows, 1))


class _Writer:
    def __init__(self, iris: Mapping[str, str], datatypes: Mapping[str, str]) -> None:
        self._iris, self._datatypes = iris, datatypes

    def row(self, number: int, name: str, args: Sequence[Term], is_data: bool) -> str:
        if len(args) == 1:
            return f"{self._node(args[0])} <{_RDF}type> {self._iri(name)} .\n"
        if len(args) == 2 and self._is_subject(args[0]):
            value = self._value(args[1], name) if is_data else self._node(args[1])
            return f"{self._node(args[0])} {self._iri(name)} {value} .\n"
        node = f"_:row_{number}"
        members = (f"{node} <{_RDF}_{at}> {self._node(arg)} .\n" for at, arg in enumerate(args, 1))
        return f"{node} <{_RDF}type> <{_OURS}{quote(name, safe='')}/{len(args)}> .\n" + "".join(members)

    def _is_subject(self, term: Term) -> bool:
        return isinstance(term, str)

    def _iri(self, name: str) -> str:
        if re.fullmatch(r"_:[A-Za-z0-9]+", name):
            return name
        return f"<{self._iris.get(name) or _OURS + quote(name, safe='')}>"

    def _node(self, term: Term) -> str:
        return self._iri(term) if isinstance(term, str) else self._value(term, "")

    def _value(self, term: Term, of: str) -> str:
        if isinstance(term, str):
            return _literal(term)
        if isinstance(term, (int, float)):
            datatype = self._datatypes.get(of, f"{_XSD}{'integer' if isinstance(term, int) else 'decimal'}")
            return _literal(_number(term, datatype), datatype)
        if isinstance(term, Compound) and term.indicator == ("text", 2):
            return f"{_literal(str(term[1]))}@{term[2]}"
        if isinstance(term, Compound) and term.arity == 1 and isinstance(term[1], str):
            datatype = STANDARD_DATATYPES.get(term.functor) or self._iris.get(term.functor, "")
            if datatype:
                return _literal(term[1], datatype)
        return _literal(term_text(term), f"{_OURS}term")


def _number(term: int | float, datatype: str) -> str:
    if datatype == f"{_XSD}decimal" and isinstance(term, float):
        from decimal import Decimal

        return format(Decimal(repr(term)), "f")
    return str(int(term)) if isinstance(term, float) and term.is_integer() and "nteger" in datatype else str(term)


def _literal(text: str, datatype: str = "") -> str:
    inner = "".join(_ESCAPED.get(c, c) for c in text)
    return f'"{inner}"' + (f"^^<{datatype}>" if datatype and datatype != f"{_XSD}string" else "")
