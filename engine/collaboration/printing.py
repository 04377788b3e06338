"""What a supervisor is shown as: the goal that is believed in, and what the robot does for it."""

from __future__ import annotations

from collections.abc import Iterator

from casper.engine.collaboration.supervisor import Supervisor
from casper.engine.events.entries import Names
from casper.engine.events.printing import plan_lines, prediction_lines
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import as_term
from casper.kb.text.lines import Line


def supervisor_lines(supervisor: Supervisor, names: Names) -> Iterator[Line]:
    """The prediction and the robot's part, as far as there are any."""
    made = supervisor.commitment
    if made is None:
        return
    yield from prediction_lines(made.t, {"goal": made.goal, **supervisor.summary()}, names)
    if supervisor.robot is not None:
        waiting, actions = (
            [term_text(as_term(action)) for action in part] for part in (supervisor.waiting, supervisor.actions)
        )
        yield from plan_lines(supervisor.robot, waiting, actions, supervisor.reading.tell)
