"""Random programs: recursion of any shape, negation, comparisons, function symbols; all of it range-restricted."""

from __future__ import annotations

from hypothesis import strategies as st

CONSTANTS = ("a", "b", "1", "2", "f(a)", "f(f(b))", "g(a, 1)")
BASE = {"b0": 1, "b1": 2, "b2": 2}
DERIVED = {"d0": 1, "d1": 2, "d2": 1, "d3": 2, "d4": 1}  # in an order that negation may only follow downwards
_VARIABLES = ("X", "Y", "Z")


@st.composite
def programs(draw: st.DrawFn, negation: bool = True, circles: bool = False) -> str:
    """A program's text: recursion of any shape among what is not above, everything range-restricted.

    With ``circles`` negation may run in circles; without, all is stratified. Orders of what is no number are undefined.
    """
    lines = [f":- dynamic({name}/{arity})." for name, arity in {**BASE, **DERIVED}.items()]
    for name, arity in BASE.items():
        rows = draw(st.lists(st.tuples(*[st.sampled_from(CONSTANTS)] * arity), max_size=4))
        lines += [f"{name}({', '.join(row)})." for row in rows]
    strata = dict(zip(DERIVED, sorted(draw(st.lists(st.integers(1, 3), min_size=len(DERIVED), max_size=len(DERIVED))))))
    for name in DERIVED:
        for _ in range(draw(st.integers(0, 2))):
            lines.append(draw(_rules(name, strata, negation, circles)))
    return "\n".join(lines)


@st.composite
def _rules(draw: st.DrawFn, name: str, strata: dict[str, int], negation: bool, circles: bool) -> str:
    reachable = [*BASE, *(other for other in DERIVED if strata[other] <= strata[name])]
    below = list(DERIVED) if circles else [*BASE, *(other for other in DERIVED if strata[other] < strata[name])]
    patterns = st.one_of(st.sampled_from(_VARIABLES), st.sampled_from([*CONSTANTS, "f(X)", "g(Y, Z)", "_"]))
    body = [_atom(draw, draw(st.sampled_from(reachable)), patterns) for _ in range(draw(st.integers(1, 3)))]
    known = [v for v in _VARIABLES if any(v in condition for condition in body)]
    values = st.sampled_from([*known, *CONSTANTS])
    if draw(st.booleans()):
        operator = draw(st.sampled_from(["\\=", "=", "<", ">=", "==", "\\==", "=:="]))
        if operator in ("<", ">=", "=:="):
            values = st.sampled_from([*known, "1", "2"])
        body.append(f"{draw(values)} {operator} {draw(values)}")
    values = st.sampled_from([*known, *CONSTANTS])
    if draw(st.booleans()):
        body.append(f"W = {draw(values)}")
        known.append("W")
    if negation and draw(st.booleans()):
        tested = st.one_of(st.sampled_from([*known, *CONSTANTS, "_"]), st.just("f(_)"))
        body.append("\\+ " + _atom(draw, draw(st.sampled_from(below)), tested))
    body = draw(st.permutations(body))
    return f"{_atom(draw, name, st.sampled_from([*known, *CONSTANTS]))} :- {', '.join(body)}."


def _atom(draw: st.DrawFn, name: str, terms: st.SearchStrategy[str]) -> str:
    arity = {**BASE, **DERIVED}[name]
    return f"{name}({', '.join(draw(terms) for _ in range(arity))})"
