"""Who follows the tutorial to the letter has a robot that helps, in a room they drew themselves.

The thorough profile does what a reader does: a fresh clone, the README's command, the page from its first line to its
last, each command by a shell. Otherwise the page is visited as every other one (`test_pages.py`).
"""

import os
import subprocess

import pytest
from pages import DOCS, ROOT, blocks_of
from visits import INSTALLING, Visit, assert_prints

PAGE = DOCS / "tutorial.md"
THOROUGH = os.environ.get("HYPOTHESIS_PROFILE") == "thorough"


class Reader(Visit):
    """Somebody at a terminal, with what the README's command has installed and nothing else."""

    def __init__(self, folder, programs):
        super().__init__(folder)
        kept = {key: value for key, value in os.environ.items() if key in ("HOME", "LANG", "LC_ALL")}
        self.environment = {**kept, "PATH": f"{programs}:/usr/bin:/bin", "PYTHONUTF8": "1"}

    def _typed(self, line):
        done = subprocess.run(
            ["bash", "-c", line], cwd=self.folder, env=self.environment, capture_output=True, text=True
        )
        return done.returncode, done.stdout + done.stderr


def test_the_tutorial_needs_nothing_but_the_package():
    used = {block.language for block in blocks_of(PAGE)}
    assert used == {"prolog", "console"}
    assert not any(block.why for block in blocks_of(PAGE))
    words = {line.split()[1] for b in blocks_of(PAGE) for line in b.text.splitlines() if line.startswith("$ ")}
    assert words <= {"casper", "mkdir"}


def test_a_domain_with_a_room_is_small():
    texts = {block.title: block.text for block in blocks_of(PAGE) if block.title.endswith(("scene.pl", "actions.pl"))}
    assert sum(bool(line.strip()) for text in texts.values() for line in text.splitlines()) <= 25


@pytest.mark.skipif(not THOROUGH, reason="installs the package anew: HYPOTHESIS_PROFILE=thorough")
def test_in_a_fresh_clone_every_line_does_what_it_says(tmp_path):
    subprocess.run(["git", "clone", "-q", str(ROOT), str(tmp_path / "clone")], check=True)
    (first, _) = INSTALLING
    done = subprocess.run(["bash", "-c", first], cwd=tmp_path / "clone", capture_output=True, text=True)
    assert done.returncode == 0 and "human wanted lunch; predicted lunch" in done.stdout, done.stderr
    (tmp_path / "mine").mkdir()
    reader = Reader(tmp_path / "mine", tmp_path / "clone" / ".venv" / "bin")
    for block in blocks_of(PAGE):
        reader.run(block)
    code, out = reader._typed("casper run tearoom --goal tea --seed 2 | tail -n 2")
    assert code == 0
    shown = "⋮\n… mia wanted tea; predicted tea at …: right\n        rob's part (…) is finished"
    assert_prints(shown, out, "another seed")
