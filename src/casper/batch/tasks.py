"""What is done with one row: a table of tasks, each a function of a domain, a row and the options.

A task names the column it works on and those it gives; all rows of a task have the same columns, whatever they hold.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias

from casper.batch.rows import Row, others, text_of, texts_of, wanted
from casper.batch.simulated import GIVES, simulated
from casper.engine.domain.domain import Domain
from casper.engine.live import Partners
from casper.kb.errors import CasperError
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import as_term
from casper.streams.order.window import usual_window
from casper.streams.sources.files import File
from casper.streams.watching import watched

Result: TypeAlias = dict[str, Any]
AHEAD = 64  # world states of a recording that are read at once


@dataclass(frozen=True, slots=True)
class Task:
    """What is done: ``key`` is the column that is worked on, ``gives`` are the columns of the result.

    ``together`` is how many rows are worked on at most before their results are handed over.
    """

    name: str
    key: str
    gives: tuple[str, ...]
    work: Callable[[Domain, Any, Mapping[str, Any]], Result]
    together: int = 500


def worked(task: Task, domain: Domain, row: Row, options: Mapping[str, Any]) -> Result:
    """The result of a row: its number, what else it has, the task's columns, and ``mistake`` (None, or a sentence)."""
    told: Result = {"row": row.number, **dict(others(row, task.key, (*task.gives, "mistake")))}
    nothing = dict.fromkeys(task.gives)
    try:
        if row.mistake:
            raise CasperError(row.mistake)
        return {**told, **nothing, **task.work(domain, wanted(row, task.key), options), "mistake": None}
    except CasperError as mistake:
        return {**told, **nothing, "mistake": str(mistake)}
    except RecursionError:
        return {**told, **nothing, "mistake": "this goes too deep to be answered"}


def _explain(domain: Domain, actions: Any, options: Mapping[str, Any]) -> Result:
    reading = domain.reading(**options)
    seen = texts_of(actions, "actions")
    for action in seen:
        reading.observe(action)
    best = reading.first
    return {
        "actions": seen,
        "outcome": reading.outcome,
        "confidence": reading.confidence,
        "explanations": str(reading.count) if reading.count >= 1 << 63 else reading.count,
        "best": None if best is None else best.goal,
        "posterior": dict(reading.posterior),
        "frontier": [term_text(as_term(action)) for action in reading.frontier],
    }


def _verify(domain: Domain, statement: Any, options: Mapping[str, Any]) -> Result:
    text = text_of(statement, "statement")
    verdict = domain.kb.verify(text)
    return {
        "statement": text,
        "valid": verdict.valid,
        "completed": repr(verdict.completed) if verdict.valid else None,
        "reasons": list(verdict.reasons),
    }


def _watch(domain: Domain, recording: Any, options: Mapping[str, Any]) -> Result:
    """A recording is a file of world states, one JSON object a line, as ``casper watch`` reads it."""
    file = Path(text_of(recording, "recording"))
    summary, left_out = {}, 0
    lines, window = File(file).items(), usual_window(is_live=False)
    for event in watched(Partners(domain, **options), lines, window=window, ahead=AHEAD):
        if event.type == "warning" and " is left out: " in event.data["message"]:
            left_out += 1
        elif event.type == "summary":
            summary = dict(event.data)
    robot = summary["robot"]
    told = {name: summary[name] for name in WATCH.gives if name in summary}
    return {**told, "recording": str(file), "robot": list(robot["actions"]), "left_out": left_out}


EXPLAIN = Task(
    "explain",
    "actions",
    ("actions", "outcome", "confidence", "explanations", "best", "posterior", "frontier"),
    _explain,
)
VERIFY = Task("verify", "statement", ("statement", "valid", "completed", "reasons"), _verify)
WATCH = Task(
    "watch",
    "recording",
    ("recording", "predicted", "prediction_time", "observed", "missed", "waiting", "planned", "robot", "left_out"),
    _watch,
)
TRIAL = Task("trial", "trial", GIVES, simulated, together=1)
TASKS = {task.name: task for task in (EXPLAIN, VERIFY, WATCH, TRIAL)}
