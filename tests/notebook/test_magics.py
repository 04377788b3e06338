"""Cells of clauses, questions and reasons in a notebook."""

import pytest

pytest.importorskip("IPython")

from IPython.core.error import UsageError
from IPython.core.interactiveshell import InteractiveShell

HOME = "human(ann). robot(rob). food(bread).\neat(A, F) :- human(A), food(F).\n"


@pytest.fixture
def shell():
    shell = InteractiveShell.instance()
    shell.run_line_magic("load_ext", "casper")
    yield shell
    shell.run_line_magic("unload_ext", "casper")
    InteractiveShell.clear_instance()


@pytest.fixture
def home(shell):
    shell.run_cell_magic("casper", "home", HOME)
    return shell


def test_a_cell_of_clauses_is_a_domain(home):
    assert home.user_ns["domain"].kb.ask("eat(ann, bread)")


def test_cells_add_up(home):
    home.run_cell_magic("casper", "", "goal(snack(F)) :- food(F).\nsnack(F) --> eat(F).")
    assert home.user_ns["domain"].library.goals == ("snack",)
    assert home.user_ns["domain"].kb.ask("human(ann)")


def test_a_cell_that_is_run_again_says_what_it_says_now(home):
    home.run_cell_magic("casper", "home", HOME.replace("bread", "tea"))
    assert [answer["F"] for answer in home.user_ns["domain"].kb.query("food(F)")] == ["tea"]


def test_a_mistake_is_a_sentence_with_its_line_and_the_domain_stays(home):
    with pytest.raises(UsageError, match=r"^more:2:13: nothing defines foood/1; did you mean food\?"):
        home.run_cell_magic("casper", "more", "\nsnack(X) :- foood(X).")
    assert home.run_line_magic("ask", "food(F)").rows == (("bread",),)


@pytest.mark.parametrize("line", ["eet(ann, bread)", "eat(ann", ""])
def test_a_question_that_is_none_is_a_sentence(home, line):
    with pytest.raises(UsageError):
        home.run_line_magic("ask", line)


def test_ask_answers_in_a_table(home):
    answers = home.run_line_magic("ask", "eat(A, F).")
    assert answers.to_json() == {
        "question": "eat(A, F)",
        "answers": [{"A": "ann", "F": "bread"}],
        "more": False,
        "doubt": None,
    }
    assert "<th>A</th><th>F</th>" in answers._repr_html_()


@pytest.mark.parametrize(("question", "told"), [("eat(ann, bread)", "yes"), ("eat(rob, bread)", "no")])
def test_ask_says_yes_or_no_where_nothing_is_open(home, question, told):
    assert str(home.run_line_magic("ask", question)) == told


def test_ask_says_no_only_where_there_is_none(shell):
    shell.run_cell_magic("casper", "", "win(X) :- move(X, Y), \\+ win(Y).\nmove(d, d).")
    assert str(shell.run_line_magic("ask", "win(X)")) == "X = d is undefined: win(d) is undefined"


def test_ask_shows_the_first_twenty(shell):
    shell.run_cell_magic("casper", "", "n(N) :- between(1, inf, N).")
    answers = shell.run_line_magic("ask", "n(N)")
    assert len(answers.rows) == 20 and str(answers).endswith("… and more")


def test_why_proves_and_says_where(home):
    assert "[home:1]" in str(home.run_line_magic("why", "eat(ann, bread)"))


@pytest.mark.parametrize("line", ["eat(rob, bread)", "not eat(rob, bread)", "eat(rob, bread)."])
def test_why_says_what_stands_against_it(home, line):
    assert str(home.run_line_magic("why", line)) == "rob is not a human"


def test_why_tells_a_doubt(shell):
    shell.run_cell_magic("casper", "", "win(X) :- move(X, Y), \\+ win(Y).\nmove(d, d).")
    assert "back to win(d)" in str(shell.run_line_magic("why", "win(d)"))


def test_a_shipped_domain_is_begun_with_and_added_to(shell):
    shell.run_line_magic("casper", "kitchen")
    shell.run_cell_magic("casper", "", 'never("no sipping today") :- claim(sip(_, _, _)).')
    assert str(shell.run_line_magic("why", "sip(human, bottle, glass)")) == "no sipping today"


def test_the_first_cell_of_a_notebook_begins_with_nothing(shell):
    assert len(shell.run_line_magic("casper", "").library) == 0


def test_braces_are_the_languages_own(home):
    home.user_ns["bread"] = "tea"
    assert str(home.run_line_magic("ask", "X = {bread}")) == "X = {bread}"
