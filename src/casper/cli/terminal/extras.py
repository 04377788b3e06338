"""Optional parts: a missing library is one sentence with the command that brings it."""

from __future__ import annotations

from importlib.util import find_spec

from casper.kb.errors import CasperError


def needs(module: str, extra: str) -> None:
    """Make sure that an optional library is there.

    Raises:
        CasperError: it is not; the sentence says what to install.
    """
    if find_spec(module) is None:
        raise CasperError(f"this needs {module}, which is not installed: pip install 'casper-hri[{extra}]'")
