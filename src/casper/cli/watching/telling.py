"""How the commands that watch tell what happens: on the terminal as it comes, and in files for whoever wants them."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from casper.cli.terminal.output import console, print_json
from casper.cli.terminal.showing import show
from casper.engine.domain.domain import Domain
from casper.engine.events import Event
from casper.engine.events.timeline import Timeline
from casper.engine.live.listening import Listener
from casper.report.writing import reporting
from casper.rrd.writing import logging


class Teller:
    """Tells events on the terminal.

    Args:
        domain: in whose words.
        as_json: a line of JSON each, instead of a timeline.
        quiet: of the timeline the summary alone.
    """

    def __init__(self, domain: Domain, as_json: bool, quiet: bool = False) -> None:
        self.domain, self.as_json, self.quiet = domain, as_json, quiet
        self._out, self._timeline = console(), Timeline(domain.partner, domain.robot, domain.kb.words)

    def open(self, seed: int) -> None:
        """The heading of a simulation's timeline."""
        if not self.as_json and not self.quiet:
            show(self._out, self._timeline.open(self.domain.name, seed))

    def tell(self, event: Event) -> None:
        """What there is to say about the next event."""
        if self.as_json:
            print_json(event.to_json())
        elif not self.quiet or event.type == "summary":
            show(self._out, self._timeline.lines(event))


@contextmanager
def listening(domain: Domain, report: Path | None, rerun: Path | None = None) -> Iterator[list[Listener]]:
    """Those who make files of what they hear, written at the end, also when the run is broken off.

    Args:
        domain: of the run.
        report: the page; None: none is asked for.
        rerun: the recording for Rerun's viewer, likewise.

    Raises:
        CasperError: a file that cannot be written.
    """
    with reporting(domain, report) as page, logging(domain, rerun) as log:
        yield [listener for listener in (page, log) if listener is not None]
