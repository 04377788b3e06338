"""Random programs whose facts come and go, and what they mean then."""

from __future__ import annotations

from hypothesis import strategies as st
from programs import BASE, DERIVED, atoms_of, undefined_of

from casper.kb.base import KnowledgeBase

VALUES = ("a", "b", 1, 2)


@st.composite
def plain_programs(draw, circles: bool = False) -> str:
    """Rules of variables and constants only: recursion, strata (or circles) of negation, (dis)equality."""
    lines = [f":- dynamic({name}/{arity})." for name, arity in {**BASE, **DERIVED}.items()]
    for name, arity in BASE.items():
        rows = draw(st.lists(st.tuples(*[st.sampled_from(VALUES)] * arity), max_size=6))
        lines += [f"{name}({', '.join(map(str, row))})." for row in rows]
    order = [*BASE, *DERIVED]
    for name in DERIVED:
        for _ in range(draw(st.integers(0, 2))):
            usable = order[: order.index(name) + 1]
            below = list(DERIVED) if circles else order[: order.index(name)]
            terms = st.sampled_from(["X", "Y", "Z", "X", "Y", "a", "1"])
            body = [atom(draw, draw(st.sampled_from(usable)), terms) for _ in range(draw(st.integers(1, 3)))]
            known = [v for v in "XYZ" if any(v in part for part in body)] or ["a"]
            values = st.sampled_from([*known, "b"])
            if draw(st.booleans()):
                operator = draw(st.sampled_from(["=", "\\="]))
                body.append(f"{draw(values)} {operator} {draw(values)}")
            if draw(st.booleans()):
                tested = st.sampled_from([*known, "a", "_"])
                body.append("\\+ " + atom(draw, draw(st.sampled_from(below)), tested))
            lines.append(f"{atom(draw, name, st.sampled_from([*known, 'b']))} :- {', '.join(draw(st.permutations(body)))}.")
    return "\n".join(lines)


def atom(draw, name, terms) -> str:
    arity = {**BASE, **DERIVED}[name]
    return f"{name}({', '.join(draw(terms) for _ in range(arity))})"


@st.composite
def changes(draw) -> list[tuple[str, tuple]]:
    """Base facts that come and go, of stated and of derived predicates."""
    found = []
    for _ in range(draw(st.integers(1, 8))):
        name = draw(st.sampled_from([*BASE, *BASE, *DERIVED]))
        row = draw(st.tuples(*[st.sampled_from(VALUES)] * {**BASE, **DERIVED}[name]))
        found.append((draw(st.sampled_from(["assert", "retract"])), (name, *row)))
    return found


def apply(base: KnowledgeBase, change) -> None:
    verb, fact = change
    (base.assert_ if verb == "assert" else base.retract)(fact)


def atoms(base: KnowledgeBase) -> set:
    """The atoms that hold."""
    return atoms_of({i: base.stored(i) for i in {**BASE, **DERIVED}.items()})


def meaning(base: KnowledgeBase) -> tuple[set, set]:
    """The atoms that hold, and those that are undefined."""
    return atoms(base), undefined_of({i: base.stored(i) for i in {**BASE, **DERIVED}.items()})


def fresh(base: KnowledgeBase) -> tuple[set, set]:
    return meaning(KnowledgeBase(base.clauses, [*BASE.items(), *DERIVED.items()]))
