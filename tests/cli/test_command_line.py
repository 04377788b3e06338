"""The command line as such: its version, its exit codes, its numbers, and where it may write."""

import json
import os
import tomllib
from pathlib import Path

import pytest

import casper as package

ROOT = Path(__file__).resolve().parents[2]
COMMANDS = ["run", "explain", "verify", "query", "repl", "watch", "check", "train"]


# --- exit codes -----------------------------------------------------------------------------------------------------


def test_the_version_is_that_of_the_distribution(casper):
    told = casper("--version")
    assert (told.code, told.out, told.err) == (0, f"casper {package.__version__}\n", "")
    assert tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"] == package.__version__


def test_alone_it_shows_its_help_and_all_is_well(casper):
    bare, asked = casper(), casper("--help")
    assert (bare.code, bare.err) == (asked.code, asked.err) == (0, "")
    assert bare.out.strip() == asked.out.strip()
    assert all(command in bare.out for command in COMMANDS)


@pytest.mark.parametrize("as_json", [(), ("--json",)])
@pytest.mark.parametrize(("goal", "code"), [("human(human)", 0), ("human(X)", 0), ("human(tiago)", 1), ("human(X), robot(X)", 1)])
def test_a_question_without_an_answer_is_exit_code_1(casper, goal, code, as_json):
    told = casper("query", "kitchen", goal, *as_json)
    assert (told.code, told.err) == (code, "")
    assert bool(told.out) == (code == 0 or not as_json)


def test_a_question_that_is_given_up_is_a_mistake_and_no_missing_answer(casper, tmp_path):
    (tmp_path / "ontology.pl").write_text("up(s(X)) :- up(X).\nhuman(ann).\n")
    assert casper("query", str(tmp_path), "up(X)").code == 2


@pytest.mark.parametrize("arguments", [["fly"], ["query"], ["query", "kitchen"], ["explain", "kitchen", "eat", "--top"], ["--fly"]])
def test_a_wrong_call_is_exit_code_2_and_says_where_help_is(casper, arguments):
    told = casper(*arguments)
    assert (told.code, told.out) == (2, "")
    assert told.err.splitlines()[-1].startswith("Error: ")
    assert "--help" in told.err or arguments[-1] == "--top"


# --- numbers --------------------------------------------------------------------------------------------------------

HUGE = "1" + "0" * 30
ENDLESS = "1" + "0" * 5000  # more digits than Python reads
NO_WHOLE_NUMBERS = ["-1", "nan", "inf", "-inf", "1.5", "x", "", ENDLESS]


def refused(told):
    assert (told.code, told.out) == (2, "")
    assert "Traceback" not in told.err
    assert told.err.splitlines()[-1].startswith(("casper: ", "Error: "))


@pytest.mark.parametrize("value", NO_WHOLE_NUMBERS)
@pytest.mark.parametrize("option", ["--top", "--questions", "--goals"])
def test_a_number_that_is_none_is_refused_by_explain(casper, option, value):
    refused(casper("explain", "kitchen", "eat", option, value))


@pytest.mark.parametrize("option", ["--top", "--questions", "--goals"])
def test_a_huge_number_is_only_more_than_there_is(casper, option):
    few, many = casper("explain", "kitchen", "eat", option, "50", "--json"), casper("explain", "kitchen", "eat", option, HUGE, "--json")
    assert (many.code, many.json) == (0, few.json)


@pytest.mark.parametrize("value", ["-1", "0", "nan", "inf", "-inf", "1.0000001", HUGE, "x", ""])
@pytest.mark.parametrize("command", [("explain", "kitchen", "eat"), ("watch", "kitchen")])
def test_a_price_that_is_none_is_refused(casper, command, value):
    refused(casper(*command, "--noise", value))


@pytest.mark.parametrize("value", ["5e-324", "1e-320", "1e-300", "1", "1.0"])
def test_any_price_above_0_up_to_1_will_do(casper, value):
    told = casper("explain", "kitchen", "eat", "sip", "--noise", value, "--json")
    assert told.code == 0
    assert all(0 <= share <= 1 for share in told.json[-1]["posterior"].values())


@pytest.mark.parametrize("value", ["0", *NO_WHOLE_NUMBERS])
def test_a_limit_that_is_none_is_refused(casper, value):
    refused(casper("query", "kitchen", "human(X)", "--limit", value))


def test_a_huge_limit_is_none_at_all(casper):
    assert casper("query", "kitchen", "human(X)", "--limit", HUGE, "--json").json == [{"X": "human"}]


@pytest.mark.parametrize("value", NO_WHOLE_NUMBERS)
def test_watch_refuses_a_number_of_goals_that_is_none(casper, value):
    refused(casper("watch", "kitchen", "--goals", value))


@pytest.mark.parametrize(
    ("option", "value"),
    [
        *(("--seed", value) for value in NO_WHOLE_NUMBERS),
        ("--seed", "-5"),
        *(("--speed", value) for value in ("-1", "nan", "inf", "-inf", "1e999", "x", "")),
        *(("--goals", value) for value in ("0", *NO_WHOLE_NUMBERS)),
        *(("--noise", value) for value in ("0", "-1", "nan", "inf", "x")),
    ],
)
def test_run_refuses_numbers_that_are_none(casper, option, value):
    pytest.importorskip("mujoco")
    refused(casper("run", "kitchen", option, value))


def test_the_seed_is_refused_in_its_own_sentence(casper):
    pytest.importorskip("mujoco")
    assert casper("run", "kitchen", "--seed", "-5").err == "casper: a seed is a whole number from 0, not -5\n"


def test_a_domain_without_goals_is_no_room_to_pursue_one(casper, tmp_path):
    pytest.importorskip("mujoco")
    for file in ("ontology.pl", "actions.pl", "movements.pl", "scene.pl"):
        (tmp_path / file).write_text((package.Domain.load("kitchen").folder / file).read_text())
    told = casper("run", str(tmp_path))
    refused(told)
    assert "has no goals" in told.err


def test_the_slowest_pace_is_slept_in_naps(monkeypatch):
    from casper.cli.terminal import pacing
    from casper.engine.events import Event

    naps = []
    clock = iter(range(0, 10**9, 10**6))
    monkeypatch.setattr(pacing.time, "monotonic", lambda: float(next(clock)))
    monkeypatch.setattr(pacing.time, "sleep", naps.append)
    assert len(list(pacing.paced([Event("focus", 1.0, {})], 1e-7))) == 1
    assert set(naps) == {3600.0}


@pytest.mark.parametrize(
    ("option", "value"),
    [
        *(("--seed", value) for value in (*NO_WHOLE_NUMBERS, HUGE, str(2**32))),
        *(("--leaves", value) for value in ("0", "1", "81", HUGE, *NO_WHOLE_NUMBERS)),
        *(("--trials", value) for value in ("0", "1", "1001", HUGE, *NO_WHOLE_NUMBERS)),
    ],
)
def test_train_refuses_numbers_that_are_none_before_it_learns(casper, tmp_path, monkeypatch, option, value):
    pytest.importorskip("mujoco")
    pytest.importorskip("sklearn")
    learns_never(monkeypatch)
    refused(casper("train", "kitchen", option, value, "--output", str(tmp_path / "movements.pl")))
    assert list(tmp_path.iterdir()) == []


# --- where it writes ------------------------------------------------------------------------------------------------


def learns_never(monkeypatch):
    def learn(*arguments, **options):
        raise AssertionError("it was worked out before the place was looked at")

    monkeypatch.setattr("casper.sim_adapter.training.samples.training_recordings", learn)


def reads_never(monkeypatch):
    def load(*arguments, **options):
        raise AssertionError("the domain was read before the place was looked at")

    monkeypatch.setattr(package.Domain, "load", load)


@pytest.mark.parametrize(
    ("place", "sentence"),
    [
        ("gone/a.svg", "there is no folder"),
        ("folder.svg", "it is a folder"),
        ("file/a.svg", "there is no folder"),
        (f"{'x' * 300}.svg", "ame too long"),
        ("/proc/a.svg", "No such file or directory"),
    ],
)
def test_where_no_picture_can_be_written_nothing_is_worked_out(casper, tmp_path, monkeypatch, place, sentence):
    pytest.importorskip("matplotlib")
    (tmp_path / "folder.svg").mkdir()
    (tmp_path / "file").write_text("")
    reads_never(monkeypatch)
    if place.startswith("/proc") and not os.path.isdir("/proc/self"):
        pytest.skip("needs a folder in which nobody can write")
    told = casper("explain", "kitchen", "eat", "--picture", str(tmp_path / place))
    refused(told)
    assert told.err.startswith("casper: cannot write ")
    assert sentence in told.err


@pytest.mark.parametrize("place", ["gone/movements.pl", "folder", "/proc/movements.pl"])
def test_where_no_movements_can_be_written_nothing_is_learned(casper, tmp_path, monkeypatch, place):
    pytest.importorskip("mujoco")
    pytest.importorskip("sklearn")
    (tmp_path / "folder").mkdir()
    learns_never(monkeypatch)
    if place.startswith("/proc") and not os.path.isdir("/proc/self"):
        pytest.skip("needs a folder in which nobody can write")
    told = casper("train", "kitchen", "--output", str(tmp_path / place))
    refused(told)
    assert "choose another place with --output" in told.err


def test_two_dollar_signs_in_a_picture_are_no_formula(casper, tmp_path):
    pytest.importorskip("matplotlib")
    (tmp_path / "plans.pl").write_text("goal(pay).\npay --> give('$\\\\frac{$'), 'take$_$'.\n")
    told = casper("explain", str(tmp_path), "'take$_$'", "--picture", str(tmp_path / "pay.svg"))
    assert (told.code, told.err) == (0, "")
    assert "give('$\\\\frac{$')" in (tmp_path / "pay.svg").read_text()


# --- training from recordings ---------------------------------------------------------------------------------------


def labelled(trials=2):
    """Lines of somebody who walks to a cup and takes it, a few times."""
    for trial in range(trials):
        for step in range(1, 17):
            x = min(-3.0 + 0.3 * step, 0.0)
            ann = {"x": x, "y": 0.0, "heading": 0.0, "holding": "cup" if step > 13 else None}
            state = {"t": step / 2, "agents": {"ann": ann}, "objects": {"cup": {"x": 0.3, "y": 0.0, "z": 0.8}}}
            yield json.dumps({**state, "movement": "walk" if x < 0 else "pick", "trial": trial, "level": f"eye {trial}"})


@pytest.mark.parametrize(("more", "relation"), [((), "movement(Mos, Hold, Qdc, Qtc, walk)"), (("--timed",), "likelihood(1, ")])
def test_train_learns_from_labelled_recordings(casper, tmp_path, more, relation):
    pytest.importorskip("sklearn")
    (tmp_path / "ann.jsonl").write_text("\n".join(labelled()))
    learned = tmp_path / "learned.pl"
    told = casper("train", "minimal", "--trace", str(tmp_path / "ann.jsonl"), *more, "--leaves", "2", "--output", str(learned), "--json")
    assert told.code == 0 and told.json[0]["samples"] == 30 and told.json[0]["trials"] == 2
    assert set(told.json[0]["per_level"]) == {"eye 0", "eye 1"} == set(told.json[0]["unseen_level"])
    assert relation in learned.read_text()


def test_train_tells_where_a_recording_is_wrong(casper, tmp_path):
    pytest.importorskip("sklearn")
    (tmp_path / "ann.jsonl").write_text("\n".join([*labelled(1), "{"]))
    told = casper("train", "minimal", "--trace", str(tmp_path / "ann.jsonl"), "--output", str(tmp_path / "learned.pl"))
    assert told.code == 2 and "ann.jsonl:17: this is not a line of JSON" in told.err and not (tmp_path / "learned.pl").exists()
