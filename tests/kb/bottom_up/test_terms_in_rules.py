"""Rules that build terms and take them apart by ``=``: the rows are those of brute force, whatever the order."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from programs import atoms_of, model

from casper.kb.base import KnowledgeBase
from casper.kb.terms.unification import is_ground

FACTS = "b(1). b(2). b(f(1)). e(1, 2). e(2, f(2)). e(f(1), g(1, 2)). e(g(2, 1), 1)."
EQUATIONS = [
    "V = f(X)", "f(X) = V", "V = g(X, Y)", "V = g(Y, f(X))", "V = k", "V = X", "X = Y", "Y = f(U)", "f(U) = Y", "Y = g(U, V)", "g(V, 2) = X",
    "g(X, U) = g(V, Y)", "f(V) = f(g(X, X))", "W = f(V)", "g(V, W) = g(f(X), f(Y))", "W = g(V, V)", "Y \\= f(X)", "\\+ Y = f(X)",
    "Y == f(X)", "V = f(1)",
]  # fmt: skip


@st.composite
def rules(draw):
    """A rule in which every variable is bound by a condition or an equation, its conditions in any order."""
    equations = draw(st.lists(st.sampled_from(EQUATIONS), min_size=1, max_size=3, unique=True))
    if not any(x.startswith(("V =", "f(V)", "g(V")) or ("V)" in x and x.startswith(("Y", "g(X"))) for x in equations):
        equations.append("V = h(Y)")
    body = draw(st.permutations(["e(X, Y)", *draw(st.sampled_from([[], ["b(X)"], ["\\+ b(Y)"]])), *equations]))
    return f"d({draw(st.sampled_from(['V', 'X', 'f(V)', 'k']))}, {draw(st.sampled_from(['Y', 'V', 'g(V, X)']))}) :- {', '.join(body)}."


@given(rules(), st.sampled_from(["", "c(X) :- d(X, _), \\+ b(X)."]))
def test_rows_with_terms_made_in_rules_are_those_of_brute_force(rule, more):
    base = KnowledgeBase.from_text(f":- dynamic(d/2). {FACTS} {rule} {more}")
    stored = {i: base.stored(i) for i in [("d", 2), *([("c", 1)] if more else [])]}
    if stored["d", 2] is None:
        return  # some variable is bound by nothing: answered by search
    certain, _ = model(list(base.clauses))
    assert atoms_of(stored) == {atom for atom in certain if atom.indicator in stored}
    assert all(map(is_ground, atoms_of(stored)))


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("e(X, Y), Z = k(Y, X)", ["k(2, 1)"]),
        ("Z = k(Y, X), e(X, Y)", ["k(2, 1)"]),
        ("e(X, Y), Z = k(W), W = f(Y)", ["k(f(2))"]),
        ("e(X, Y), W = Y, k(Y, Z) = k(W, f(W))", ["f(2)"]),
        ("Y is X + 1, Z = k(Y)", ["k(2)"]),
        ("aggregate_all(count, e(X, _), Y), Z = k(Y)", ["k(1)"]),
        ("findall(Y, e(X, Y), L), e(X, Y), Z = Y - L", ["2 - [2]"]),
        ("e(X, Y), Z = [X, Y | T], T = [Y]", ["[1, 2, 2]"]),
    ],
)
def test_a_term_made_in_a_rule_has_its_variables_filled_in(body, expected):
    base = KnowledgeBase.from_text(f"b(1). e(1, 2). l(X, Z) :- b(X), {body}.")
    assert [str(answer["Z"]) for answer in base.query("l(1, Z)")] == expected
    assert [str(row[1]) for row in base.stored(("l", 2))] == expected
