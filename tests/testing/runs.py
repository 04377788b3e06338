"""Runs of pytest in another process, as a foreign project has them; all of them in one, for its start costs the most.

As a program: reads arguments of runs from its input, as JSON, and writes what came of each.
"""

import io
import json
import subprocess
import sys
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from importlib.metadata import entry_points

import pytest


@dataclass(frozen=True)
class Run:
    """The exit code, what each test that failed said, and all that was printed."""

    code: int
    failed: dict[str, str]
    printed: str

    def found(self, words: str, where: str) -> bool:
        """Whether a test of that file or folder failed with these words."""
        return self.code == 1 and any(words in said for name, said in self.failed.items() if where in name)


def run_all(runs: dict[str, list[str]], folder: str) -> dict[str, Run]:
    """Each run of pytest, by its name."""
    command = [sys.executable, __file__]
    done = subprocess.run(command, input=json.dumps(runs), capture_output=True, text=True, cwd=folder, timeout=600)
    assert done.returncode == 0, done.stderr
    return {name: Run(**found) for name, found in json.loads(done.stdout).items()}


class _Failures:
    def __init__(self) -> None:
        self.told: dict[str, str] = {}

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.failed:
            self.told[report.nodeid] = report.longreprtext


def _ran(arguments: list[str]) -> dict[str, object]:
    installed = any(point.name == "casper" for point in entry_points(group="pytest11"))
    plugin = [] if installed else ["-p", "casper.testing.plugin"]
    printed, failures = io.StringIO(), _Failures()
    with redirect_stdout(printed), redirect_stderr(printed):
        code = pytest.main([*plugin, "-q", "-p", "no:cacheprovider", *arguments], plugins=[failures])
    return {"code": int(code), "failed": failures.told, "printed": printed.getvalue()}


if __name__ == "__main__":
    json.dump({name: _ran(arguments) for name, arguments in json.load(sys.stdin).items()}, sys.stdout)
