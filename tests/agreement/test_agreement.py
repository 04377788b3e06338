"""The command that compares with SWI-Prolog: a line a kind, and a reason where it is not installed."""

import subprocess
import sys
from pathlib import Path

import pytest
from swi import needs_swi

HERE = Path(__file__).resolve().parent


def agreement(*arguments, **environment):
    return subprocess.run([sys.executable, str(HERE), *arguments], capture_output=True, text=True, env=environment or None)


@needs_swi
@pytest.mark.parametrize(
    ("kind", "what"),
    [
        ("circles", "programs with negation in circles"),
        ("sums", "programs with aggregates, lists and arithmetic"),
        ("terms", "terms read and written"),
    ],
)
def test_a_line_says_how_many_mean_the_same(kind, what):
    done = agreement(kind, "--count", "5", "--seed", "3")
    assert done.returncode == 0, done.stdout + done.stderr
    (line,) = done.stdout.splitlines()
    assert line.startswith(f"5 {what} (seed 3): ") and "0 disagree" in line


def test_without_swi_prolog_the_reason_is_given(tmp_path):
    done = agreement(PATH=str(tmp_path))
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == "SWI-Prolog (swipl) is not installed, so there is nothing to compare with\n"


def test_an_unknown_kind_is_refused():
    done = agreement("songs")
    assert done.returncode == 2 and "songs is none of circles, sums, terms" in done.stderr
