"""World states over TCP: connect to who sends them, or wait until somebody does."""

from __future__ import annotations

import socket
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import BinaryIO, cast

from casper.kb.errors import CasperError
from casper.streams.items import Line, Note
from casper.streams.sources.lines import lines_of, text_of

SCHEME = "tcp://"
PATIENCE = 10.0  # seconds for one attempt to connect
PAUSE = 0.5  # seconds between two


def address_of(name: str) -> tuple[str, int]:
    """Host and port of ``tcp://host:port``; no host is this machine, and an IPv6 one stands in brackets.

    Raises:
        CasperError: it is none.
    """
    host, colon, port = name.removeprefix(SCHEME).rpartition(":")
    if not colon or not port.isascii() or not port.isdigit() or int(port) > 65535:
        raise CasperError(f"a socket is tcp://HOST:PORT, such as tcp://localhost:7000, not {name}")
    return host.strip("[]") or "localhost", int(port)


class Socket:
    """A connection from which lines are read; it ends with the connection, or when nobody came back in time.

    Args:
        name: ``tcp://host:port``.
        listens: wait for somebody to connect, instead of connecting.
        reconnect: seconds for which a connection that ended is waited for; 0 takes its end for the end.
        tell: is told where it listens.

    Raises:
        CasperError: no address, nobody there within ``reconnect`` seconds, or a port that cannot be had.
    """

    is_live = True

    def __init__(
        self, name: str, listens: bool = False, reconnect: float = 0.0, tell: Callable[[str], object] = bool
    ) -> None:
        self.name, self.address, self.reconnect = name, address_of(name), reconnect
        self.lost = False
        self._server = self._listen(tell) if listens else None
        self._first = None if listens else self._connect(reconnect)

    def items(self) -> Iterator[Line | Note]:
        """Lines of one connection after the other; their numbers go on."""
        before, connection = 0, self._first if self._server is None else self._accepted(None)
        while connection is not None:
            broken = ""
            number = 0
            try:
                with connection, connection.makefile("rb") as stream:
                    for line in lines_of(text_of(cast(BinaryIO, stream))):
                        number = line.number
                        yield Line(line.text, before + number, "", line.is_whole)
                        cut = not line.is_whole and not line.text.rstrip().endswith("}")
                        broken = "in the middle of a line" if cut else ""
            except OSError as mistake:
                broken = mistake.strerror or str(mistake)
            before += number
            if not self.reconnect:
                self.lost = bool(broken)
                if broken:
                    yield Note(f"the connection to {self.name} was lost ({broken}) behind line {before}", is_end=True)
                return
            yield Note(f"the connection to {self.name} ended behind line {before}; waiting {self.reconnect:g} s for it")
            if not number:
                time.sleep(PAUSE)
            connection = self._again()
        self.lost = True
        yield Note(f"nobody came back to {self.name} within {self.reconnect:g} s", is_end=True)

    def _again(self) -> socket.socket | None:
        if self._server is not None:
            return self._accepted(self.reconnect)
        with suppress(CasperError):
            return self._connect(self.reconnect)
        return None

    def _connect(self, seconds: float) -> socket.socket:
        until = time.monotonic() + seconds
        while True:
            try:
                connection = socket.create_connection(self.address, PATIENCE)
                break
            except OSError as mistake:
                if time.monotonic() >= until:
                    because = mistake.strerror or mistake
                    raise CasperError(f"nobody can be reached at {self.name} ({because})") from None
                time.sleep(PAUSE)
        return _steady(connection)

    def _listen(self, tell: Callable[[str], object]) -> socket.socket:
        host, port = self.address
        try:
            family = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0][0]
            server = socket.create_server((host, port), family=family, backlog=1)
        except OSError as mistake:
            raise CasperError(f"cannot listen at {self.name} ({mistake.strerror or mistake})") from None
        tell(f"listening at {SCHEME}{host}:{server.getsockname()[1]}")
        return server

    def _accepted(self, seconds: float | None) -> socket.socket | None:
        assert self._server is not None
        self._server.settimeout(seconds)
        try:
            connection, _ = self._server.accept()
        except TimeoutError:
            return None
        return _steady(connection)


def _steady(connection: socket.socket) -> socket.socket:
    """A connection that waits for lines as long as it takes, and notices when the other machine is gone."""
    connection.settimeout(None)
    connection.setsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1)
    return connection
