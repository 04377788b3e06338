"""Streams of world states as the options of a command name them."""

from __future__ import annotations

from casper.cli.terminal.showing import complain
from casper.streams.order.window import check_window, usual_window
from casper.streams.sources.source import Source, source_of


def opened(source: str, listen: bool, reconnect: float, window: float | None) -> tuple[Source, float]:
    """Where world states come from, and by how many seconds they may be late.

    Args:
        source, listen, reconnect: as for `source_of`.
        window: seconds; None: what is usual for such a source.

    Raises:
        CasperError: a window that is none, a source that cannot be read, or an option that does not fit it.
    """
    if window is not None:
        check_window(window)
    stream = source_of(source, listen, reconnect, complain)
    return stream, usual_window(stream.is_live) if window is None else window
