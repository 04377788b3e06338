"""Arrows between rooms point one way only, and the linter that says so would notice one that does not."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
LINT = (
    "import sys; sys.path.insert(0, 'src'); from importlinter.cli import lint_imports; "
    "sys.exit(lint_imports(no_cache=True))"
)
ROOMS = ("kb", "plans", "engine", "sim_adapter", "src/casper/cli", "src/casper/notebook", "src/casper/report", "src/casper/experiments", "src/casper/batch", "src/casper/qsr", "src/casper/streams")
MOST = 14  # entries beside __init__.py: about a dozen


@pytest.mark.parametrize(
    ("file", "planted", "said"),
    [
        ("kb/errors.py", "from casper.plans.library import PlanLibrary", "casper.kb is not allowed to import casper.plans"),
        ("kb/terms/terms.py", "from casper.kb.base import KnowledgeBase", "casper.kb.terms is not allowed to import"),
        ("engine/perception/world.py", "from casper.engine.mind import Mind", "casper.engine.perception is not allowed"),
        ("plans/trees/chart.py", "from casper.plans.trees.plan import Plan", "No cycles are allowed in casper.plans.trees"),
        ("engine/actions/fsm.py", "from casper.engine.actions.hmm import HmmModel", "No cycles are allowed in casper.engine.actions"),
    ],
)
def test_an_import_against_the_arrows_is_refused_even_inside_a_function(tmp_path, file, planted, said):
    shutil.copytree(ROOT / "src", tmp_path / "src", ignore=shutil.ignore_patterns("__pycache__"))  # links become folders
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    with (tmp_path / "src" / "casper" / file).open("a") as text:
        text.write(f"\n\ndef planted():\n    {planted}\n")
    done = subprocess.run([sys.executable, "-c", LINT], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 1
    assert said in " ".join(done.stdout.split())


@pytest.mark.parametrize("room", ROOMS)
def test_no_room_is_crowded_and_each_says_what_it_is_for(room):
    for folder in [ROOT / room, *(f for f in (ROOT / room).rglob("*") if f.is_dir() and f.name != "__pycache__")]:
        entries = [f for f in folder.iterdir() if f.name not in ("__pycache__", "__init__.py")]
        assert len(entries) <= MOST, folder
        assert (folder / "__init__.py").read_text().startswith('"""'), folder
