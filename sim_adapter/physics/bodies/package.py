"""The package that TIAGo's model comes with: where it is, and what to type where it is not there."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

from casper.kb.errors import CasperError

PACKAGE = "robosuite"
LEAST = ">=1.5"  # versions before have no TIAGo
INSTALL = f"pip install --no-deps '{PACKAGE}{LEAST}'"
FILE = Path("models", "assets", "robots", "tiago", "robot.xml")


def model_file() -> Path:
    """Where the model is; the package is not imported, so what it needs itself may be missing.

    Raises:
        CasperError: it is not installed, or has no such model.
    """
    found = find_spec(PACKAGE)
    folders = [] if found is None else list(found.submodule_search_locations or ())
    if not folders:
        raise CasperError(f"TIAGo's model comes with {PACKAGE}, which is not installed: {INSTALL}")
    file = Path(folders[0]) / FILE
    if not file.is_file():
        raise CasperError(f"there is no TIAGo in {folders[0]} ({FILE} is missing): {INSTALL}")
    return file
