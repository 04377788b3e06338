"""Segments by a day's hypotheses: every action belongs where the best explanation of the whole day has it.

So an action that was misread is taken for needless once later ones say so, a goal that the partner comes back to is
read with all that was seen of it, and two goals at once are kept apart. What a day says of goals and prices is
`engine.episodes`; here it is asked for the numbers of the observations that belong together, and the reading of these
decides as ever.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from typing import Protocol

from casper.engine.reading.reading import Reading
from casper.engine.reading.segments import Begins, Candidates, GoesOn, LeftOut, Placed, because_of, refusal_of
from casper.engine.reading.underway import Underway
from casper.engine.verification.observation import Observation, Seen
from casper.kb.terms.terms import Compound

REMEMBERED = 500  # observations that an episode can be read from anew


class Segment(Protocol):
    """What is asked of a day's episode."""

    @property
    def observations(self) -> Sequence[int]:
        """The numbers of its observations, from 1, since the day began."""


class Days(Protocol):
    """What is asked of a day, which all partners of one world share (`engine.episodes.day.Day`)."""

    def observe(self, observed: Seen, t: float | None = None, agent: str | None = None) -> None:
        """Take in one action."""

    @property
    def count(self) -> int:
        """How many observations there were since the day began."""

    @property
    def episodes(self) -> Sequence[Segment]:
        """The episodes of the best explanation."""


class ByDay:
    """See the module.

    Args:
        day: the hypotheses; partners of one world share it, and ``seen``.
        agent: whose actions are placed.
        fresh: makes a reading in which nothing was observed.
        seen: the last observations of all partners by number.
    """

    def __init__(
        self, day: Days, agent: str, fresh: Callable[[], Reading], seen: deque[tuple[int, Seen]] | None = None
    ) -> None:
        self._day, self._agent, self._fresh = day, agent, fresh
        self._seen = deque[tuple[int, Seen]](maxlen=REMEMBERED) if seen is None else seen

    def closed(self, episode: Underway) -> None:
        """Of no matter: the day knows what is over."""

    def did(self, action: Compound, robot: str, t: float) -> None:
        """The robot's actions belong to the day, too."""
        self._day.observe(Observation(action.functor, action.args), t, robot)

    def place(self, seen: Seen, among: Candidates, t: float | None = None) -> Placed:
        """See `Segments`."""
        self._day.observe(seen, t, self._agent)
        number = self._day.count
        self._seen.append((number, seen))
        numbers = next((set(e.observations) for e in self._day.episodes if number in e.observations), None)
        if numbers is None:
            return LeftOut("serves no goal that is or could be pursued now and is left out")
        nearest = (among.current, *reversed(among.helped), *among.others)
        open_ = [episode for episode in nearest if episode.numbers & numbers]
        if open_ and open_[0].numbers == numbers - {number}:
            open_[0].reading.observe(seen)
            if open_[0].reading.count:
                open_[0].numbers.add(number)
                return GoesOn(open_[0])
            open_[0].reading.undo()
        reading = self._read(numbers)
        if reading is None:
            return LeftOut("fits no plan any more and is left out")
        if open_:
            open_[0].read_anew(reading, numbers)
            return GoesOn(open_[0])
        return Begins(self._because(seen, among.current), reading, frozenset(numbers))

    def _because(self, seen: Seen, current: Underway) -> str:
        """Why it is no step of what is under way."""
        refusal = refusal_of(seen, current)
        if refusal is None:
            current.reading.undo()
            return "another goal explains it better"
        return because_of(refusal, current)

    def _read(self, numbers: set[int]) -> Reading | None:
        """A reading of these observations, as far as they are remembered; None when they have no explanation."""
        reading = self._fresh()
        for number, seen in self._seen:
            if number in numbers:
                reading.observe(seen)
        return reading if reading.count else None
