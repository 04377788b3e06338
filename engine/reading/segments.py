"""Which episode an action of the partner belongs to: the one under way, one whose rest is the robot's, or a new one.

`Segments` is what a mind asks. `BySight` is the plain answer, by what readings say of the next action:

* what fits the episode under way goes on with it; what is a step that the partner had left to the robot, with that one;
* what fits neither, and is the first step of a goal, begins a new episode;
* what fits nothing is left out; where a goal explains two or three such together they begin a new episode, as they do
  with an action that fits the episode under way, too, if that is as much as was seen of that one;
* what fits only what another partner is doing is a step of that;
* what comes next of a goal that was taken to be given up, and fits nothing else, is a step of that: it was not;
* what repeats a step of the episode that has just closed, or of one whose rest is the robot's, is left out.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol, TypeAlias

from casper.engine.reading.printing import rejected_text
from casper.engine.reading.reading import Reading
from casper.engine.reading.underway import Underway
from casper.engine.verification.observation import Seen
from casper.kb.terms.terms import Compound


@dataclass(frozen=True, slots=True)
class GoesOn:
    """It belongs to this episode, whose reading has taken it in."""

    episode: Underway


@dataclass(frozen=True, slots=True)
class Begins:
    """A new episode begins with it, since it does not belong to the one under way.

    ``reading`` has taken it in, perhaps with what was seen of the goal before; None: the new episode's reading has yet
    to do so. ``numbers`` are those of its observations since the day began, where somebody counts.
    """

    because: str
    reading: Reading | None = None
    numbers: frozenset[int] = frozenset()


@dataclass(frozen=True, slots=True)
class LeftOut:
    """It belongs to no episode."""

    because: str


Placed: TypeAlias = "GoesOn | Begins | LeftOut"
Refusal: TypeAlias = Mapping[str, Sequence[str]]  # goal -> why it explains nothing with the action

MOST_ODD = 3  # actions in a row that fit nothing, and are looked at together
LONGEST = 1000  # actions of one episode, needless ones among them; then another begins


@dataclass(frozen=True, slots=True)
class Candidates:
    """The episodes that an action may belong to.

    ``current`` is the one under way, perhaps without any action yet; ``helped`` are those of which only the robot's
    part is left, oldest first; ``others`` the open ones of other partners; ``aside`` those that were taken to be given
    up, the last first.
    """

    current: Underway
    helped: Sequence[Underway] = ()
    others: Sequence[Underway] = ()
    aside: Sequence[Underway] = ()


class Segments(Protocol):
    """Says of each action where it belongs."""

    def place(self, seen: Seen, among: Candidates, t: float | None = None) -> Placed:
        """Where the partner's next action belongs.

        Args:
            seen: the action.
            among: the episodes that come into question.
            t: when, in seconds.
        """

    def closed(self, episode: Underway) -> None:
        """Told when an episode is over."""

    def did(self, action: Compound, robot: str, t: float) -> None:
        """Told what the robot did of its part."""


class BySight:
    """Segments by what readings say of the next action alone, in constant time and memory.

    Args:
        fresh: makes a reading in which nothing was observed.
    """

    def __init__(self, fresh: Callable[[], Reading]) -> None:
        self._fresh = fresh
        self._last: Underway | None = None  # the episode that closed last
        self._left_out: deque[tuple[Seen, str]] = deque(maxlen=MOST_ODD)  # what fitted nothing lately, and why

    def closed(self, episode: Underway) -> None:
        """Its steps may be seen once more."""
        self._last = episode
        self._left_out.clear()

    def did(self, action: Compound, robot: str, t: float) -> None:
        """Of no matter to what is seen next."""

    def place(self, seen: Seen, among: Candidates, t: float | None = None) -> Placed:
        """See `Segments`."""
        current, helped = among.current, among.helped
        is_open = bool(current.reading.observations)
        refusals = []
        for episode in ([current] if is_open else []) + list(reversed(helped)):
            refusal = refusal_of(seen, episode)
            if refusal is None:
                instead = self._fits_better(seen, episode) if episode is current else None
                return GoesOn(episode) if instead is None else instead
            refusals.append(refusal)
        if is_beginning(self._fresh(), seen):
            return Begins(because_of(refusals[0], current) if is_open else "")
        is_over = not is_open and self._last is not None and self._last.contains(seen)
        for episode in among.aside if not is_over else ():
            if comes_back(seen, episode):
                return GoesOn(episode)
        for episode in among.others if is_over else (*among.others, *among.aside):  # steps of it may have gone unseen
            if refusal_of(seen, episode) is None:
                return GoesOn(episode)
        if is_open:
            return self._odd(seen, current, refusals[0])
        if self._last is not None and self._last.contains(seen):
            return LeftOut(f"is left out: {self._last.goal}, which has it, is over")
        later = next((episode for episode in helped if episode.contains(seen)), None)
        if later is not None:
            return LeftOut(f"is left out: in {later.goal}, which has it, what comes after it was done")
        refusal = refusal_of(seen, current)
        return GoesOn(current) if refusal is None else _left_out(refusal)

    def _odd(self, seen: Seen, current: Underway, refusal: Refusal) -> Placed:
        """What is no step and no beginning is needless, where the reading allows such actions."""
        if current.reading.options.noise is None:
            self._left_out.append((seen, because_of(refusal, current)))
            together = self._together()
            if together is not None:
                self._left_out.clear()
                return Begins(because_of(refusal, current), together)
            return _left_out(refusal)
        if len(current.reading.observations) >= LONGEST:
            return Begins(f"{LONGEST} actions were seen of it")
        current.reading.observe(seen)
        return GoesOn(current)

    def _fits_better(self, seen: Seen, current: Underway) -> Begins | None:
        """The action, which the episode has taken in, with what was left out, if a goal has as much by that."""
        together = self._together(seen)
        if together is None or len(together.observations) < len(current.reading.observations):
            return None
        current.reading.undo()
        because = self._left_out[-1][1]
        self._left_out.clear()
        return Begins(because, together)

    def _together(self, *seen: Seen) -> Reading | None:
        """A reading of what was left out last, and of this action: of two at least, where a goal has them all."""
        actions = [*(action for action, _ in self._left_out), *seen]
        for start in range(len(self._left_out) - (0 if seen else 1)):
            reading = self._fresh()
            for action in actions[start:]:
                reading.observe(action)
            if reading.first is not None and not reading.first.needless:
                return reading
        return None


def is_beginning(reading: Reading, seen: Seen) -> bool:
    """Whether a goal can begin with the action, with nothing missed; the reading, which is empty, takes it in."""
    reading.observe(seen)
    first = reading.first
    return first is not None and not first.missed and not first.needless


def refusal_of(seen: Seen, episode: Underway) -> Refusal | None:
    """Why the episode does not take the action as a step; None when it does, and has."""
    reading = episode.reading
    reading.observe(seen)
    first = reading.first
    if first is not None and len(reading.observations) - 1 not in first.needless:
        return None
    refusal = dict(reading.rejected)
    reading.undo()
    return refusal


def comes_back(seen: Seen, episode: Underway) -> bool:
    """Whether the action goes on with an episode where it was left, nothing missed; then it has taken it in."""
    missed = _missed(episode)
    if refusal_of(seen, episode) is not None:
        return False
    if _missed(episode) > missed:
        episode.reading.undo()
        return False
    return True


def _missed(episode: Underway) -> int:
    first = episode.reading.first
    return 0 if first is None else first.missed


def because_of(refusal: Refusal, episode: Underway) -> str:
    """Why the episode is over, as far as its own goal says."""
    goal = episode.goal or ""
    reasons = ", ".join(refusal.get(goal, ())) or rejected_text(refusal)
    return reasons or f"no step of {goal} can be that now"


def _left_out(refusal: Refusal) -> LeftOut:
    return LeftOut(f"fits no plan any more and is left out ({rejected_text(refusal)})")
