"""Trials: a copy of the project, a mutant planted in it, and what the tests say."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterable
from pathlib import Path
from typing import TypeAlias

from mutations import Mutant

Tests: TypeAlias = tuple[str, ...]  # arguments of pytest

_LEFT_OUT = shutil.ignore_patterns(".*", "__pycache__", "*.egg-info", "dist", "build")
_OPTIONS = ("-x", "-q", "-p", "no:cacheprovider", "-p", "no:casper")
_NO_TESTS = 5  # pytest's exit code
_MEMORY = 6 << 30  # bytes that a run may map: a mutant must not eat the machine
_RUN = (
    "import resource, sys, pytest\n"
    f"resource.setrlimit(resource.RLIMIT_AS, ({_MEMORY}, {_MEMORY}))\n"
    "sys.exit(pytest.main(sys.argv[1:]))"
)


class FailingTests(Exception):
    """The tests fail without any mutant, so that they say nothing about one."""


class Trial:
    """A copy of the project that mutants are planted in, one at a time."""

    def __init__(self, root: Path, copy: Path, quick: bool = False) -> None:
        self.root, self.copy, self.quick = root, copy, quick
        shutil.copytree(root, copy, symlinks=True, ignore=_LEFT_OUT)
        self._limits: dict[Tests, float] = {}

    def prepare(self, paths: Iterable[str]) -> None:
        """Run the tests that mutants of these files will meet: they must pass, and say how long they take.

        Raises:
            FailingTests: they do not pass.
        """
        for tests in dict.fromkeys(tests for path in paths for tests in relevant_tests(self.root, path, self.quick)):
            if tests in self._limits:
                continue
            began = time.monotonic()
            failed = self.failure(tests, None)
            if failed is not None:
                raise FailingTests(f"the tests fail without a mutant already: {failed}")
            self._limits[tests] = 30 + 4 * (time.monotonic() - began)

    def verdict(self, mutant: Mutant) -> tuple[str, str]:
        """Whether the tests noticed the mutant, it survived, or time ran out; and the first test that failed."""
        original, place = self.root / mutant.path, self.copy / mutant.path
        place.write_bytes(mutant.planted(original.read_bytes()))
        try:
            for tests in relevant_tests(self.root, mutant.path, self.quick):
                failed = self.failure(tests, self._limits[tests], PYTHONDONTWRITEBYTECODE="1")
                if failed is not None:
                    return ("noticed" if failed else "timeout"), failed
            return "survived", ""
        finally:
            shutil.copy2(original, place)  # with its time stamp, so that the byte code of `prepare` stays good

    def failure(self, tests: Tests, seconds: float | None, **more: str) -> str | None:
        """The first test that fails, "" when time ran out, None when all pass."""
        chosen = {"HYPOTHESIS_PROFILE": "derandomised", "HYPOTHESIS_NO_PLUGINS": "1"}
        environment = os.environ | chosen | {"PYTHONPATH": str(self.copy / "src")} | more
        run = subprocess.Popen(
            [sys.executable, "-c", _RUN, *_OPTIONS, *tests],
            cwd=self.copy,
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )
        try:
            output, _ = run.communicate(timeout=seconds)
        except BaseException as reason:
            os.killpg(run.pid, signal.SIGKILL)  # the programs that tests started, too
            run.communicate()
            if not isinstance(reason, subprocess.TimeoutExpired):
                raise
            return ""
        if run.returncode in (0, _NO_TESTS):
            return None
        failed = re.search(r"^(?:FAILED|ERROR) (\S+)", output, re.MULTILINE)
        return failed[1] if failed else f"pytest ended with {run.returncode}: {output.strip()[-200:]}"


def relevant_tests(root: Path, path: str, quick: bool = False) -> list[Tests]:
    """The tests that matter to a file: those of its room, then, unless it should be quick, all of its package.

    A file beside the rooms has the tests that stand beside theirs.
    """
    package, *rooms = Path(path).parent.parts
    beside = [file.relative_to(root).as_posix() for file in sorted((root / "tests" / package).glob("test_*.py"))]
    room = [f"tests/{package}/{rooms[0]}"] if rooms else beside
    first = [tuple(room)] if room and (root / room[0]).exists() else []
    return first if quick and first else [*first, (f"tests/{package}",)]
