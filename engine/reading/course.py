"""The course of a partner's day: episode after episode, each with its reading and the robot's part in it.

Whatever is seen belongs to an episode or is left out (`segments`). An episode closes, with an ``episode`` event, when

* everything was seen, by every explanation of its committed goal, or the robot has done its part: ``finished``;
* the partner went over to something else before: ``abandoned``, or ``unclear`` where no goal was committed to. Where
  only the robot's part was left, the episode stays open beside the new one until the robot has done it;
* nobody watches any more: ``unclear``, as is what the robot has given up and the partner goes over to something else.

Who comes back to a goal that was taken to be given up never gave it up: its episode is taken up again with all that was
seen of it, its row is struck, and what was announced for it is announced anew. From then on both are open.

What had been announced for a goal that is given up is withdrawn before anything else is told.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from typing import Any

from casper.engine.collaboration.acting import ActingSettings
from casper.engine.collaboration.supervisor import LIKELY, Supervisor
from casper.engine.events import Event
from casper.engine.reading.reading import Reading
from casper.engine.reading.segments import Begins, BySight, LeftOut, Segments, refusal_of
from casper.engine.reading.underway import ABANDONED, FINISHED, UNCLEAR, Underway
from casper.engine.verification.observation import Observation, Seen
from casper.kb.errors import CasperError
from casper.kb.terms.terms import Compound

MOST_ROWS = 10_000  # closed episodes whose row is kept for the summary
MOST_HELPED = 8  # episodes open beside the one under way; then the oldest is unclear
MOST_ASIDE = 8  # episodes taken to be given up that a partner may come back to


class Course:
    """Episodes of one partner, one after the other.

    Args:
        partner: whose they are.
        robot: who helps; None watches only.
        fresh: makes a reading in which nothing was observed.
        segments: makes what says where an action belongs, of ``partner`` and ``fresh``; `BySight` when None.
        others: the courses of the other partners in view, whose goals an action may serve when it fits there only.
        stops: an action that fits nothing raises instead of being left out.
        acting: how sure a goal must be before anything is announced.
    """

    def __init__(
        self,
        partner: str,
        robot: str | None,
        fresh: Callable[[], Reading],
        segments: Callable[[str, Callable[[], Reading]], Segments] | None = None,
        others: Callable[[], Iterable[Course]] = tuple,
        stops: bool = False,
        acting: ActingSettings = LIKELY,
    ) -> None:
        self.partner, self.robot, self.others, self.stops = partner, robot, others, stops
        self.acting = acting
        self._fresh = fresh
        self.segments: Segments = BySight(fresh) if segments is None else segments(partner, fresh)
        self.doubts = False
        self.current = self._opened()
        self.helped: list[Underway] = []  # open beside: only the robot's part is left, or the partner came back to it
        self.aside: deque[tuple[Underway, dict[str, Any]]] = deque(maxlen=MOST_ASIDE)  # given up, it seems; their rows
        self.rows: deque[dict[str, Any]] = deque(maxlen=MOST_ROWS)
        self.predicted: Supervisor | None = None  # of the last closed episode that committed to a goal

    def _opened(self) -> Underway:
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

    @property
    def supervisors(self) -> tuple[Supervisor, ...]:
        """Of all episodes that are open, the longest open first."""
        return tuple(episode.supervisor for episode in (*self.helped, self.current))

    @property
    def open_episodes(self) -> tuple[Underway, ...]:
        """Those in which something was seen, the one under way first."""
        return tuple(episode for episode in (self.current, *reversed(self.helped)) if episode.begun is not None)

    @property
    def committed(self) -> Supervisor | None:
        """The supervisor of the last episode that committed to a goal."""
        open_ = next((s for s in reversed(self.supervisors) if s.commitment is not None), None)
        return open_ or self.predicted

    def resume(self, episode: Underway) -> None:
        """Go on with an episode that was read anew; the one that was current waits for the robot alone."""
        if self.current.begun is not None:
            self.helped.append(self.current)
        self.current = episode

    def read(self, observation: Seen, t: float) -> Iterator[Event]:
        """One more action of the partner.

        Raises:
            CasperError: it fits nothing, and the course was told to stop there.
        """
        return _about(self.partner, self._read(observation, t))

    def _read(self, observation: Seen, t: float) -> Iterator[Event]:
        if self.current.begun is None and not self.current.reading.observations:
            self.current = self._opened()  # what was done since the last one closed is known to it
        theirs = {id(e): course for course in self.others() for e in course.open_episodes}
        elsewhere = [e for course in self.others() for e in course.open_episodes]
        aside = [episode for episode, _ in reversed(self.aside)]
        placed = self.segments.place(observation, self.current, self.helped, elsewhere, t, aside)
        if isinstance(placed, LeftOut):
            if self.stops:
                raise CasperError(f"{observation} {placed.because}".replace(" and is left out", ""))
            yield Event("warning", t, {"message": f"{observation} {placed.because}"})
            return
        if isinstance(placed, Begins):
            yield from self._turn(observation, placed.because, t)
            if placed.reading is None:
                self.current.reading.observe(observation)
            else:
                self.current.read_anew(placed.reading, set(placed.numbers))
        episode = self.current if isinstance(placed, Begins) else placed.episode
        owner = theirs.get(id(episode))
        yield from self._taken_up(episode, t)
        yield from self._taken(episode, t) if owner is None else owner.helped_by(self.partner, episode, t)

    def helped_by(self, other: str, episode: Underway, t: float) -> Iterator[Event]:
        """An episode has taken in an action that another partner did: its events are about this one, ``by`` them."""
        for event in self._taken(episode, t):
            yield Event(event.type, event.t, {**event.about(self.partner).data, "by": other})

    def inferred(self, observation: Seen, t: float) -> Iterator[Event]:
        """What the partner must have done unseen: a goal that it is a step of was not given up.

        Nothing is announced for that: whoever went on alone may have done the rest, too.
        """
        aside = [episode for episode, _ in reversed(self.aside)]
        for episode in (*self.open_episodes, *aside):
            if refusal_of(observation, episode) is None:
                if episode not in aside:
                    episode.reading.undo()
                    return
                yield from _about(self.partner, self._taken_up(episode, t))
                episode.note(t)
                yield Event("reading", t, episode.reading.to_json()).about(self.partner)
                return

    def did(self, action: Compound, t: float) -> Iterator[Event]:
        """The robot has done an action that it had announced; its episode is over with the last of them."""
        self.segments.did(action, self.robot or "", t)
        episode = self._whose(action)
        if episode is not None:
            episode.supervisor.did(action)
            if not episode.supervisor.left:
                coming = episode.supervisor.goes_on(t)
                yield from (event.about(self.partner) for event in coming)
                if not coming:
                    yield from self._close(episode, FINISHED, t)

    def failed(self, action: Compound) -> None:
        """The robot could not do an action that it had announced: the episode stays open for the partner to go on."""
        episode = self._whose(action)
        if episode is not None:
            episode.supervisor.gives_up(action)

    def refuted(self, observation: Observation, t: float, because: str) -> Iterator[Event]:
        """What was read last of an episode was not done after all: it is taken back.

        An episode of which nothing else was seen is given up, and the one goes on that it seemed to end. Where a day
        says what belongs together (`by_day`) nothing is taken back.
        """
        last = (e for e in self.open_episodes if list(e.reading.observations[-1:]) == [observation])
        episode = next(last, None) if isinstance(self.segments, BySight) else None
        if episode is not None:
            yield from _about(self.partner, self._taken_back(episode, t, because))

    def _taken_back(self, episode: Underway, t: float, because: str) -> Iterator[Event]:
        if len(episode.reading.observations) > 1:
            episode.reading.undo()
            yield Event("reading", t, episode.reading.to_json())
            yield from episode.supervisor.update(t)
            return
        yield from episode.supervisor.withdraw(t, because)
        yield from self._close(episode, ABANDONED, t, episode.last)
        episode.reading.undo()
        before = episode.instead_of
        if before is not None and any(before is other for other, _ in self.aside) and self.current.begun is None:
            yield from self._taken_up(before, t)
            self.helped.remove(before)
            self.current = before
            yield from before.supervisor.update(t)

    def end(self, t: float) -> Iterator[Event]:
        """Nobody watches any more: what is open is over."""
        for episode in (*self.helped, self.current):
            if episode.begun is not None:
                yield from self._close(episode, FINISHED if episode.is_complete else UNCLEAR, t, episode.last)

    def _taken(self, episode: Underway, t: float) -> Iterator[Event]:
        """An episode has taken an action in."""
        episode.note(t)
        yield Event("reading", t, episode.reading.to_json())
        yield from episode.supervisor.update(t)
        if episode.is_over:
            yield from self._close(episode, FINISHED, t)

    def _taken_up(self, episode: Underway, t: float) -> Iterator[Event]:
        """The partner comes back to an episode that was taken to be given up."""
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

    def _crowded(self, t: float) -> Iterator[Event]:
        for oldest in self.helped[:-MOST_HELPED]:
            yield from self._close(oldest, UNCLEAR, t)

    def _turn(self, observation: Seen, because: str, t: float) -> Iterator[Event]:
        """The partner goes over to something new; what was under way is over, or left to the robot."""
        before = self.current
        if before.begun is None:
            return
        if before.supervisor.ready and before.supervisor.left:
            self.helped.append(before)
            self.current = self._opened()
            yield from self._crowded(t)
            return
        tell = before.reading.tell
        told = tell.phrase("went over", tell.name(self.partner), tell.step(str(observation)), because)
        yield from before.supervisor.withdraw(t, told)
        outcome = before.outcome
        yield from self._close(before, outcome, t, before.last)
        before.instead_of, self.current.instead_of = None, before
        self.current.supervisor.is_instead = outcome == ABANDONED
        if outcome != FINISHED:
            self.aside.append((before, self.rows[-1]))

    def _close(self, episode: Underway, outcome: str, t: float, to: float | None = None) -> Iterator[Event]:
        row = episode.row(self.partner, outcome, t if to is None else to)
        self.rows.append(row)
        if episode.supervisor.commitment is not None:
            self.predicted = episode.supervisor
        self.segments.closed(episode)
        if episode is self.current:
            self.current = self._opened()
        else:
            self.helped.remove(episode)
        yield Event("episode", t, row)

    def _whose(self, action: Compound) -> Underway | None:
        """The episode for which the robot has announced an action and not done it yet, the longest open first."""
        return next((e for e in (*self.helped, self.current) if action in e.supervisor.left), None)


def _about(partner: str, events: Iterable[Event]) -> Iterator[Event]:
    return (event.about(partner) for event in events)
