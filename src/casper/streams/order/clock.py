"""The clock of a stream: times that jump are believed when what follows agrees, and left out when it does not."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from casper.streams.items import Given, Item, Note

AHEAD = 60.0  # seconds without anything from which a time is doubted
USUAL = 20  # or so many times the usual pace
BACK = 10.0  # seconds back from which a clock may have been set; less than that is late
AGREE = 3  # messages in a row that settle it


@dataclass
class Clock:
    """Makes the times of a stream advance, whatever its clock does.

    A time far ahead, or far back, is held until the next few agree with it. Then it was a pause, or the clock was set
    back, and times are counted on from there (`shift`). If they do not agree it was a mistake, and is left out.
    """

    back: float = BACK  # seconds back that are late, no jump
    shift: float = 0.0  # seconds added to what comes
    newest: float | None = None
    pace: float = 0.5  # seconds between the last two
    _doubted: list[Given] = field(default_factory=list)

    def take(self, given: Given) -> list[Item]:
        """A message, with the time it gets; what comes of it now."""
        t = given.message.t + self.shift
        if self._is_usual(t):
            told = self._refused() if self._doubted else []
            self._passed(t)
            return [*told, self._shifted(given)]
        if self._doubted and not self._agrees(t):
            told = self._refused()
            self._doubted = [given]
            return told
        self._doubted.append(given)
        return self._settled() if len(self._doubted) >= AGREE else []

    def rest(self) -> list[Item]:
        """Nothing follows any more."""
        return self._refused()

    def _is_usual(self, t: float) -> bool:
        newest = self.newest
        return newest is None or newest - self.back <= t <= newest + max(AHEAD, USUAL * self.pace)

    def _agrees(self, t: float) -> bool:
        last = self._doubted[-1].message.t + self.shift
        first = self._doubted[0].message.t + self.shift
        assert self.newest is not None
        return last <= t <= last + max(AHEAD, USUAL * self.pace, first - self.newest)

    def _passed(self, t: float) -> None:
        if self.newest is None or t > self.newest:
            self.pace = self.pace if self.newest is None else t - self.newest
            self.newest = t

    def _settled(self) -> list[Item]:
        """The doubted ones agree: what there is to say of it, and they themselves."""
        doubted, self._doubted = self._doubted, []
        first, newest = doubted[0], self.newest
        assert newest is not None
        t = first.message.t + self.shift
        if t > newest:
            told = f"{first.where}: nothing came from t={newest:g} to t={t:g}"
        else:
            self.shift += newest + self.pace - t
            back = f"the clock was set back from t={newest:g} to t={t:g}"
            told = f"{first.where}: {back}; from here {self.shift:g} s are added"
        for given in doubted:
            self._passed(given.message.t + self.shift)
        return [Note(told), *map(self._shifted, doubted)]

    def _refused(self) -> list[Item]:
        """The doubted ones were mistakes."""
        doubted, self._doubted = self._doubted, []
        return [Note(self._sentence(given)) for given in doubted]

    def _sentence(self, given: Given) -> str:
        t, newest = given.message.t + self.shift, self.newest
        assert newest is not None
        gap = f"{abs(t - newest):g} s {'after' if t > newest else 'before'} t={newest:g}"
        return f"{given.where} is left out: its time t={t:g} is {gap}, and nothing that follows agrees"

    def _shifted(self, given: Given) -> Given:
        if not self.shift:
            return given
        return replace(given, message=replace(given.message, t=given.message.t + self.shift))
