"""The file: that it can be written is seen before anything is simulated, not after."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path

from casper.engine.domain.domain import Domain
from casper.kb.errors import CasperError
from casper.kb.text.files import check_writable
from casper.rrd.log import Log


@contextmanager
def logging(domain: Domain, path: Path | None) -> Iterator[Log | None]:
    """A log that writes to the file as it hears; None where no file is asked for. Broken off, it holds what it heard.

    Raises:
        CasperError: as `check_rrd`, before anything is written.
    """
    if path is None:
        yield None
        return
    check_rrd(path)
    log = Log(domain, path)
    try:
        yield log
    finally:
        log.close()


def check_rrd(path: Path) -> None:
    """Refuse a file to which nothing can be recorded.

    Raises:
        CasperError: another ending than .rrd, a place where writing is not allowed, no rerun-sdk.
    """
    if path.suffix.lower() != ".rrd":
        better = f"{path.stem or 'run'}.rrd"
        raise CasperError(f"a recording for Rerun is written as .rrd, such as {better}, not as {path.name}")
    check_writable(path)
    if find_spec("rerun") is None:
        raise CasperError("this needs rerun-sdk, which is not installed: pip install 'casper-hri[rerun]'")
