"""What is printed is what is there: no code is replaced, nothing is cut off, and every stream can hold it."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

import casper.cli as cli
from casper.cli.asking.session import Session
from casper.cli.authoring.movements import tell
from casper.cli.terminal.output import console
from casper.cli.terminal.plain import SIGNS, settle_streams, visible
from casper.cli.terminal.showing import say, show
from casper.engine.domain.domain import Domain
from casper.engine.events import Event
from casper.engine.events.timeline import Timeline
from casper.engine.movements.tree import Evaluation
from casper.kb.text.lines import Span, bar, line

ODD = ["a:x:b", "[bold]", "[/]", "a\\", "\\[red]", "[", "\x1b[31m", "a\tb", "a\rb", "\u202eabc", "x" * 300, "http://a.b"]


# --- as it is -------------------------------------------------------------------------------------------------------


@given(st.lists(st.text(), min_size=1, max_size=3))
def test_texts_within_colours_are_shown_as_they_are(texts):
    out = console()
    with out.capture() as captured:
        show(out, [line(*(Span(text, "bad") for text in texts))])
    assert captured.get() == "".join(map(visible, texts)) + "\n"


@given(st.text())
def test_texts_without_markup_are_shown_as_they_are(text):
    out = console()
    with out.capture() as captured:
        say(out, text)
    assert captured.get() == visible(text) + "\n"


@given(st.text())
def test_what_is_visible_obeys_nothing_and_says_what_was_there(text):
    shown = visible(text)
    assert not any(c in shown for c in "\x1b\r\t\x07\x9b\u202e\u2067")
    if text.isprintable():
        assert shown == text


@pytest.mark.parametrize("atom", ["a:x:b", "[bold]", "[/]", "[", "é", "a#1", "x" * 300])
def test_an_atom_is_answered_as_it_stands(casper, atom):
    assert casper("query", "kitchen", f"X = '{atom}'").out in (f"X = '{atom}'\n", f"X = {atom}\n")
    assert casper("repl", "kitchen", stdin=f"X = '{atom}'\n").out in (f"X = '{atom}'\n", f"X = {atom}\n")


def test_a_terminal_is_never_told_what_to_do_by_a_domain(casper, tmp_path):
    (tmp_path / "ontology.pl").write_text('p(\'\x1b[31m\').\np(b) :- p(c).\nnever("\x1b]0;title\x07 \\\\ [bold]") :- claim(p(b)).\n')
    for command in (["query", "p(X)"], ["verify", "p(b)"], ["check"]):
        told = casper(command[0], str(tmp_path), *command[1:])
        assert "\x1b" not in told.out + told.err
        assert "\x07" not in told.out + told.err
    assert "'\\x1B\\[31m'" in casper("query", str(tmp_path), "p(X)").out  # as the language spells it
    assert "\x1b" not in casper("query", str(tmp_path), "\x1b(X)").err


@pytest.mark.parametrize("name", ["a:x:b", "a[bold]", "a\\\\", "a[/]", "a[red]b[/red]"])
def test_every_command_shows_the_names_of_a_domain(casper, tmp_path, name):
    text = f"agent(ann). human(ann).\n'{name}'(A) :- agent(A).\nnever(\"no {name} twice\") :- claim('{name}'(_)), did('{name}'(_), _).\n"
    folder = tmp_path / "odd :x: [red]"
    folder.mkdir()
    (folder / "ontology.pl").write_text(text)
    (folder / "plans.pl").write_text(f"goal('{name}!').\n'{name}!' --> '{name}'.\n")
    assert f"'{name}'(ann) is valid" in casper("verify", str(folder), f"'{name}'(ann)").out
    explained = casper("explain", str(folder), f"'{name}'").out
    assert f"  {name}!".replace("\\\\", "\\") in explained.split("outcome")[0]
    assert f"● '{name}'" in explained
    assert f"'{name}'" in casper("repl", str(folder), stdin=f"why '{name}'(ann)\n").out
    (folder / "ontology.pl").write_text(text + f"p(X) :- '{name}?'(X).\n")
    checked = casper("check", str(folder)).out
    assert f"{folder}/ontology.pl:4: error" in checked
    assert f"p(X) :- '{name}?'(X)." in checked


@pytest.mark.parametrize("name", ODD)
def test_the_timeline_shows_names_as_they_are(capsys, name):
    timeline = Timeline(name, name)
    for event in (
        Event("focus", 1.0, {"target": name, "destination": None, "scores": {name: 1.0, "b": 0.5}}),
        Event("movement", 1.0, {"movement": name, "features": {}}),
        Event("verdict", 1.0, {"statement": name, "valid": False, "completed": name, "reasons": [name]}),
        Event("reading", 1.0, {"explanations": 1, "observations": [name], "posterior": {name: 0.5}, "rejected": [{"goal": name, "reasons": [name]}]}),
        Event("prediction", 1.0, {"observed": 1, "missed": 0, "goal": name}),
        Event("plan", 1.0, {"agent": name, "actions": [name], "waiting": [name]}),
        Event("robot", 1.0, {"status": "failed", "action": name, "reason": name}),
        Event("warning", 1.0, {"message": name}),
    ):
        capsys.readouterr()
        show(console(), timeline.lines(event))
        shown = capsys.readouterr().out
        assert visible(name) in shown or event.type == "focus", event.type


def test_nothing_is_cut_off_in_a_narrow_terminal(casper, monkeypatch):
    monkeypatch.setenv("COLUMNS", "30")
    actions = ["pick_and_place(meal, hobs)", "cook(meal, hobs)", "pick_and_place(meal, plate)"]
    assert " → ".join(actions) in casper("explain", "kitchen", *actions).out
    assert "…" not in casper("explain", "--help").out
    for option in ("--no-verification", "--questions", "--picture", "kitchen"):
        assert option in casper("explain", "--help").out


def test_the_table_of_training_is_whole_in_a_narrow_terminal(monkeypatch, capsys):
    monkeypatch.setenv("COLUMNS", "20")
    labels = ("a:x:b", "[bold]", "transportation")
    tell(
        Evaluation(1.0, {0: 1.0}, {a: {b: 7 * (a == b) for b in labels} for a in labels}, labels), 21, Path("[x]:x:.pl"), False
    )
    lines = capsys.readouterr().out.splitlines()
    assert lines[2].split() == ["true", "\\", "taken", "for", *labels]
    assert [line.split() for line in lines[3:6]] == [["a:x:b", "7", "·", "·"], ["[bold]", "·", "7", "·"], ["transportation", "·", "·", "7"]]
    assert lines[-1] == "written to [x]:x:.pl"


@pytest.mark.parametrize("command", ["run", "explain", "verify", "query", "repl", "watch", "check", "train"])
def test_help_says_in_whole_what_a_command_does(casper, command):
    sentence = getattr(cli, command).__doc__.splitlines()[0]
    assert sentence in " ".join(casper("--help").out.split())
    assert sentence in " ".join(casper(command, "--help").out.split())


# --- streams that are not UTF-8 -------------------------------------------------------------------------------------


HERE = {**os.environ, "PYTHONPATH": str(Path(__file__).resolve().parents[2] / "src"), "LC_ALL": "C.UTF-8"}


def spoken(encoding, *arguments, stdin=b""):
    """A command in a process of its own, whose streams speak another encoding; the bytes it said."""
    env = {**HERE, "PYTHONIOENCODING": encoding, "PYTHONUTF8": "0"}
    return subprocess.run([sys.executable, "-m", "casper", *arguments], input=stdin, capture_output=True, env=env)


ENCODINGS = ["ascii", "latin-1", "cp1252", "cp437", "koi8-r", "shift-jis"]


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_signs_are_plain_where_the_encoding_has_none(encoding):
    told = spoken(encoding, "verify", "kitchen", "eat(tiago, meal, plate)", "wash(tiago, plate, _)")
    assert (told.returncode, told.stderr) == (1, b"")
    out = told.stdout.decode(encoding)
    if encoding in ("ascii", "latin-1"):
        assert out.splitlines()[0] == "x eat(tiago, meal, plate) is not valid"
        assert "+ wash(tiago, plate, _) is valid" in out
        assert "  |- agent(tiago)   [ontology.pl:18]" in out
        assert "  `- sink(sink)   [given]   [ontology.pl:13]" in out


def test_bars_and_trees_of_explanations_are_plain_and_keep_their_columns():
    plain = spoken("ascii", "explain", "kitchen", "eat").stdout.decode("ascii").splitlines()
    full = spoken("utf-8", "explain", "kitchen", "eat").stdout.decode("utf-8").splitlines()
    assert plain[2] == "  breakfast    #######    0.69"
    assert "    |-- * eat(biscuits, plate)" in plain
    assert [len(line) for line in plain] == [len(line) for line in full]


def test_every_sign_that_is_printed_has_a_plain_one():
    from casper.plans.trees.tree import MARKS

    for sign in {*MARKS.values(), *"".join(bar(n / 80).text for n in range(81)), *"✔✘★▷→…·─│├└╙╟╼⋮–"} - {" "}:
        assert SIGNS[sign].isascii()


def test_everything_else_is_spelt_out():
    assert spoken("ascii", "query", "kitchen", "X = 'é𝄞'").stdout == b"X = '\\xe9\\U0001d11e'\n"


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_json_is_whole_in_any_encoding(encoding):
    told = spoken(encoding, "query", "kitchen", "X = 'é✔𝄞ж'", "--json")
    assert json.loads(told.stdout.decode(encoding)) == {"X": "é✔𝄞ж"}


def test_a_mistake_is_told_in_any_encoding():
    told = spoken("ascii", "check", "kitchén→")
    assert told.returncode == 2
    assert told.stderr.decode("ascii").startswith("casper: there is no domain 'kitch\\xe9n->'")


def test_a_name_that_is_no_text_is_told():
    told = spoken("utf-8", "check", b"kitch\xff")
    assert told.returncode == 2
    assert b"kitch\\udcff" in told.stderr


def test_the_repl_goes_on_after_bytes_that_are_no_text():
    told = spoken("utf-8", "repl", "kitchen", stdin=b"human(X)\n\xff(X)\nhuman(X)\n")
    assert (told.returncode, told.stderr) == (0, b"")
    lines = told.stdout.decode().splitlines()
    assert (lines[0], lines[-1]) == ("X = human", "X = human")


@pytest.mark.parametrize("encoding", ["utf-8", "ascii", "latin-1", "cp1252"])
def test_world_states_are_utf8_whatever_the_terminal_speaks(encoding):
    def line(t, name):
        return b'{"t": %d, "agents": {"human": {"x": 0, "y": 0, "heading": 0}}, "objects": {"%s": {"x": 1, "y": 0}}}\n' % (t, name)

    bad = line(2, b"k\xfchl")
    stdin = b"\xef\xbb\xbf" + line(1, "kühl".encode()) + bad + line(3, "kühl".encode())
    told = spoken(encoding, "watch", "kitchen", "--json", stdin=stdin)
    events = [json.loads(each) for each in told.stdout.decode(encoding).splitlines()]
    assert [e["message"] for e in events if e["type"] == "warning"] == [
        "line 1: kühl is in view and nothing the domain knows; what is done with it is not valid",
        f"line 2 is left out: it is not UTF-8 (byte 0xfc at column {bad.index(0xFC) + 1}); send JSON in UTF-8",
    ]
    assert {name for e in events if e["type"] == "focus" for name in e["scores"]} == {"kühl"}
    assert (told.returncode, told.stderr) == (0, b"")


def test_a_world_state_without_an_end_is_left_out(casper, monkeypatch):
    monkeypatch.setattr("casper.streams.sources.lines.LONGEST", 200)
    good = '{"t": 1, "agents": {}, "objects": {"cup": {"x": 1, "y": 0}}}'
    told = casper("watch", "kitchen", "--json", stdin=f"{'x' * 1000}\n{good}\n{'y' * 201}")
    assert [e["message"] for e in told.json if e["type"] == "warning" and "left out" in e["message"]] == [
        f"line {n} is left out: it is longer than 200 characters" for n in (1, 3)
    ]


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs a device that is always full")
@pytest.mark.parametrize("json", [(), ("--json",)])
def test_a_full_disk_behind_the_output_is_one_sentence(json):
    with open("/dev/full", "wb") as full:
        command = [sys.executable, "-m", "casper", "query", "kitchen", "human(X)", *json]
        told = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, env=HERE)
    assert (told.returncode, told.stderr) == (2, "casper: cannot write the output (No space left on device)\n")


@pytest.mark.parametrize("arguments", [["query", "kitchen", "human(X)"], ["query", "kitchen", "human(X)", "--json"], ["--help"], []])
def test_a_reader_that_has_had_enough_is_no_mistake(arguments):
    """Nor is it exit code 1, which says that there is no answer."""
    reading, writing = os.pipe()
    os.close(reading)
    command = [sys.executable, "-m", "casper", *arguments]
    told = subprocess.run(command, stdout=writing, stderr=subprocess.PIPE, text=True, env=HERE)
    os.close(writing)
    assert (told.returncode, told.stderr) == (0, "")


def test_input_that_cannot_be_read_is_one_sentence(tmp_path):
    with open(tmp_path / "written only", "wb") as stdin:
        told = subprocess.run([sys.executable, "-m", "casper", "watch", "kitchen"], stdin=stdin, capture_output=True, text=True, env=HERE)
    assert (told.returncode, told.stderr) == (2, "casper: cannot go on (Bad file descriptor)\n")


@pytest.mark.skipif(not os.path.exists("/bin/sh"), reason="needs a shell that closes streams")
@pytest.mark.parametrize("closed", ["<&-", ">&-", "2>&-", "<&- >&- 2>&-"])
@pytest.mark.parametrize(("arguments", "code"), [("query kitchen 'human(tiago)'", 1), ("watch kitchen", 0), ("repl kitchen", 0), ("check gone", 2)])
def test_streams_may_be_closed(arguments, code, closed):
    command = f"{sys.executable} -m casper {arguments} {closed}"
    told = subprocess.run(["/bin/sh", "-c", command], stdin=subprocess.DEVNULL, capture_output=True, text=True, env=HERE)
    assert told.returncode == code
    assert "Traceback" not in told.stderr


def test_settling_streams_twice_does_no_harm(capsys):
    settle_streams()
    settle_streams()
    show(console(), Domain.load("kitchen").reading().lines())
    Session(Domain.load("kitchen")).answer("human(X)")
    assert capsys.readouterr().out.splitlines()[-1] == "X = human"
