"""A visit to a page: its blocks run in order, in a folder of their own, and what they print is compared with the page.

    prolog    is read; with a title it is the file of that name from then on, or is added to it
    python    is run, all of a page in one scope; with prompts (>>>) what it shows is compared, too
    console   lines that begin with $ are commands, what stands below is what they print
    json      is read, line by line
    sh        installs: it must be a command of the README, or name extras that there are

Of what is printed a line that is only ⋮ stands for any lines, and … within a line for any text. Commands are run in this
process: ``casper`` itself, ``python FILE``, and the few words of `WORDS`; so a page takes the time of what it does.
"""

from __future__ import annotations

import contextlib
import doctest
import io
import json
import os
import re
import runpy
import shlex
import shutil
import sys
import tomllib
from pathlib import Path
from unittest import mock

from pages import ROOT

from casper.cli import main
from casper.kb.text.reader import read_text

EXTRAS = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["optional-dependencies"]
INSTALLING = re.findall(r"^```sh\n(.*)\n```$", (ROOT / "README.md").read_text(), re.M)
ANY_LINES, ANY_TEXT = "⋮", "…"
ADDED = "add to "  # before a file's name in a title


class Visit:
    """What a page has left behind so far: files in a folder, names in Python."""

    def __init__(self, folder):
        self.folder = folder
        self.scope = {"__name__": "__page__"}
        self.runs = {
            "prolog": self._prolog,
            "python": self._python,
            "console": self._console,
            "json": self._json,
            "sh": self._install,
            "copy": self._copy,
            "toml": self._file, "csv": self._file, "xml": self._file, "turtle": self._file, "pddl": self._file,
        }  # fmt: skip

    def run(self, block):
        """Do what a block says.

        Raises:
            AssertionError: it does something else than the page shows.
        """
        assert block.language in self.runs, (
            f"{block.place}: nobody runs {block.language}; say why, with <!-- not run: … -->"
        )
        with contextlib.chdir(self.folder):
            self.runs[block.language](block)

    # --- files and texts -------------------------------------------------------------------------------------------

    def _file(self, block):
        assert block.title, f"{block.place}: a file without a name"
        path, is_added = Path(block.title.removeprefix(ADDED)), block.title.startswith(ADDED)
        assert not path.is_absolute() and ".." not in path.parts
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text((path.read_text() if is_added else "") + block.text)

    def _copy(self, block):
        """A file of this repository, and where it is to lie."""
        for line in block.text.splitlines():
            source, target = line.split()
            shutil.copy(ROOT / source, target)

    def _prolog(self, block):
        assert read_text(block.text, block.place)
        if block.title:
            self._file(block)

    def _json(self, block):
        for line in block.text.splitlines():
            json.loads(line)
        if block.title:
            self._file(block)

    def _install(self, block):
        """Installing is not done here: the commands are those of the README, or name extras that there are."""
        for line in block.text.splitlines():
            extra = re.fullmatch(r"(?:\.venv/bin/)?pip install (?:-q )?'casper-hri\[(\w[\w,-]*)\]'.*", line)
            known = set(extra[1].split(",")) <= set(EXTRAS) if extra else line in INSTALLING
            assert known, f"{block.place}: {line} is no command of the README, and names no extra that there is"

    # --- Python ----------------------------------------------------------------------------------------------------

    def _python(self, block):
        if block.title:
            self._file(block)
        elif ">>> " in block.text:
            self._session(block)
        else:
            with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
                exec(compile("\n" * (block.line - 1) + block.text, block.page, "exec"), self.scope)

    def _session(self, block):
        session = doctest.DocTestParser().get_doctest(block.text, self.scope, block.page, block.page, block.line - 1)
        session.globs = self.scope  # what a session binds stays bound
        self.session(session)

    def session(self, session):
        """Hold what a session shows against what it does."""
        told = []
        runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
        assert runner.run(session, out=told.append, clear_globs=False).failed == 0, "".join(told)

    # --- commands --------------------------------------------------------------------------------------------------

    def _console(self, block):
        commands = re.split(r"^\$ ", block.text, flags=re.M)
        assert not commands[0].strip(), f"{block.place}: begins with no command"
        for command in commands[1:]:
            line, _, shown = command.partition("\n")
            code, out = self._typed(line)
            if shown.strip():
                self.compare(shown, out, f"{block.place}: $ {line}")
            else:
                assert code == 0, f"{block.place}: $ {line}: exit code {code}\n{out}"

    def compare(self, shown, printed, place):
        """Hold what is shown against what is printed."""
        assert_prints(shown, printed, place)

    def _typed(self, line):
        """The exit code and what is printed by a line of commands with pipes between them."""
        code, out = 0, ""
        for command in re.split(r" \| ", line):
            command, _, file = command.partition(" > ")
            words = shlex.split(command)
            assert words[0] in WORDS, f"nobody runs {words[0]}"
            code, out = WORDS[words[0]](words[1:], out)
            if file:
                Path(file.strip()).write_text(out)
                out = ""
        return code, out


def _in_process(arguments, run, given=""):
    """Exit code, and what was printed on both streams."""
    out = io.TextIOWrapper(io.BytesIO(), encoding="utf-8", write_through=True)
    patches = mock.patch.multiple(
        sys, argv=arguments, stdin=io.TextIOWrapper(io.BytesIO(given.encode())), stdout=out, stderr=out
    )
    with patches, mock.patch.dict(os.environ, {"COLUMNS": "120"}):
        try:
            run()
        except SystemExit as end:
            return int(end.code or 0), out.buffer.getvalue().decode()
    return 0, out.buffer.getvalue().decode()


def _casper(words, given):
    return _in_process(["casper", *words], main, given)


def _python(words, given):
    sys.path.insert(0, os.getcwd())
    try:
        return _in_process(words, lambda: runpy.run_path(words[0], run_name="__main__"), given)
    finally:
        sys.path.pop(0)


def _pytest(words, given):
    import subprocess

    environment = {**os.environ, "PYTHONPATH": str(ROOT / "src"), "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"}
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-p", "casper.testing.plugin", *words]
    done = subprocess.run(command, capture_output=True, text=True, env=environment)
    return done.returncode, done.stdout + done.stderr


def _ls(words, given):
    return 0, "".join(f"{name}\n" for name in sorted(os.listdir(*words)))


def _head(words, given):
    count = int(words[-1].lstrip("-n"))
    return 0, "".join(given.splitlines(keepends=True)[:count])


def _tail(words, given):
    count = int(words[-1].lstrip("-n"))
    return 0, "".join(given.splitlines(keepends=True)[-count:])


def _cat(words, given):
    return 0, "".join(Path(word).read_text() for word in words)


def _mkdir(words, given):
    Path(words[-1]).mkdir(parents=True)
    return 0, ""


WORDS = {
    "casper": _casper, ".venv/bin/casper": _casper, "python": _python, "pytest": _pytest,
    "ls": _ls, "head": _head, "tail": _tail, "cat": _cat, "mkdir": _mkdir,
}  # fmt: skip


def assert_prints(shown, printed, place):
    """What is printed is what is shown; ⋮ on a line of its own is any lines, … any text within a line.

    A line that ends in \\ goes on on the next one, as in a shell.
    """
    wanted = [line.rstrip() for line in shown.strip("\n").splitlines()]
    parts = [r"(?:.*\n)*?" if line.strip() == ANY_LINES else _pattern(line) + r"[ \t]*\n" for line in wanted]
    found = printed.rstrip("\n") + "\n"
    assert re.fullmatch("".join(parts) + r"\s*", found), f"{place} prints\n{found}"


def _pattern(line):
    return r"[^\n]*?".join(re.escape(part) for part in line.split(ANY_TEXT))
