"""Facts, rules and constraints stated in Python: the same model as the text, and the text again."""

import operator as op
import subprocess
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper.kb.authoring import Author, claim, constraint, did, predicate, rule, valid, variable, variables
from casper.kb.base import KnowledgeBase
from casper.kb.errors import ProgramError
from casper.kb.text.reader import read_text

X, Y, N, M = variables("X Y N M")
human, robot, agent, near, age = (
    predicate(n, a) for n, a in (("human", 1), ("robot", 1), ("agent", 1), ("near", 2), ("age", 2))
)

TEXT = """\
human(ann).
robot('Tiago 2').
age(ann, 30).
agent(X) :- human(X).
agent(X) :- robot(X), \\+ human(X).
near(X, Y) :- agent(X), agent(Y), X \\= Y.
age(X, N) :- robot(X), M = 2, N is M + 1.
never("nobody old waves") :- claim(wave(X)), age(X, N), N >= 90, did(near(X, ann), M).
"""


def written_in_python():
    kb = Author()
    kb.add_fact(human("ann"), robot("Tiago 2"), age("ann", 30))
    kb.add_rule(agent(X), human(X))
    kb.add_rule(agent(X), robot(X), ~human(X))
    kb.add_rule(near(X, Y), agent(X), agent(Y), X != Y)
    kb.add_rule(age(X, N), robot(X), M == 2, N.equals(M + 1))
    wave = predicate("wave", 1)
    kb.add_constraint("nobody old waves", claim(wave(X)), age(X, N), N >= 90, did(near(X, "ann"), M))
    return kb


def test_python_prints_to_the_text():
    assert written_in_python().to_text() == KnowledgeBase.from_text(TEXT).to_text()


def test_python_and_text_are_the_same_clauses_and_the_same_model():
    text, python = KnowledgeBase.from_text(TEXT), written_in_python()
    assert python.clauses == text.clauses
    for name, arity in (("agent", 1), ("near", 2), ("age", 2)):
        assert set(python.rows(name, arity)) == set(text.rows(name, arity)) != set()


def test_a_statement_can_be_asked_as_it_is_written():
    assert written_in_python().ask(near("ann", "Tiago 2").compound)
    assert not written_in_python().ask(near("ann", "ann").compound)


def test_clauses_go_into_any_knowledge_base():
    kb = KnowledgeBase.from_text("human(ann).")
    kb.add([rule(agent(X), human(X)), constraint("there are no agents", agent(X))])
    assert kb.ask("agent(ann)")
    assert list(kb.query("never(S)")) == [{"S": "there are no agents"}]


def test_a_validity_can_be_a_condition():
    kb = Author()
    kb.add_fact(human("ann"))
    kb.add_rule(agent(X), human(X), valid(human(X)))
    assert kb.ask("agent(ann)")


def test_a_list_is_a_term():
    assert str(read_text("near(X, [a, 1]).")[0].head) == repr(near(X, ["a", 1]))


@given(st.sampled_from(["<", "<=", ">", ">=", "==", "!="]), st.integers(-5, 5))
def test_every_comparison_is_the_texts(operator, bound):
    condition = compared(operator, bound)
    written = {"<=": "=<", "==": "=", "!=": "\\="}.get(operator, operator)
    assert [rule(agent(X), age(X, N), condition)] == read_text(f"agent(X) :- age(X, N), N {written} {bound}.")


def compared(operator, bound):
    functions = {"<": op.lt, "<=": op.le, ">": op.gt, ">=": op.ge, "==": op.eq, "!=": op.ne}
    return functions[operator](N, bound)


def test_a_constant_may_stand_on_the_left():
    assert repr(op.lt(1, N)) == "N > 1"
    assert repr(N.equals(1 + M * 2 - 3)) == "N is 1 + M * 2 - 3"
    assert repr(N.equals(2 * (1 - M) / 4)) == "N is 2 * (1 - M) / 4"


def test_negating_twice_is_not_negating():
    assert rule(agent(X), ~~human(X)) == rule(agent(X), human(X))


@pytest.mark.parametrize(
    ("mistake", "sentence"),
    [
        (lambda: human("ann", "bob"), "human takes 1 argument, not 2"),
        (lambda: variable("x"), "starts with a capital letter"),
        (lambda: variable("X Y"), "starts with a capital letter"),
        (lambda: variable("_"), "starts with a capital letter"),
        (lambda: human(True), "cannot stand in a statement"),
        (lambda: human(None), "cannot stand in a statement"),
        (lambda: claim(~human(X)), "cannot stand in a statement"),
        (lambda: Author().add_fact(human(X)), "has a variable"),
        (lambda: rule(~human(X), agent(X)), "it is negated"),
    ],
)
def test_a_mistake_is_one_sentence(mistake, sentence):
    with pytest.raises(ProgramError) as told:
        mistake()
    assert sentence in str(told.value)
    assert "\n" not in str(told.value)


def test_a_condition_is_neither_true_nor_false():
    for unknown in (X, N < 3, human("ann"), ~human("ann")):
        with pytest.raises(TypeError, match="neither true nor false"):
            bool(unknown)


def test_a_type_checker_understands_it_and_finds_mistakes(tmp_path):
    pytest.importorskip("mypy")
    (tmp_path / "good.py").write_text(
        "from casper.kb.authoring import Author, predicate, variable\n"
        "kb, X, p = Author(), variable('X'), predicate('p', 1)\n"
        "kb.add_fact(p('a'))\nkb.add_rule(p(X), ~p('b'), X != 'a', X < 3)\n"
    )
    (tmp_path / "bad.py").write_text(
        "from casper.kb.authoring import Author, predicate, variable\n"
        "kb, X, p = Author(), variable('X'), predicate('p', 1)\n"
        "kb.add_fact(X < 3)\nkb.add_rule(X)\np(None)\nkb.add_rule(p(X), 'human(X)')\n"
    )
    command = [sys.executable, "-m", "mypy", "--strict", "--follow-imports=silent", str(tmp_path / "good.py"), str(tmp_path / "bad.py")]
    told = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path).stdout
    mistakes = [line for line in told.splitlines() if "error" in line and line.startswith("bad.py")]
    assert [line.split(":")[1] for line in mistakes] == ["3", "4", "5", "6"]
    assert "good.py" not in told


def test_every_comparison_has_its_operator_and_predicates_say_their_names():
    assert [str(rule(human(X), c).body[0]) for c in (X < 1, X <= 1, X > 1, X >= Y)] == ["X < 1", "X =< 1", "X > 1", "X >= Y"]
    assert repr(near) == "near/2"
    assert hash(X) == hash(variable("X"))
