"""The door of casper.planning: what it offers is loaded when it is used, and a missing extra is one sentence."""

import subprocess
import sys
from pathlib import Path

import pytest

SRC = Path(__file__).resolve().parents[2] / "src"


def run(code):
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env={"PYTHONPATH": str(SRC)})
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


def without(name, code):
    return run(
        "import sys\nfrom importlib.machinery import PathFinder\n"
        f"class Missing:\n    def find_spec(self, name, path=None, target=None):\n"
        f"        if name.split('.')[0] == {name!r}: raise ModuleNotFoundError(name)\n"
        "sys.meta_path.insert(0, Missing())\n"
        f"import importlib.util\nfound = importlib.util.find_spec\n"
        f"importlib.util.find_spec = lambda name, package=None: None if name == {name!r} else found(name, package)\n"
        f"{code}"
    )


def test_without_the_framework_each_name_says_what_to_install():
    names = ["from_problem", "to_problem", "remainder", "import_files"]
    code = f"import casper.planning\nfor name in {names}:\n  try: getattr(casper.planning, name)\n  except Exception as e: print(e)"
    wanted = "casper.planning.{} needs Unified Planning: pip install 'casper-hri[planning]'"
    assert without("unified_planning", code).splitlines() == [wanted.format(name) for name in names]


def test_behaviour_trees_need_py_trees_only():
    without("unified_planning", "from casper.planning import behaviour_tree")
    said = without("py_trees", "import casper.planning\ntry: casper.planning.behaviour_tree\nexcept Exception as e: print(e)")
    assert said == "behaviour trees need py_trees: pip install 'casper-hri[behaviour-trees]'"


def test_every_name_that_is_offered_is_there():
    pytest.importorskip("unified_planning")
    import casper.planning

    for name in casper.planning.__all__:
        assert getattr(casper.planning, name) is not None
