"""A foreign project, as its author has it: python benchmarks/foreign_project.py [FOLDER].

A wheel is built of this tree and installed with ``[testing]`` into a fresh virtual environment. There a project with a
domain of its own, outside this tree, subclasses the contract. Bugs are planted in its domain one at a time, and each is
looked for twice: by the contract, and by ``pytest --casper-domain`` alone, without a line of Python. What is told is
the bug's own counterexample and the seconds of each run, with pytest's start. It fails where the contract misses a bug,
needs more than ten seconds of the processor, or tells one with more than three facts or two actions.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.append(str(ROOT / "tests" / "testing"))
from home import BUGS, SUITE, home  # noqa: E402

SECONDS, MOST_FACTS, MOST_ACTIONS = 10.0, 3, 2
TOLD = {  # what the counterexample looks like: statements in it are counted
    "a rule too weak": r"boil\(ann, mug\)[^\n]*",
    "a rule too strong": r"nobody can do step 3, sip\(tea, mug\): mug is not glass",
    "a plan with swapped steps": r"nobody can do step 1, brew\(tea, mug\)[^\n]*",
    "a constraint that never fires": r'[^\n]*never fires: "tea is for the mug"[^\n]*',
    "a goal that hides another": r"rinse is hidden by clean: seen wash\(mug\)[^\n]*",
}


def environment(folder: Path) -> Path:
    """The Python of a fresh environment with the wheel and ``[testing]`` in it."""
    build = [sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", str(folder / "dist"), str(ROOT)]
    subprocess.run(build, check=True, capture_output=True)
    (wheel,) = (folder / "dist").glob("*.whl")
    subprocess.run([sys.executable, "-m", "venv", str(folder / "venv")], check=True)
    python = folder / "venv" / "bin" / "python"
    subprocess.run([str(python), "-m", "pip", "install", "-q", f"{wheel}[testing]"], check=True)
    return python


def run(python: Path, place: Path, *arguments: str) -> tuple[int, str, float, float]:
    """Exit code and output of a run of pytest, with its seconds of the processor and of the clock."""
    clean = {key: value for key, value in os.environ.items() if not key.startswith(("PYTHON", "CASPER"))}
    begin, start = os.times(), time.monotonic()
    command = [str(python), "-m", "pytest", "-q", "-p", "no:cacheprovider", "--casper-profile", "quick", *arguments]
    done = subprocess.run(command, capture_output=True, text=True, cwd=place, env=clean)
    end = os.times()
    used = end.children_user + end.children_system - begin.children_user - begin.children_system
    return done.returncode, done.stdout + done.stderr, used, time.monotonic() - start


def is_short(told: str) -> bool:
    """Whether no more is in it than a person wants to read: each statement with arguments is a fact or an action."""
    return len(re.findall(r"\b[a-z_]+\([a-z_, ]*\)", told)) <= max(MOST_FACTS, MOST_ACTIONS)


def main(folder: Path) -> int:
    python, place = environment(folder), folder / "project"
    place.mkdir()
    failed, alone = 0, 0
    for number, bug in enumerate([None, *BUGS]):
        own = place / f"domain{number}" / "home"
        own.mkdir(parents=True)
        home(own, bug)
        suite = own.parent / "test_home.py"
        suite.write_text(SUITE.format(folder=str(own)), encoding="utf-8")
        code, said, used, took = run(python, own.parent, str(suite))
        plugin_code, plugin_said, plugin_used, _ = run(python, own.parent, "--casper-domain", str(own), str(own))
        if bug is None:
            good = code == 0 and plugin_code == 0
            print(f"without a bug: {'nothing is found' if good else said + plugin_said}  ({used:.1f} s)")
            failed += not good
            continue
        found = re.search(TOLD[bug], said) if code == 1 else None
        by_plugin = plugin_code == 1 and re.search(TOLD[bug], plugin_said) is not None
        alone += by_plugin
        kept = found is not None and used <= SECONDS and is_short(found[0])
        failed += not kept
        print(f"{bug}: {'found' if kept else 'NOT KEPT'} in {used:.1f} s of the processor ({took:.1f} s by the clock)")
        print(f"  {found[0].strip() if found else said}")
        print(f"  by the plugin alone: {f'found in {plugin_used:.1f} s' if by_plugin else 'no'}")
    print(f"{len(BUGS)} bugs; the plugin alone finds {alone}")
    return 1 if failed or alone < 3 else 0


if __name__ == "__main__":
    if len(sys.argv) > 1:
        Path(sys.argv[1]).mkdir(parents=True)
        sys.exit(main(Path(sys.argv[1]).resolve()))
    with tempfile.TemporaryDirectory() as made:
        sys.exit(main(Path(made)))
