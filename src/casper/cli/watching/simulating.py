"""A simulated trial as ``casper run`` carries it out: told as it happens; filmed, recorded and reported if asked."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from casper.cli.terminal.pacing import paced
from casper.cli.terminal.progress import progress
from casper.cli.watching.telling import Teller, listening
from casper.engine.domain.domain import Domain
from casper.engine.events import Event
from casper.engine.live.listening import Listener
from casper.engine.live.memory import keep_loaded, tidied
from casper.report.writing import check_page
from casper.rrd.writing import check_rrd
from casper.sim_adapter.eye.film import check_film, filming
from casper.sim_adapter.eye.viewer import check_screen, viewing
from casper.sim_adapter.trial import Trial, TrialSettings
from casper.streams.recordings.header import Header, header_of
from casper.streams.recordings.writing import Writer, check_recording, recording


@dataclass(frozen=True, slots=True)
class Wanted:
    """What a run leaves behind besides what it tells: files (None: not wanted), and a window while it lasts."""

    report: Path | None = None
    record: Path | None = None
    rerun: Path | None = None
    video: Path | None = None
    view: bool = False

    def check(self) -> None:
        """See that all of it can be had, before anything is simulated.

        Raises:
            CasperError: a file that cannot be written, no screen, or a library that is missing.
        """
        if self.video is not None:
            check_film(self.video)
        if self.view:
            check_screen()
        if self.report is not None:
            check_page(self.report)
        if self.record is not None:
            check_recording(self.record)
        if self.rerun is not None:
            check_rrd(self.rerun)


def simulate(
    domain: Domain, settings: TrialSettings, wanted: Wanted, speed: float, teller: Teller, language: str | None
) -> None:
    """Carry a trial out.

    Args:
        domain: where it happens.
        settings: what it is about.
        wanted: what it leaves behind.
        speed: simulated seconds a second; 0: as fast as it goes, or in a window as it was.
        teller: tells its events.
        language: of the domain's words, for the header of a recording.

    Raises:
        CasperError: as `Wanted.check` and `Trial`.
    """
    wanted.check()
    trial = Trial(domain, settings)
    header = header_of(domain, language, trial.minds.choices, settings.seed)
    keep_loaded()
    waits = progress("simulating", None, teller.quiet or sys.stdout.isatty())
    pace = speed or (1.0 if wanted.view else 0.0)
    with _heard(trial, header, wanted, pace) as events, waits:
        teller.open(settings.seed)
        for event in tidied(paced(events, pace)):
            teller.tell(event)


@contextmanager
def _heard(trial: Trial, header: Header, wanted: Wanted, pace: float) -> Iterator[Iterator[Event]]:
    """The events of a trial, of which all that is wanted is made on their way."""
    with (
        recording(wanted.record, header) as writer,
        filming(trial.simulation, wanted.video),
        viewing(trial.simulation, pace if wanted.view else None),
        listening(trial.domain, wanted.report, wanted.rerun) as listeners,
    ):
        events = trial.events() if writer is None else _recorded(trial, writer)
        if listeners:
            trial.each_step = partial(_shown, trial, listeners)
        for listener in listeners:
            events = listener.heard(events, trial.minds)
        yield events


def _shown(trial: Trial, listeners: Sequence[Listener]) -> None:
    """The room as it is, which no sensor saw."""
    for listener in listeners:
        listener.see(trial.simulation.truth())


def _recorded(trial: Trial, writer: Writer) -> Iterator[Event]:
    """The events of a trial, and what a replay needs of it on the way into a recording."""
    trial.sensed = writer.given
    for event in writer.heard(trial.events()):
        yield event if _is_of_a_mind(event) else writer.aside(event)


def _is_of_a_mind(event: Event) -> bool:
    """Whether a replay makes it again: what the body does, and says on its way, no mind knows of."""
    if event.type == "says":
        return "goal" in event.data  # a mind announces, a body asks to be let through
    return event.type not in ("robot", "summary")
