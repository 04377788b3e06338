"""Random texts, and the shipped strategies and oracle of programs, by the names that the tests use."""

from __future__ import annotations

from itertools import product

from hypothesis import strategies as st

from casper.kb.base import KnowledgeBase
from casper.kb.program.program import Program, analyse
from casper.kb.terms.clauses import Clause
from casper.kb.terms.terms import Compound
from casper.kb.terms.unification import is_ground, variables_of
from casper.kb.text.reader import read_text
from casper.testing.oracles.models import holds, match, model, put, solutions
from casper.testing.strategies.programs import BASE, DERIVED, programs

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

# --- statements over a program -----------------------------------------------------------------------------------------


def program_of(text: str) -> Program:
    """The program that a text states."""
    base = KnowledgeBase()
    base.add(read_text(text))
    return analyse(base.clauses, base._stated.dynamic)


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


__all__ = [
    "BASE", "DERIVED", "atoms_of", "ground_terms", "holds", "match", "model", "program_of", "programs", "put", "solutions", "undefined_of",
    "variables_of",
]  # fmt: skip
