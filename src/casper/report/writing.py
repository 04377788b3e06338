"""The page as a file: that it can be written is seen before anything is simulated, not after."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from casper.engine.domain.domain import Domain
from casper.kb.errors import CasperError
from casper.kb.text.files import check_writable
from casper.report.page import page_of
from casper.report.recorder import Recorder
from casper.report.recording import Recording


@contextmanager
def reporting(domain: Domain, path: Path | None) -> Iterator[Recorder | None]:
    """A recorder whose page is written at the end, also when the run is broken off; None where no page is asked for.

    Raises:
        CasperError: as `check_page`, before anything is recorded, and as `write_page`.
    """
    if path is None:
        yield None
        return
    check_page(path)
    recorder = Recorder(domain)
    try:
        yield recorder
    finally:
        write_page(recorder.recording(), path)


def check_page(path: Path) -> None:
    """Refuse a file to which no page can be written.

    Raises:
        CasperError: another ending than .html, no such folder, a place where writing is not allowed.
    """
    if path.suffix.lower() not in (".html", ".htm"):
        raise CasperError(f"a report is a page, such as {path.stem or 'run'}.html, not {path.name}")
    check_writable(path)


def write_page(recording: Recording, path: Path) -> None:
    """Write the page of a recording.

    Raises:
        CasperError: it cannot be written.
    """
    try:
        path.write_text(page_of(recording), encoding="utf-8")
    except OSError as mistake:
        raise CasperError(f"cannot write {path} ({mistake.strerror or mistake})") from None
