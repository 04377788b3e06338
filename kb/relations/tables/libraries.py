"""Libraries that are needed only by those who use them."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from casper.kb.errors import CasperError


def needed(name: str) -> Any:
    """The library of that name.

    Raises:
        CasperError: it is not installed; the sentence says how to get it.
    """
    try:
        return import_module(name)
    except ImportError:
        raise CasperError(f"{name} is not installed: pip install 'casper-hri[tables]'") from None
