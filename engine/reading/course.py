"""The course of a partner's day: episode after episode, each with its reading and the robot's part in it.

Whatever is seen belongs to an episode or is left out (`segments`). An episode closes, with an ``episode`` event, when

* everything was seen, by every explanation of its committed goal, or the robot has done its part: ``finished``;
* the partner went over to something else before: ``abandoned``, or ``unclear`` where no goal was committed to. Where
  only the robot's part was left, the episode stays open beside the new one until the robot has done it;
* nobody watches any more: ``unclear``, as is what the robot has given up and the partner goes over to something else.

Who comes back to a goal that was taken to be given up never gave it up (`episodes`): what was announced for it is
announced anew. From then on both are open.

What had been announced for a goal that is given up is withdrawn before anything else is told.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from casper.engine.collaboration.acting import ActingSettings
from casper.engine.collaboration.supervisor import LIKELY
from casper.engine.events import Event
from casper.engine.reading.episodes import Episodes
from casper.engine.reading.reading import Reading
from casper.engine.reading.segments import Begins, BySight, Candidates, LeftOut, Segments, refusal_of
from casper.engine.reading.underway import ABANDONED, FINISHED, UNCLEAR, Underway
from casper.engine.verification.observation import Observation, Seen
from casper.kb.errors import CasperError
from casper.kb.terms.terms import Compound


class Course(Episodes):
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
        self.others, self.stops = others, stops
        self.segments: Segments = BySight(fresh) if segments is None else segments(partner, fresh)
        super().__init__(partner, robot, fresh, self.segments.closed, acting)

    def read(self, observation: Seen, t: float) -> Iterator[Event]:
        """One more action of the partner.

        Raises:
            CasperError: it fits nothing, and the course was told to stop there.
        """
        return _about(self.partner, self._read(observation, t))

    def _read(self, observation: Seen, t: float) -> Iterator[Event]:
        if self.current.begun is None and not self.current.reading.observations:
            self.current = self.opened()  # what was done since the last one closed is known to it
        theirs = {id(e): course for course in self.others() for e in course.open_episodes}
        elsewhere = [e for course in self.others() for e in course.open_episodes]
        among = Candidates(self.current, self.helped, elsewhere, self.given_up)
        placed = self.segments.place(observation, among, t)
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
        yield from self.take_up(episode, t)
        yield from self._taken(episode, t) if owner is None else owner.helped_by(self.partner, episode, t)

    def helped_by(self, other: str, episode: Underway, t: float) -> Iterator[Event]:
        """An episode has taken in an action that another partner did: its events are about this one, ``by`` them."""
        for event in self._taken(episode, t):
            yield Event(event.type, event.t, {**event.about(self.partner).data, "by": other})

    def inferred(self, observation: Seen, t: float) -> Iterator[Event]:
        """What the partner must have done unseen: a goal that it is a step of was not given up.

        Nothing is announced for that: whoever went on alone may have done the rest, too.
        """
        aside = self.given_up
        for episode in (*self.open_episodes, *aside):
            if refusal_of(observation, episode) is None:
                if episode not in aside:
                    episode.reading.undo()
                    return
                yield from _about(self.partner, self.take_up(episode, t))
                episode.note(t)
                yield Event("reading", t, episode.reading.to_json()).about(self.partner)
                return

    def did(self, action: Compound, t: float) -> Iterator[Event]:
        """The robot has done an action that it had announced; its episode is over with the last of them."""
        self.segments.did(action, self.robot or "", t)
        episode = self.whose(action)
        if episode is not None:
            episode.supervisor.did(action)
            if not episode.supervisor.left:
                coming = episode.supervisor.goes_on(t)
                yield from (event.about(self.partner) for event in coming)
                if not coming:
                    yield from self.close(episode, FINISHED, t)

    def failed(self, action: Compound) -> None:
        """The robot could not do an action that it had announced: the episode stays open for the partner to go on."""
        episode = self.whose(action)
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
        yield from self.close(episode, ABANDONED, t, episode.last)
        episode.reading.undo()
        before = episode.instead_of
        if before is not None and any(before is other for other, _ in self.aside) and self.current.begun is None:
            yield from self.take_up(before, t)
            self.helped.remove(before)
            self.current = before
            yield from before.supervisor.update(t)

    def end(self, t: float) -> Iterator[Event]:
        """Nobody watches any more: what is open is over."""
        for episode in (*self.helped, self.current):
            if episode.begun is not None:
                yield from self.close(episode, FINISHED if episode.is_complete else UNCLEAR, t, episode.last)

    def _taken(self, episode: Underway, t: float) -> Iterator[Event]:
        """An episode has taken an action in."""
        episode.note(t)
        yield Event("reading", t, episode.reading.to_json())
        yield from episode.supervisor.update(t)
        if episode.is_over:
            yield from self.close(episode, FINISHED, t)

    def _turn(self, observation: Seen, because: str, t: float) -> Iterator[Event]:
        """The partner goes over to something new; what was under way is over, or left to the robot."""
        before = self.current
        if before.begun is None:
            return
        if before.supervisor.ready and before.supervisor.left:
            yield from self.leave_to_the_robot(t)
            return
        tell = before.reading.tell
        told = tell.phrase("went over", tell.name(self.partner), tell.step(str(observation)), because)
        yield from before.supervisor.withdraw(t, told)
        outcome = before.outcome
        yield from self.close(before, outcome, t, before.last)
        before.instead_of, self.current.instead_of = None, before
        self.current.supervisor.is_instead = outcome == ABANDONED
        if outcome != FINISHED:
            self.aside.append((before, self.rows[-1]))


def _about(partner: str, events: Iterable[Event]) -> Iterator[Event]:
    return (event.about(partner) for event in events)
