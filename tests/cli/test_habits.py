"""Habits of the command line: exit codes in one table, hints, quiet, completion, wrapped lines, progress."""

import io
import re
from pathlib import Path
from threading import Event
from types import SimpleNamespace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rich.cells import cell_len
from rich.console import Console
from rich.text import Text

from casper.cli.terminal import progress as progressing
from casper.cli.terminal.codes import CODES
from casper.cli.terminal.completing import domains, goals, typed_domain
from casper.cli.terminal.showing import show
from casper.cli.terminal.wrapping import wrapped
from casper.kb.text.lines import Span, line

PAGE = (Path(__file__).resolve().parents[2] / "docs" / "commands.md").read_text()


# --- exit codes and hints -------------------------------------------------------------------------------------------


def test_the_exit_codes_of_the_page_and_of_the_help_are_those_of_the_table(casper):
    rows = dict(re.findall(r"^\| (\d+) \| (.+) \|$", PAGE, re.MULTILINE))
    assert {int(code): meaning for code, meaning in rows.items()} == CODES
    told = " ".join(casper("--help").out.split())
    assert all(f"{code} {meaning}" in told for code, meaning in CODES.items())


def test_a_misspelt_name_in_a_question_is_told_beside_the_no(casper):
    told = casper("query", "kitchen", "wash(tiago, plat, X)")
    assert (told.code, told.out) == (1, "no\n")
    assert told.err == "casper: nothing here is called plat; did you mean plate?\n"
    assert f"{told.out}{told.err}".strip() in PAGE


def test_quiet_leaves_hints_out(casper):
    assert casper("query", "kitchen", "wash(tiago, plat, X)", "--quiet").err == ""


def test_a_no_to_names_there_are_has_no_hint(casper):
    assert casper("query", "kitchen", "wash(tiago, meal, X)").err == ""


def test_verify_and_explain_tell_names_that_are_nowhere(casper):
    assert "called hobz; did you mean hobs?" in casper("verify", "kitchen", "cook(human, meal, hobz)").err
    assert "called hobz; did you mean hobs?" in casper("explain", "kitchen", "pick_and_place(meal, hobz)").err


def test_a_session_tells_them_among_its_answers(casper):
    told = casper("repl", "kitchen", stdin="wash(tiago, plat, X)\nwhy not wash(tiago, Tiago, sinc)\n").out
    assert told.startswith("no\nnothing here is called plat; did you mean plate?\n")
    assert told.endswith("nothing here is called sinc; did you mean sink?\n")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["verfy", "kitchen"], "verify"),
        (["run", "kitchen", "--sed", "3"], "--seed"),
        (["check", "kichen"], "did you mean kitchen?"),
        (["query", "kitchen", "wsh(A, B, C)"], "did you mean wash?"),
    ],
)
def test_whatever_is_misspelt_is_refused_with_what_there_is(casper, arguments, said):
    told = casper(*arguments)
    assert told.code == 2 and said in told.err


# --- completion -----------------------------------------------------------------------------------------------------


def test_shipped_domains_and_folders_are_completed(tmp_path, monkeypatch):
    (tmp_path / "home").mkdir()
    (tmp_path / "house.txt").touch()
    monkeypatch.chdir(tmp_path)
    assert domains("ki") == ["kitchen"]
    assert domains("ho") == ["home/"]
    assert domains("nowhere/x") == []


def test_goals_are_those_of_the_domain_that_was_typed(monkeypatch):
    monkeypatch.setenv("COMP_WORDS", "casper run --no-robot kitchen --goal l")
    assert goals(typed_domain("run"), "l") == ["lunch"]
    assert goals("nowhere", "l") == []


def test_completion_can_be_installed(casper):
    assert "--install-completion" in casper("--help").out


# --- lines ----------------------------------------------------------------------------------------------------------

WORDS = st.lists(st.text(st.sampled_from("abé漢"), min_size=1, max_size=9), min_size=1, max_size=12).map(" ".join)


@given(WORDS, st.integers(0, 8), st.integers(30, 60))
@settings(max_examples=80)
def test_no_line_is_wider_than_the_terminal_and_no_word_is_lost(words, indent, width):
    out = Console(file=io.StringIO(), width=width, soft_wrap=False)
    parts = [part.plain for part in wrapped(Text(" " * indent + words), out)]
    assert all(cell_len(part) <= width for part in parts)
    assert " ".join(parts).split() == words.split()


def test_what_follows_stands_further_to_the_right():
    out = Console(file=io.StringIO(), width=30, soft_wrap=False)
    show(out, [line(Span("  15.0", "faint"), "  ✔ the partner takes the meal to the hobs")])
    assert out.file.getvalue().splitlines() == [
        "  15.0  ✔ the partner takes",
        "            the meal to the",
        "            hobs",
    ]


def test_where_nobody_looks_lines_are_as_long_as_they_are():
    out = Console(file=io.StringIO(), width=30, soft_wrap=True)
    show(out, [line("a " * 40)])
    assert len(out.file.getvalue().splitlines()) == 1


def test_a_rule_that_fills_the_line_up_ends_with_it():
    out = Console(file=io.StringIO(), width=40, soft_wrap=False)
    show(out, [line("observed ", "─" * 70)])
    assert out.file.getvalue() == f"observed {'─' * 31}\n"


def test_no_color_is_obeyed(monkeypatch):
    monkeypatch.setenv("NO_COLOR", "1")
    out = Console(
        file=io.StringIO(), force_terminal=True, color_system="standard", soft_wrap=True, legacy_windows=False
    )
    show(out, [line(Span("✔", "good"), " valid")])
    assert out.file.getvalue() == "✔ valid\n"


# --- progress -------------------------------------------------------------------------------------------------------


@pytest.fixture
def terminal(monkeypatch):
    """Standard error as a terminal; what is shown on it."""
    shown, begun = [], Event()
    bar = SimpleNamespace(
        add_task=lambda what, total: shown.append(f"{what} of {total}") or 0,
        start=lambda: shown.append("started") or begun.set(),
        wait=lambda: begun.wait(10),
        update=lambda task, completed: shown.append(completed),
        stop=lambda: shown.append("stopped"),
    )
    monkeypatch.setattr(progressing, "_bar", lambda total: bar)
    monkeypatch.setattr(progressing, "_is_watched", lambda: True)
    return shown


def test_what_is_over_at_once_shows_no_bar(terminal):
    with progressing.progress("trials", 3) as at:
        at(1)
    assert terminal == ["trials of 3", 1, "stopped"]


def test_what_takes_longer_does(terminal, monkeypatch):
    monkeypatch.setattr(progressing, "SILENT_SECONDS", 0.0)
    with progressing.progress("trials", 3):
        progressing._bar(3).wait()
    assert terminal == ["trials of 3", "started", "stopped"]


def test_quiet_shows_none(terminal):
    with progressing.progress("trials", 3, quiet=True) as at:
        at(1)
    assert terminal == []
