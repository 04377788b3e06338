"""What is heard of a run, handed to Rerun as it comes: nothing is kept, so a day takes no more memory than a minute.

    log = Log(domain, Path("run.rrd"))
    trial.each_step = lambda: log.see(trial.simulation.truth())
    for event in log.heard(trial.events(), trial.minds):
        …
    log.close()
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from casper.engine.domain.domain import Domain
from casper.engine.events.event import Event
from casper.engine.events.timeline import Timeline
from casper.engine.live.listening import Listener
from casper.engine.live.partners import Partners
from casper.engine.mind import Mind
from casper.engine.perception.world import WorldState
from casper.kb.errors import DomainError
from casper.kb.text.lines import text_of
from casper.report.recorder import evidence_of, spoken
from casper.rrd.bands import show_event
from casper.rrd.layout import layout
from casper.rrd.room import Room
from casper.rrd.why import why
from casper.sim_adapter.room.facts import scene_of

TIME = "time"  # the one time line: seconds from the beginning of the run


class Log(Listener):
    """Writes a run to an .rrd file.

    Args:
        domain: whose room and words.
        path: of the file; what is there is replaced.
    """

    def __init__(self, domain: Domain, path: Path) -> None:
        import rerun

        super().__init__()
        self.domain = domain
        self.stream: Any = rerun.RecordingStream("casper", send_properties=False)
        try:
            scene = scene_of(domain)
        except DomainError:  # a robot that sends world states needs no scene
            scene = None
        agents = (domain.partner, domain.robot) if scene is None else (*scene.people, scene.robot)
        self.stream.save(path, default_blueprint=layout(scene, agents))
        self.stream.set_log_time_enabled(False)
        self.stream.set_log_tick_enabled(False)
        self._room = Room(self.stream, domain.robot, scene)
        self._timeline = Timeline(domain.partner, domain.robot, spoken(domain.kb))

    def seen(self, world: WorldState) -> None:
        """A world state, shown where it is on the time line."""
        self.stream.set_time(TIME, duration=world.t)
        self._room.show(world)

    def take(self, event: Event, minds: Partners | Mind) -> None:
        """An event, while the minds still know what stood behind it."""
        import rerun

        self.stream.set_time(TIME, duration=event.t)
        show_event(self.stream, event)
        if event.type == "focus":
            self._room.attend(event)
        for line in self._timeline.lines(event):
            self.stream.log("told", rerun.TextLog(text_of([line]), level=_level(event)))
        page = why(event, evidence_of(event, minds))
        if page:
            self.stream.log("why", rerun.TextDocument(page, media_type=rerun.MediaType.MARKDOWN))

    def close(self) -> None:
        """Write what is still on its way, and end the file."""
        self.stream.flush()
        self.stream.disconnect()


def _level(event: Event) -> str:
    """How much an entry stands out."""
    refused = event.type == "verdict" and not event.data["valid"]
    failed = event.type == "robot" and event.data["status"] in ("failed", "stopped")
    if refused or failed or event.type == "withdrawn":
        return "WARN"
    return "DEBUG" if event.type in ("focus", "movement") else "INFO"
