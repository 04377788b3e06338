"""What is installed of what the package can use: read from the package's own metadata, so that no list grows old."""

from __future__ import annotations

import locale
import platform
import re
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from importlib import import_module
from importlib.metadata import PackageNotFoundError, distribution, packages_distributions, requires
from pathlib import Path
from typing import Any

import casper
from casper.engine.perception.filters import handling
from casper.sim_adapter.physics.bodies.package import INSTALL, LEAST
from casper.sim_adapter.physics.bodies.package import PACKAGE as ROBOSUITE

PACKAGE = "casper-hri"
PURPOSES: Mapping[str, str] = {
    "": "everything but what is below",
    "sim": "casper run; examples in a room",
    "video": "casper run --video",
    "rerun": "casper run --rerun, casper watch --rerun",
    "train": "casper train",
    "plot": "casper explain --picture",
    "tables": "casper batch with .parquet; pandas and Arrow in Python",
    "fast": "lines of JSON are read four times as fast (casper watch, batch, replay)",
    "batch": "casper batch and casper experiment with --jobs and --cluster",
    "experiments": "casper experiment",
    "owl": "casper import of ontologies",
    "mcap": "casper import of .mcap, recordings of ROS 2",
    "planning": "casper import of .pddl and .hddl; casper.planning",
    "behaviour-trees": "casper.planning.behaviour_tree",
    "testing": "pytest --casper-domain; casper.testing",
    "lsp": "casper lsp, for editors",
    "notebook": "%load_ext casper in a notebook",
}
"""What each extra is for. Extras that are for developers of the package alone are not told."""

BESIDE: Mapping[str, tuple[str, str, str, str]] = {
    "tiago": ("casper run --robot tiago, the model of TIAGo++", ROBOSUITE, LEAST, INSTALL),
}
"""What no extra brings, since only data of it are read: what it is for, the library, its bounds, what to type."""

_REQUIREMENT = re.compile(r"([A-Za-z0-9][A-Za-z0-9._-]*)\s*(?:\[[^\]]*\])?\s*\(?([^;)]*)\)?\s*(?:;(.*))?")
_EXTRA = re.compile(r"extra\s*==\s*['\"]([^'\"]+)['\"]")
_BOUND = re.compile(r"(>=|<=|==|!=|<|>|~=)\s*([0-9][0-9.]*)")


@dataclass(frozen=True, slots=True)
class Library:
    """A library, its version (empty: it is not there), and what is wrong with it, if anything."""

    name: str
    version: str = ""
    wrong: str = ""


@dataclass(frozen=True, slots=True)
class Extra:
    """A part that is installed by itself; the one without a name is the package's core."""

    name: str
    purpose: str
    libraries: tuple[Library, ...]
    install: str = ""  # what to type where no extra of ours brings it

    @property
    def is_there(self) -> bool:
        """Whether every library of it is."""
        return all(library.version for library in self.libraries)

    def to_json(self) -> dict[str, Any]:
        """``{"extra", "for", "installed", "libraries": [{"name", "version", "wrong"}]}``."""
        libraries = [{"name": x.name, "version": x.version or None, "wrong": x.wrong or None} for x in self.libraries]
        return {"extra": self.name, "for": self.purpose, "installed": self.is_there, "libraries": libraries}


def survey(thorough: bool = False) -> list[Extra]:
    """The core, every extra and what is beside them, with what is installed of it; ``thorough`` imports the extras."""
    wanted = requirements(requires_of())
    extras = [
        Extra(name, purpose, tuple(_library(*each, thorough) for each in sorted(wanted.get(name, {}).items())))
        for name, purpose in PURPOSES.items()
        if name in wanted
    ]
    beside = [
        Extra(name, purpose, (_library(library, bounds, thorough=False),), install)
        for name, (purpose, library, bounds, install) in BESIDE.items()
    ]
    return [*extras, *beside]


def requires_of() -> list[str]:
    """What the package requires, as its metadata has it; nothing where it is run without being installed."""
    try:
        return requires(PACKAGE) or []
    except PackageNotFoundError:
        return []


def requirements(lines: list[str]) -> dict[str, dict[str, str]]:
    """By extra ('' for the core) the bounds of each library: ``{"sim": {"mujoco": ">=3.17,<5"}}``."""
    found: dict[str, dict[str, str]] = {}
    for text in lines:
        read = _REQUIREMENT.fullmatch(text.strip())
        if read is not None and read[1].lower() != PACKAGE:
            extra = _EXTRA.search(read[3] or "")
            found.setdefault("" if extra is None else extra[1], {})[read[1]] = read[2].strip()
    return found


def surroundings() -> dict[str, str]:
    """Where it runs: versions, the platform, the encoding of the output."""
    return {
        "casper": f"{casper.__version__} in {Path(casper.__file__).parent}{', compiled' if is_compiled() else ''}",
        "Python": f"{platform.python_version()} ({sys.executable})",
        "platform": platform.platform(),
        "output": f"{getattr(sys.stdout, 'encoding', None) or locale.getpreferredencoding(False)}",
    }


def is_compiled() -> bool:
    """Whether minds run compiled (``hatch_build.py``)."""
    return not str(handling.__file__).endswith(".py")


def too_old(version: str, bounds: str) -> str:
    """Why a version is none that the package works with; empty where it is."""
    for sign, wanted in _BOUND.findall(bounds):
        have, need = _numbers(version), _numbers(wanted)
        if (sign == ">=" and have < need) or (sign == "<" and have >= need):
            return f"{sign}{wanted} is needed"
    return ""


def _numbers(version: str) -> tuple[int, ...]:
    return tuple(int(part) for part in re.findall(r"\d+", version.split("+")[0])[:3])


def _library(name: str, bounds: str, thorough: bool) -> Library:
    try:
        version = distribution(name).version
    except PackageNotFoundError:
        return Library(name)
    wrong = too_old(version, bounds)
    if thorough and not wrong:
        wrong = next(_failures(name), "")
    return Library(name, version, wrong)


def _failures(name: str) -> Iterator[str]:
    """What goes wrong when the library's modules are imported."""
    wanted = re.sub(r"[-_.]+", "-", name).lower()
    for module, owners in packages_distributions().items():
        if not module.startswith("_") and wanted in {re.sub(r"[-_.]+", "-", owner).lower() for owner in owners}:
            try:
                import_module(module)
            except Exception as mistake:  # whatever it is: it does not work
                yield f"cannot be imported ({type(mistake).__name__}: {mistake})".splitlines()[0]
