"""The episodes of one partner: which is under way, which wait for the robot, which were given up, and which are over.

An episode that is taken to be given up is kept for a while: who comes back to it never gave it up. Then it is taken up
again with all that was seen of it, and its row is struck.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator
from typing import Any

from casper.engine.collaboration.acting import ActingSettings
from casper.engine.collaboration.supervisor import Supervisor
from casper.engine.events import Event
from casper.engine.reading.reading import Reading
from casper.engine.reading.underway import UNCLEAR, Underway
from casper.kb.terms.terms import Compound

MOST_ROWS = 10_000  # closed episodes whose row is kept for the summary
MOST_HELPED = 8  # episodes open beside the one under way; then the oldest is unclear
MOST_ASIDE = 8  # episodes taken to be given up that a partner may come back to


class Episodes:
    """Open, put aside, taken up and closed.

    Args:
        partner: whose they are.
        robot: who helps; None watches only.
        fresh: makes a reading in which nothing was observed.
        closed: is told of an episode that is over.
        acting: how sure a goal must be before anything is announced.
    """

    def __init__(
        self,
        partner: str,
        robot: str | None,
        fresh: Callable[[], Reading],
        closed: Callable[[Underway], object],
        acting: ActingSettings,
    ) -> None:
        self.partner, self.robot, self.acting = partner, robot, acting
        self._fresh, self._closed = fresh, closed
        self.doubts = False
        self.current = self.opened()
        self.helped: list[Underway] = []  # open beside: only the robot's part is left, or the partner came back to it
        self.aside: deque[tuple[Underway, dict[str, Any]]] = deque(maxlen=MOST_ASIDE)  # given up, it seems; their rows
        self.rows: deque[dict[str, Any]] = deque(maxlen=MOST_ROWS)
        self.predicted: Supervisor | None = None  # of the last closed episode that committed to a goal

    @property
    def supervisors(self) -> tuple[Supervisor, ...]:
        """Of all episodes that are open, the longest open first."""
        return tuple(episode.supervisor for episode in (*self.helped, self.current))

    @property
    def open_episodes(self) -> tuple[Underway, ...]:
        """Those in which something was seen, the one under way first."""
        return tuple(episode for episode in (self.current, *reversed(self.helped)) if episode.begun is not None)

    @property
    def given_up(self) -> list[Underway]:
        """Those that are taken to be given up, the last first."""
        return [episode for episode, _ in reversed(self.aside)]

    @property
    def committed(self) -> Supervisor | None:
        """The supervisor of the last episode that committed to a goal."""
        open_ = next((s for s in reversed(self.supervisors) if s.commitment is not None), None)
        return open_ or self.predicted

    def whose(self, action: Compound) -> Underway | None:
        """The episode for which the robot has announced an action and not done it yet, the longest open first."""
        return next((e for e in (*self.helped, self.current) if action in e.supervisor.left), None)

    def opened(self) -> Underway:
        """A new episode, in which nothing was seen."""
        reading = self._fresh()
        supervisor = Supervisor(reading, self.robot, self.acting)
        supervisor.doubts = self.doubts
        return Underway(reading, supervisor)

    def doubt(self, noise: float | None = None) -> None:
        """From now on what is observed is not sure: shares decide what is believed (`Supervisor.doubts`).

        ``noise``: what a needless action costs from now on, what was observed until now included; None: as before.
        """
        self.doubts = True
        for supervisor in self.supervisors:
            supervisor.doubts = True
        for episode in (self.current, *self.helped, *(other for other, _ in self.aside)):
            if noise is not None and episode.reading.options.noise is None:
                episode.read_anew(episode.reading.reread(noise), episode.numbers)

    def resume(self, episode: Underway) -> None:
        """Go on with an episode that was read anew; the one that was current waits for the robot alone."""
        if self.current.begun is not None:
            self.helped.append(self.current)
        self.current = episode

    def leave_to_the_robot(self, t: float) -> Iterator[Event]:
        """Of the one under way only the robot's part is left: it stays open beside a new one."""
        self.helped.append(self.current)
        self.current = self.opened()
        yield from self._crowded(t)

    def take_up(self, episode: Underway, t: float) -> Iterator[Event]:
        """The partner comes back to an episode, if that was taken to be given up."""
        row = next((row for other, row in self.aside if other is episode), None)
        if row is None:
            return
        self.aside = deque(((e, r) for e, r in self.aside if e is not episode), MOST_ASIDE)
        if row in self.rows:
            self.rows.remove(row)
        self.helped.append(episode)
        if self.current.instead_of is episode:
            self.current.supervisor.is_instead = False
        yield from self._crowded(t)

    def close(self, episode: Underway, outcome: str, t: float, to: float | None = None) -> Iterator[Event]:
        """An episode is over, with an ``episode`` event; where it was the one under way a new one is.

        Args:
            episode: an open one.
            outcome: how it ends (`engine.reading.underway`).
            t: now, in seconds.
            to: when it ended; None: now.
        """
        row = episode.row(self.partner, outcome, t if to is None else to)
        self.rows.append(row)
        if episode.supervisor.commitment is not None:
            self.predicted = episode.supervisor
        self._closed(episode)
        if episode is self.current:
            self.current = self.opened()
        else:
            self.helped.remove(episode)
        yield Event("episode", t, row)

    def _crowded(self, t: float) -> Iterator[Event]:
        for oldest in self.helped[:-MOST_HELPED]:
            yield from self.close(oldest, UNCLEAR, t)
