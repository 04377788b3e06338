"""Random texts and programs, and an independent reading of what a program means: brute force over all values."""

from __future__ import annotations

from itertools import product

from hypothesis import strategies as st

from casper.kb.terms.clauses import Clause, Literal
from casper.kb.terms.terms import Compound, Variable
from casper.kb.terms.unification import is_ground, variables_of

# --- texts ----------------------------------------------------------------------------------------------------------

atoms = st.one_of(
    st.sampled_from(["a", "bob", "sink_2", "[]", "'is'", "'Big name'", "''", '"a sentence, with. dots"', "'it''s'"]),
    st.text(st.characters(codec="utf-8", exclude_characters="'\\\n"), max_size=4).map(lambda t: f"'{t}'"),
    st.text(st.sampled_from(list("ab %/*.'\\\\n\\t")), max_size=4).map(
        lambda t: '"' + t.replace("\\", "\\\\").replace('"', '""') + '"'
    ),
)
numbers = st.one_of(
    st.integers(-(10**20), 10**20).map(str),
    st.floats(allow_nan=False, allow_infinity=False).map(lambda x: f"{x!r}"),
    st.sampled_from(["-1", "0", "-0.0", "1e5", "2.5E-3", "-7.25e+2"]),
)
variables = st.sampled_from(["X", "Y", "Who", "_", "_", "_Rest", "X1"])
names = st.sampled_from(["p", "eat", "'Odd name'", "is_near", "'+'", "'\\\\='", "','"])


def _larger(terms):
    infix = st.sampled_from(["+", "-", "*", "/", ":", "=", "\\=", "==", "<", ">=", "is", ",", ";"])
    arguments = st.lists(terms, min_size=1, max_size=3).map(", ".join)
    return st.one_of(
        st.builds("{}({})".format, names, arguments),
        st.builds("[{}]".format, arguments),
        st.builds("[{} | {}]".format, arguments, terms),
        st.builds("({} {} {})".format, terms, infix, terms),
        st.builds("({} + {} * {})".format, *[st.sampled_from(["1", "-2", "X", "f(Y)"])] * 3),
        st.builds("(\\+ {})".format, terms),
    )


terms = st.recursive(st.one_of(atoms, numbers, variables), _larger, max_leaves=8)
plain_statements = st.one_of(
    st.sampled_from(["p", "rain"]), st.builds("p({})".format, terms), st.builds("eat({}, {})".format, terms, terms)
)
conditions = st.one_of(
    plain_statements,
    plain_statements.map("\\+ {}".format),
    st.builds("{} {} {}".format, variables, st.sampled_from(["=", "\\=", "==", "<", ">=", "is"]), numbers),
    st.builds("({} ; {}, {})".format, plain_statements, plain_statements, plain_statements),
)
bodies = st.lists(conditions, min_size=1, max_size=3).map(", ".join)
sentences = st.one_of(
    plain_statements.map("{}.".format),
    st.builds("{} :- {}.".format, plain_statements, bodies),
    st.builds("{} :- {} ; {}.".format, plain_statements, bodies, bodies),
    st.builds("{} --> {}.".format, plain_statements, terms),
    st.builds(":- {}.".format, plain_statements),
)
texts = st.lists(sentences, max_size=4).map("\n% a comment, with 'quotes' and (brackets\n".join)

# --- programs -------------------------------------------------------------------------------------------------------

CONSTANTS = ("a", "b", "1", "2", "f(a)", "f(f(b))", "g(a, 1)")
BASE = {"b0": 1, "b1": 2, "b2": 2}
DERIVED = {"d0": 1, "d1": 2, "d2": 1, "d3": 2, "d4": 1}  # in an order that negation may only follow downwards
_VARIABLES = ("X", "Y", "Z")


@st.composite
def programs(draw, negation: bool = True, circles: bool = False) -> str:
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
def _rules(draw, name: str, strata: dict[str, int], negation: bool, circles: bool) -> str:
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


def _atom(draw, name: str, terms) -> str:
    arity = {**BASE, **DERIVED}[name]
    return f"{name}({', '.join(draw(terms) for _ in range(arity))})"


# --- what a program means, without the knowledge base's own machinery -----------------------------------------------


def match(pattern, value, environment: dict | None) -> dict | None:
    """The environment extended so that the pattern is the ground value, or None."""
    if environment is None:
        return None
    if isinstance(pattern, Variable):
        if pattern in environment:
            return environment if environment[pattern] == value else None
        return {**environment, pattern: value}
    if isinstance(pattern, tuple):
        if not isinstance(value, tuple) or len(pattern) != len(value):
            return None
        for part, other in zip(pattern, value):
            environment = match(part, other, environment)
        return environment
    return environment if pattern == value else None


def put(term, environment: dict):
    if isinstance(term, Variable):
        return environment.get(term, term)
    return Compound([put(part, environment) for part in term]) if isinstance(term, tuple) else term


def test_holds(operator: str, left, right) -> bool | None:
    """A comparison of ground terms; None when it is undefined."""
    if operator in ("=", "=="):
        return left == right
    if operator in ("\\=", "\\=="):
        return left != right
    if not (isinstance(left, (int, float)) and isinstance(right, (int, float))):
        return None
    return {"<": left < right, ">": left > right, "=<": left <= right, ">=": left >= right, "=:=": left == right}[operator]


test_holds.__test__ = False  # not a test, for all its name


def holds(literal: Literal, rows: set, possible: set | None = None) -> bool | None:
    """Whether an instantiated condition holds, where some atoms do and others may; what is left open may be anything.

    None when it is undefined. Without ``possible`` no atom is.
    """
    possible = rows if possible is None else possible
    if literal.is_comparison:
        found = test_holds(*literal.atom)
    else:
        found = _stands(literal.atom, rows) or (None if _stands(literal.atom, possible) else False)
    return found if found is None else found is not literal.negated


def _stands(atom, rows: set) -> bool:
    return atom in rows if is_ground(atom) else any(match(atom, r, {}) is not None for r in rows)


def solutions(body, rows: set, environment: dict, possible: set | None = None):
    """Every way to satisfy the body: positive conditions first, then ``=``, then the tests.

    Positive conditions stand in ``rows``; a test must hold (with ``possible``: under a negation, of what may hold).
    """
    yield from (found for found, sure in _ways(body, rows, environment, rows, possible or rows) if sure)


def _ways(body, rows: set, environment: dict, certain: set, possible: set):
    """Ways to satisfy the body by rows, each with whether its tests hold for certain: none of them is false."""
    for at, literal in enumerate(body):
        rest = body[:at] + body[at + 1 :]
        if not literal.negated and not literal.is_comparison:
            for row in rows:
                extended = match(put(literal.atom, environment), row, environment)
                if extended is not None:
                    yield from _ways(rest, rows, extended, certain, possible)
            return
    for at, literal in enumerate(body):
        if literal.atom[0] == "=" and not literal.negated:
            left, right = put(literal.atom[1], environment), put(literal.atom[2], environment)
            if is_ground(left) or is_ground(right):
                pattern, value = (right, left) if is_ground(left) else (left, right)
                extended = match(pattern, value, environment)
                if extended is not None:
                    yield from _ways(body[:at] + body[at + 1 :], rows, extended, certain, possible)
                return
    truths = [holds(Literal(put(x.atom, environment), x.negated), certain, possible) for x in body]
    if False not in truths:
        yield environment, None not in truths


def model(clauses: list[Clause]) -> tuple[set, set]:
    """The atoms that hold and those that may: the well-founded model of the whole program, by alternation."""
    certain: set = set()
    while True:
        possible = _least(clauses, certain, None)
        grown = _least(clauses, None, possible)
        if grown == certain:
            return certain, possible
        certain = grown


def _least(clauses: list[Clause], certain: set | None, possible: set | None) -> set:
    """The least set that the clauses give: of what may hold, given what is certain; or of what is certain, given what may."""
    rows: set = set()
    while True:
        found = {
            put(c.head, s)
            for c in clauses
            for s, sure in _ways(list(c.body), rows, {}, rows if certain is None else certain, possible or rows)
            if sure or certain is not None
        }
        if found <= rows:
            return rows
        rows |= found


def atoms_of(relations) -> set:
    """The rows of materialised relations, as atoms."""
    return {Compound((name, *row)) for (name, _), relation in relations.items() for row in relation}


def undefined_of(relations) -> set:
    """The undefined rows of materialised relations, as atoms."""
    return {Compound((name, *row)) for (name, _), relation in relations.items() for row in relation.undefined or ()}


def ground_terms(clauses: list[Clause]) -> list:
    """Every ground term that the clauses mention as an argument."""
    found = {arg for c in clauses for x in (c.head, *(b.atom for b in c.body)) for arg in x.args}
    return sorted((t for t in found if is_ground(t)), key=repr)


def statements_over(values, predicates=DERIVED):
    """Every ground statement over the values."""
    for name, arity in predicates.items():
        for row in product(values, repeat=arity):
            yield Compound((name, *row))


__all__ = ["atoms_of", "ground_terms", "holds", "match", "model", "programs", "put", "solutions", "undefined_of", "variables_of"]
