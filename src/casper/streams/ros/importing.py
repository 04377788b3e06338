"""``casper import FILE.mcap FOLDER``: world states as lines of JSON, and what there is to say about the recording."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain
from pathlib import Path

from casper.engine.perception.world import WorldState, world_state_to_json
from casper.kb.checks.finding import Finding, Severity
from casper.kb.errors import DomainError, Place
from casper.streams.ros.containers import Container
from casper.streams.ros.messages import KINDS, told
from casper.streams.ros.names import Names
from casper.streams.ros.worlds import Worlds

PERIOD = 0.1  # seconds from one world state to the next
FEW = 8  # names that are listed


@dataclass(frozen=True)
class Recordings:
    """MCAP files that can be written as world states, each as a file of its own.

    Args:
        files: ``.mcap`` files.
        names: what frames and classes are called.
        period: seconds from one world state to the next.
    """

    files: Sequence[Path]
    names: Names
    period: float = PERIOD

    def write(self, folder: Path, *, replace: bool = False) -> list[Finding]:
        """Write them; what was not read comes back, an error where nothing could be.

        Raises:
            DomainError: a file is there already, or cannot be written. CasperError: a file is no MCAP.
        """
        targets = [folder / f"{file.stem}.jsonl" for file in self.files]
        for at, target in enumerate(targets):
            if (target.exists() and not replace) or target in targets[:at]:
                raise DomainError(f"{target} is there already; choose another folder, or write --replace")
        findings: list[Finding] = []
        try:
            folder.mkdir(parents=True, exist_ok=True)
            for file, target in zip(self.files, targets):
                findings += _converted(file, target, self.names, self.period)
        except OSError as mistake:
            raise DomainError(f"cannot write to {folder} ({mistake}); choose another folder") from None
        return findings


def _converted(file: Path, target: Path, names: Names, period: float) -> list[Finding]:
    container, worlds = Container(file, KINDS), Worlds(names, period)
    found = _worlds(container, worlds)
    first = next(found, None)  # a file that is none is refused before anything is written
    states = 0
    with target.open("w", encoding="utf-8") as out:
        for world in () if first is None else chain([first], found):
            states += 1
            out.write(json.dumps(world_state_to_json(world), ensure_ascii=False) + "\n")
    place = Place(str(file))
    return [Finding(place, severity, message) for severity, message in _findings(container, worlds, states)]


def _worlds(container: Container, worlds: Worlds) -> Iterator[WorldState]:
    for heard in container.messages():
        for said in told(heard):
            if said is None:
                worlds.count(f"pose on {heard.topic} is none: NaN or infinite")
            else:
                yield from worlds.take(said)
    yield from worlds.rest()


def _findings(container: Container, worlds: Worlds, states: int) -> Iterator[tuple[Severity, str]]:
    """What there is to say, the worst first."""
    names = worlds.names
    if not states:
        yield Severity.ERROR, "nothing in it tells where anybody or anything is; is it of tf2_msgs and vision_msgs?"
    elif not worlds.met & set(names.agents.values()):
        wanted = ", ".join(names.agents)
        yield Severity.ERROR, f"nobody is in it: no frame and no detection is called {wanted}; say with --names who is"
    for problem in container.problems:
        yield Severity.WARNING, problem
    wanted_names = (*names.agents.items(), *names.objects.items(), *names.several.items())
    absent = [label for label, name in wanted_names if name not in worlds.met]
    if states and absent and names.is_complete:
        yield Severity.WARNING, f"no frame and no detection is called {_listed(absent)}"
    for what, count in sorted(worlds.counts.items()):
        yield Severity.WARNING, f"{'once' if count == 1 else f'{count:,} times'}: {what}"
    numbered = [name for name in names.several.values() if name in worlds.met]
    if numbered:
        advice = "read it by a domain with setting(tracking, association, nearest)"
        yield Severity.NOTE, f"{_listed(numbered)} is numbered as it is detected; {advice}"
    if worlds.nameless:
        yield Severity.NOTE, f"detections without a name are left out: {_listed(sorted(worlds.nameless))}"
    for (topic, kind), count in sorted(container.unread.items()):
        yield Severity.NOTE, f"{topic} ({kind or 'of no type'}) is not read: {count:,} messages"
    if states:
        yield Severity.NOTE, f"{states:,} world states in the frame {worlds.fixed}; t counts from {worlds.start:.3f} s"


def _listed(labels: Sequence[str]) -> str:
    more = f" and {len(labels) - FEW} more" if len(labels) > FEW else ""
    return ", ".join(labels[:FEW]) + more
