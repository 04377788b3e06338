"""The versions of Python that are promised: the text of every file compiles with each of those that are here."""

import ast
import json
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
OURS = ("kb", "plans", "engine", "sim_adapter", "src/casper/cli", "tests", "benchmarks")
SOURCES = sorted({*(f for room in OURS for f in (ROOT / room).rglob("*.py")), *(ROOT / "src/casper").glob("*.py")})
OLDEST = (3, 11)
COMPILE = """
import json, sys, warnings
warnings.simplefilter("error")
for file in json.load(sys.stdin):
    with open(file, encoding="utf-8") as text:
        compile(text.read(), file, "exec")
print(sys.version_info[:2])
"""


def promised():
    """The versions in the classifiers."""
    lines = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["classifiers"]
    found = [line.rpartition(" :: ")[2] for line in lines if line.startswith("Programming Language :: Python :: 3.")]
    return [tuple(map(int, version.split("."))) for version in found]


def test_the_promises_of_the_distribution_and_of_the_readme_agree():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    assert project["requires-python"] == f">={OLDEST[0]}.{OLDEST[1]}"
    assert min(promised()) == OLDEST
    assert f"Python {OLDEST[0]}.{OLDEST[1]} or newer" in (ROOT / "README.md").read_text()


@pytest.mark.parametrize("file", SOURCES, ids=lambda f: str(f.relative_to(ROOT)))
def test_a_file_is_written_in_the_syntax_of_the_oldest_version(file):
    ast.parse(file.read_text(encoding="utf-8"), feature_version=OLDEST)


@pytest.mark.parametrize("version", sorted({*promised(), (3, 14)}), ids=lambda v: f"{v[0]}.{v[1]}")
def test_every_file_compiles_without_a_warning(version):
    name = f"python{version[0]}.{version[1]}"
    interpreter = sys.executable if sys.version_info[:2] == version else shutil.which(name)
    if interpreter is None:
        pytest.skip(f"there is no {name} here")
    command, files = [interpreter, "-c", COMPILE], json.dumps([str(file) for file in SOURCES])
    done = subprocess.run(command, input=files, capture_output=True, text=True)
    if done.returncode == 127:  # a stand-in for an interpreter that is not installed
        pytest.skip(f"{name} is here in name only")
    assert (done.returncode, done.stdout.strip()) == (0, str(version)), done.stderr
