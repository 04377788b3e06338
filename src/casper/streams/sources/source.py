"""A source by its name: ``-``, a file, or ``tcp://host:port``."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Protocol

from casper.kb.errors import CasperError
from casper.streams.items import Line, Note
from casper.streams.sources.files import File, Standard
from casper.streams.sources.sockets import SCHEME, Socket


class Source(Protocol):
    """Where lines come from.

    is_live: whether waiting for late states costs time. lost: whether it ended too soon, known at its end.
    """

    @property
    def is_live(self) -> bool: ...

    @property
    def lost(self) -> bool: ...

    def items(self) -> Iterator[Line | Note]:
        """Its lines, once."""
        ...


def source_of(
    name: str = "-", listens: bool = False, reconnect: float = 0.0, tell: Callable[[str], object] = bool
) -> Source:
    """What a name on the command line means; ``tell`` is told where a socket listens.

    Raises:
        CasperError: it cannot be read, reached or listened at, or an option that fits no such source.
    """
    if name.startswith(SCHEME):
        return Socket(name, listens, reconnect, tell)
    if listens or reconnect:
        option = "--listen" if listens else "--reconnect"
        raise CasperError(f"{option} is about sockets: give tcp://HOST:PORT instead of {name}")
    return Standard(sys.stdin) if name == "-" else File(Path(name))
