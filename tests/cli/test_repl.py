"""``casper repl`` through a pipe: one line in, the answer out; no mistake ends it."""

import pytest

from casper.cli.asking.session import Session
from casper.engine.domain.domain import Domain

ONTOLOGY = "human(ann).\ncup(mug). cup(glass).\nfill(A, T) :- human(A), cup(T).\ndrink(A, T) :- human(A), cup(T).\n"
PLANS = "goal(tea(C)) :- cup(C).\ngoal(wait).\ntea(C) --> fill(C), drink(C).\nwait --> fill(C), fill(C).\n"


def ask(casper, *lines, domain="kitchen"):
    told = casper("repl", str(domain), stdin="\n".join(lines) + "\n")
    assert (told.code, told.err) == (0, "")
    return told.out.splitlines()


@pytest.fixture
def home(tmp_path):
    (tmp_path / "ontology.pl").write_text(ONTOLOGY)
    (tmp_path / "plans.pl").write_text(PLANS)
    return tmp_path


def test_a_query_is_answered_in_any_direction(casper):
    assert ask(casper, "eat(human, T, plate)") == ["T = biscuits", "T = meal"]
    assert ask(casper, "?- human(human).") == ["yes"]
    assert ask(casper, "human(tiago)") == ["no"]


def test_answers_come_ten_at_a_time_and_a_semicolon_shows_more(casper):
    out = ask(casper, "agent(A), moveable(T), item(D)", ";", ";", ";", ";", ";", ";", ";")
    assert out[10] == "…   ; shows more"
    assert out[21] == "…   ; shows more"
    assert out[-1] == "there is nothing more to show"
    answers = [line for line in out if line.startswith("A = ")]
    assert len(set(answers)) == len(answers) == 2 * 5 * 5


def test_answers_are_looked_for_only_as_far_as_they_are_shown(tmp_path, capsys):
    (tmp_path / "ontology.pl").write_text("nat(0).\nnat(N) :- nat(M), N is M + 1.\n")
    session = Session(Domain.load(tmp_path))
    session.answer("nat(N)")
    session.answer(";")
    assert capsys.readouterr().out.splitlines()[-2:] == ["N = 19", "…   ; shows more"]


def test_why_and_why_not_and_repair(casper):
    out = ask(casper, "why wash(tiago, plate, sink)", "why not eat(tiago, meal, plate).", "repair eat(human, bottle, plate)")
    assert out[0].startswith("wash(tiago, plate, sink)")
    assert "└─ sink(sink)   [given]   [ontology.pl:13]" in out
    assert out[-2:] == ["tiago is not a human", "add eatable(bottle)"]


def test_what_holds_has_no_reason_against_it_and_nothing_to_repair(casper):
    out = ask(casper, "why not wash(tiago, plate, sink)", "repair wash(tiago, plate, sink)", "why human(tiago)")
    assert out == ["it holds and breaks no constraint", "it is valid as it is", "it does not hold; ask: why not human(tiago)"]


def test_observations_are_read_explained_and_taken_back(casper):
    out = ask(casper, "explain", "observe pick_and_place(meal, hobs)", "explain", "observe eat(biscuits, plate)", "undo", "explain", "undo")
    assert out[0] == "nothing was observed yet: observe an action"
    assert out[1].endswith("lunch 1.00; outcome: lunch")
    assert any("● pick_and_place(meal, hobs)" in line for line in out)
    assert any(line.startswith("eat(biscuits, plate) fits no plan and is left out (") for line in out)
    assert out[-3:] == ["pick_and_place(meal, hobs) is taken back", "nothing was observed yet: observe an action", "there is no observation to take back"]


def test_listing_shows_the_clauses_and_plans_of_a_name(casper, home):
    out = ask(casper, "listing", "listing cup", "listing tea", "listing fill/2", "listing fill/9", domain=home)
    assert "cup/1" in out[0] and "fill/2" in out[0]
    assert out[1:3] == ["cup(mug).", "cup(glass)."]
    assert out[3] == "tea(C) --> fill(C), drink(C)."
    assert out[4] == "fill(A, T) :- human(A), cup(T)."
    assert out[5].startswith("there is no fill/9 here")


def test_no_mistake_ends_it(casper):
    out = ask(casper, "eat(", "foo(X)", "why", "observe", "observe fly", "undo", ":nonsense", "", "% nothing", "; ;", "human(X)", "why not (", "repair 3")
    assert "X = human" in out
    assert any("the text ends here" in line for line in out)
    assert any("did you mean food?" in line for line in out)
    assert not any("failed" in line or "Traceback" in line for line in out)


def test_a_search_without_end_is_unknown_and_not_no(casper, tmp_path):
    (tmp_path / "ontology.pl").write_text("up(s(X)) :- up(X).\nhuman(ann).\n")
    out = ask(casper, "up(Y)", "human(X)", domain=tmp_path)
    assert out[0].startswith("unknown: ")
    assert out[-1] == "X = ann"


def test_quit_ends_it_before_the_next_line(casper):
    assert ask(casper, "human(X)", ":quit", "food(X)") == ["X = human"]


def test_help_shows_every_command(casper):
    out = "\n".join(ask(casper, ":help"))
    for command in ("why not", "repair", "observe", "explain", "undo", "listing", ":reload", ":quit"):
        assert command in out


def test_reload_takes_changed_files_in_and_keeps_the_observations(home, capsys):
    session = Session(Domain.load(home))
    for line in ("observe fill(mug)", "observe drink(mug)", ":reload"):
        session.answer(line)
    assert capsys.readouterr().out.splitlines()[-1] == "no file has changed"
    (home / "ontology.pl").write_text(ONTOLOGY + "cup(bowl).\n")
    session.answer(":reload")
    session.answer("cup(X)")
    assert "X = bowl" in capsys.readouterr().out
    assert [str(o) for o in session.reading.observations] == ["fill(mug)", "drink(mug)"]


def test_reload_tells_what_fits_no_more(home, capsys):
    session = Session(Domain.load(home))
    session.answer("observe fill(mug)")
    session.answer("observe drink(mug)")
    (home / "plans.pl").write_text(PLANS.replace("tea(C) --> fill(C), drink(C)", "tea(C) --> fill(C)"))
    session.answer(":reload")
    assert "drink(mug) fits no more" in capsys.readouterr().out
    assert [str(o) for o in session.reading.observations] == ["fill(mug)"]


def test_reload_of_a_broken_file_leaves_the_old_domain_in_force(home, capsys):
    session = Session(Domain.load(home))
    (home / "ontology.pl").write_text(ONTOLOGY + "cup(bowl")
    session.answer(":reload")
    session.answer("cup(X)")
    out = capsys.readouterr().out
    assert "ontology.pl:5:9: the text ends here" in out
    assert "X = mug" in out


@pytest.mark.parametrize(
    ("line", "word", "completed"),
    [
        ("dr", "dr", ["drink"]),
        ("human(X), f", "f", ["fill"]),
        ("te", "te", ["tea"]),
        ("w", "w", ["why not ", "why ", "wait"]),
        ("why n", "n", ["not "]),
        (":re", ":re", [":reload "]),
        ("observe dri", "dri", ["drink"]),
        ("zz", "zz", []),
    ],
)
def test_names_and_commands_can_be_completed(home, line, word, completed):
    assert Session(Domain.load(home)).completions(line, word) == completed


def test_a_domain_that_cannot_be_loaded_is_exit_code_2(casper):
    told = casper("repl", "kitchn", stdin="human(X)\n")
    assert told.code == 2
    assert "there is no domain" in told.err
