"""Files that a command learns: that one can be written is seen before anything is learned."""

from __future__ import annotations

from pathlib import Path

from casper.kb.errors import DomainError
from casper.kb.text.files import unwritable


def check_output(file: Path) -> None:
    """Refuse a place where nothing can be written.

    Raises:
        DomainError: why not, and what to do instead.
    """
    if (reason := unwritable(file)) is not None:
        raise _unwritten(file, reason)


def write_output(text: str, file: Path) -> None:
    """Write the text.

    Raises:
        DomainError: it cannot be written.
    """
    try:
        file.write_text(text, encoding="utf-8")
    except OSError as mistake:
        raise _unwritten(file, mistake.strerror or str(mistake)) from None


def _unwritten(file: Path, reason: str) -> DomainError:
    return DomainError(f"cannot write {file} ({reason}); choose another place with --output")
