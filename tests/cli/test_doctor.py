"""``casper doctor``: what is installed, what is missing for which command, and what to type."""

import tomllib
from importlib.metadata import PackageNotFoundError
from pathlib import Path
from types import SimpleNamespace

import pytest

from casper.cli.authoring import installed
from casper.cli.authoring.installed import PURPOSES, requirements, too_old

PROJECT = tomllib.loads((Path(__file__).resolve().parents[2] / "pyproject.toml").read_text())["project"]
FOR_DEVELOPERS = {"dev", "peers", "docs"}


@pytest.fixture
def machine(monkeypatch):
    """A machine with some libraries: their versions by name."""
    versions = {"rich": "15.0", "mujoco": "4.0.0", "joblib": "1.0.9"}
    lines = [
        "rich>=13",
        "mujoco<5,>=3.17; extra == 'sim'",
        "joblib>=1.3; extra == 'batch'",
        "rdflib<8,>=7.1; extra == 'owl'",
    ]

    def distribution(name):
        if name not in versions:
            raise PackageNotFoundError(name)
        return SimpleNamespace(version=versions[name])

    monkeypatch.setattr(installed, "distribution", distribution)
    monkeypatch.setattr(installed, "requires_of", lambda: lines)
    return versions


def test_every_extra_that_users_install_says_what_it_is_for():
    assert set(PURPOSES) - {""} == set(PROJECT["optional-dependencies"]) - FOR_DEVELOPERS


def test_what_is_there_and_what_is_missing_is_told_with_the_line_to_type(casper, machine):
    machine["joblib"] = "1.6.0"
    told = casper("doctor")
    assert told.code == 0
    assert "✔ sim " in told.out and "mujoco 4.0.0" in told.out
    assert "○ owl " in told.out and "rdflib missing" in told.out
    assert "-m pip install 'casper-hri[owl]'" in told.out


def test_what_is_too_old_is_a_fault(casper, machine):
    told = casper("doctor")
    assert told.code == 1 and "joblib 1.0.9: >=1.3 is needed" in told.out


def test_json_has_one_object_an_extra(casper, machine):
    rows = {row["extra"]: row for row in casper("doctor", "--json").json if "extra" in row}
    assert rows["owl"]["installed"] is False and rows["sim"]["libraries"][0]["version"] == "4.0.0"


def test_a_library_that_cannot_be_imported_is_a_fault(casper, machine, monkeypatch):
    machine["joblib"] = "1.6.0"
    monkeypatch.setattr(installed, "packages_distributions", lambda: {"no_such_module": ["mujoco"]})
    told = casper("doctor", "--thorough")
    assert told.code == 1 and "cannot be imported (ModuleNotFoundError" in told.out


def test_bounds_are_read_from_what_the_package_requires():
    lines = [
        "numpy>=1.26",
        "mujoco<5,>=3.17; extra == 'sim'",
        'dask[distributed] (>=2024.1) ; extra == "batch"',
        "casper-hri[sim]; extra == 'train'",
    ]
    assert requirements(lines) == {
        "": {"numpy": ">=1.26"},
        "sim": {"mujoco": "<5,>=3.17"},
        "batch": {"dask": ">=2024.1"},
    }


@pytest.mark.parametrize(
    ("version", "bounds", "wrong"),
    [
        ("3.17.0", ">=3.17,<5", ""),
        ("3.9", ">=3.17,<5", ">=3.17 is needed"),
        ("5.0", "<5,>=3.17", "<5 is needed"),
        ("2.0rc1+cpu", ">=1", ""),
    ],
)
def test_a_version_is_held_against_its_bounds(version, bounds, wrong):
    assert too_old(version, bounds) == wrong


def test_an_editor_without_its_library_is_told_what_to_install(casper, monkeypatch):
    monkeypatch.setattr("casper.cli.terminal.extras.find_spec", lambda module: None)
    told = casper("lsp", "--stdio")
    assert told.code == 2
    assert told.err == "casper: this needs pygls, which is not installed: pip install 'casper-hri[lsp]'\n"


def test_what_no_extra_brings_has_a_line_of_its_own_to_type(casper, machine):
    machine["joblib"] = "1.6.0"
    told = casper("doctor").out
    assert "○ tiago " in told and "robosuite missing" in told
    assert "-m pip install --no-deps 'robosuite>=1.5'" in told
    assert "tiago" not in told.splitlines()[-1]  # the line that installs all extras


def test_a_package_that_is_older_than_its_model_is_a_fault(casper, machine):
    machine |= {"joblib": "1.6.0", "robosuite": "1.4.1"}
    told = casper("doctor")
    assert told.code == 1 and "robosuite 1.4.1: >=1.5 is needed" in told.out
