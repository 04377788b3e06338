"""The wheel holds every file of the packages: most packaging mistakes build an empty one and say it went well."""

import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
PACKAGES = ("kb", "plans", "engine", "sim_adapter", "domains")
DOORS = (  # rooms of src/casper itself
    "cli", "server", "batch", "planning", "qsr", "testing", "notebook", "report", "rrd", "lsp", "streams", "experiments",
)  # fmt: skip


def tree() -> set[str]:
    """What the wheel must hold, by its name there."""
    ours = [f for package in PACKAGES for f in (ROOT / package).rglob("*") if f.is_file()]
    expected = {f"casper/{f.relative_to(ROOT)}" for f in ours if "__pycache__" not in f.parts}
    source = ROOT / "src/casper"
    found = (f for room in DOORS for f in (source / room).rglob("*"))
    doors = [f for f in found if f.is_file() and "__pycache__" not in f.parts]
    for f in [*source.glob("*.py"), source / "py.typed", *doors]:
        expected.add(f"casper/{f.relative_to(source)}")
    return expected


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("dist")
    command = [sys.executable, "-m", "build", "--no-isolation", "--outdir", str(folder), str(ROOT)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr + done.stdout
    return folder


@pytest.mark.xdist_group("packaging")
def test_the_wheel_built_from_the_sdist_holds_exactly_the_tree(built: Path) -> None:
    (wheel,) = built.glob("*.whl")
    names = {n for n in zipfile.ZipFile(wheel).namelist() if n.startswith("casper/")}
    assert names == tree()


@pytest.mark.xdist_group("packaging")
def test_the_sdist_holds_the_tests_and_the_changelog(built: Path) -> None:
    (sdist,) = built.glob("*.tar.gz")
    with tarfile.open(sdist) as archive:
        names = {n.split("/", 1)[1] for n in archive.getnames() if "/" in n}
    assert {"tests/test_packaging.py", "CHANGELOG.md", "LICENSE", "kb/text/parsing/parser.py"} <= names


HEAVY = {"networkx", "sklearn", "mujoco", "numpy", "matplotlib", "rich", "rdflib", "pandas"}
EXTRAS = {"unified_planning", "py_trees", "hypothesis", "pytest", "joblib", "dask", "pyarrow", "pygls"}


def loaded(code: str) -> set[str]:
    """The modules that are there after some code in a process of its own."""
    command = [sys.executable, "-c", f"{code}\nimport sys; print(*sys.modules)"]
    return set(subprocess.run(command, capture_output=True, text=True, check=True).stdout.split())


def test_importing_casper_pulls_in_no_heavy_library_and_no_extra() -> None:
    assert loaded("import casper") & (HEAVY | EXTRAS) == set()


def test_loading_a_domain_pulls_in_no_heavy_library_and_no_extra() -> None:
    assert loaded("from casper import Domain, Mind; Mind(Domain.load('kitchen'))") & (HEAVY | EXTRAS) == set()


@pytest.mark.parametrize("package", PACKAGES)
def test_a_package_is_importable_only_under_casper(package: str) -> None:
    linked = ROOT / "src/casper" / package
    assert linked.is_symlink() and linked.resolve() == ROOT / package
