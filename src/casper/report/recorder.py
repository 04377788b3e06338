"""Records a run while it happens: events, world states, and the evidence that nobody could give afterwards.

    recorder = Recorder(domain)
    trial.each_step = lambda: recorder.see(trial.simulation.truth())
    for event in recorder.heard(trial.events(), trial.minds):
        …
    recorder.recording()

What is kept is bounded, so that a day of watching makes a page that opens: world states and the events of every step
are thinned out evenly, and of the others the last ones are left out. The page says how many.
"""

from __future__ import annotations

from collections.abc import Iterator

from casper.engine.domain.domain import Domain
from casper.engine.events.event import Event
from casper.engine.live.listening import Listener
from casper.engine.live.partners import Partners
from casper.engine.mind import Mind
from casper.engine.perception.world import WorldState
from casper.engine.reading.reading import Reading
from casper.kb.base import KnowledgeBase
from casper.kb.errors import CasperError
from casper.kb.reasons.says import SAYS, Words, words_of
from casper.kb.text.reader import read_statement
from casper.report.recording import NO_EVIDENCE, Evidence, Recording
from casper.report.rooms import room_of
from casper.report.thinned import Thinned

MOST_STATES = 2_000
MOST_OF_A_STEP = 2_000  # events of each type that every step has
MOST_EVENTS = 2_000  # of all other types
EVERY_STEP = ("focus", "movement")
TOP = 2  # explanations of a reading


class Recorder(Listener):
    """What was recorded so far of a domain's run."""

    def __init__(self, domain: Domain) -> None:
        super().__init__()
        self.domain, self.room, self.words = domain, room_of(domain), spoken(domain.kb)
        self._states: Thinned[WorldState] = Thinned(MOST_STATES)
        self._often: dict[str, Thinned[tuple[int, Event]]] = {kind: Thinned(MOST_OF_A_STEP) for kind in EVERY_STEP}
        self._seldom: list[tuple[int, Event, Evidence]] = []
        self._number = 0
        self._lost: dict[str, int] = {}

    def seen(self, world: WorldState) -> None:
        """A world state, kept."""
        self._states.add(world)

    def take(self, event: Event, minds: Partners | Mind) -> None:
        """An event, while the minds still know what stood behind it."""
        if event.type in EVERY_STEP:
            self._often[event.type].add((self._number, event))
        elif len(self._seldom) < MOST_EVENTS or event.type == "summary":
            self._seldom.append((self._number, event, evidence_of(event, minds)))
        else:
            self._lost[event.type] = self._lost.get(event.type, 0) + 1
        self._number += 1

    def recording(self) -> Recording:
        """Everything up to now."""
        often = ((number, event, NO_EVIDENCE) for series in self._often.values() for number, event in series)
        rows = sorted((*self._seldom, *often), key=lambda row: row[0])
        thinned = {kind: series.left_out for kind, series in self._often.items() if series.left_out}
        people = dict.fromkeys(name for _, event, _ in rows for name in _partners_of(event))
        return Recording(
            domain=self.domain.name,
            partners=tuple(people) or (self.domain.partner,),
            robot=self.domain.robot,
            events=tuple(event for _, event, _ in rows),
            states=tuple(self._states),
            evidence={at: row[2] for at, row in enumerate(rows) if row[2] != NO_EVIDENCE},
            room=self.room,
            words=self.words,
            left_out={**thinned, **self._lost},
        )


def spoken(kb: KnowledgeBase) -> Words:
    """The author's words in the language that was chosen; English where none was, for a page is for everybody."""
    if kb.words or kb.language:
        return kb.words
    return words_of((clause for indicator in SAYS for clause in kb.clauses_of(indicator)), "en")


def evidence_of(event: Event, minds: Partners | Mind) -> Evidence:
    """What stands behind a verdict or a reading that has just been made."""
    mind = _mind_of(event, minds)
    if mind is None:
        return NO_EVIDENCE
    try:
        if event.type == "verdict":
            return _judged(event, mind)
        if event.type == "reading":
            return _read(event, minds)
    except CasperError:  # no proof within the budget: the verdict stands without
        pass
    return NO_EVIDENCE


def _judged(event: Event, mind: Mind) -> Evidence:
    kb, data = mind.domain.kb, event.data
    if data["valid"]:
        return Evidence(proof=kb.why(read_statement(data["completed"])))
    earlier = [done for done in mind.history if done[1] < event.t] if kb.depends_on_history else ()
    refusal = kb.why_not(read_statement(data["statement"]), earlier)
    told = refusal is not None and list(refusal.reasons) == data["reasons"]
    return Evidence(refusal=refusal) if told else NO_EVIDENCE


def _read(event: Event, minds: Partners | Mind) -> Evidence:
    """The explanations of the reading that the event tells of; none where it has gone on, or away, since."""
    wanted, names = event.data, [str(seen) for seen in event.data["observations"]]
    for reading in _readings(minds):
        same = [str(seen) for seen in reading.observations] == names and reading.count == wanted["explanations"]
        if same and dict(reading.posterior) == wanted["posterior"]:
            return Evidence(explanations=tuple(reading.best(TOP)))
    return NO_EVIDENCE


def _readings(minds: Partners | Mind) -> Iterator[Reading]:
    for mind in _minds(minds):
        supervisors = (*mind.course.supervisors, mind.course.predicted)
        yield from (s.reading for s in supervisors if s is not None and isinstance(s.reading, Reading))


def _minds(minds: Partners | Mind) -> list[Mind]:
    return [minds] if isinstance(minds, Mind) else list(minds.minds.values())


def _mind_of(event: Event, minds: Partners | Mind) -> Mind | None:
    name = event.data.get("agent")
    return next((mind for mind in _minds(minds) if mind.partner == name), None)


def _partners_of(event: Event) -> Iterator[str]:
    if event.type in ("focus", "reading") and isinstance(event.data.get("agent"), str):
        yield event.data["agent"]
