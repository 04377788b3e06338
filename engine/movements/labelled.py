"""Labelled recordings of one's own: JSON lines, CSV or Parquet, for `casper train --trace`.

JSON lines are world states with ``"movement"``, what was done at that moment; a file is a trial, or each ``"trial"`` in
it; ``"level"`` may name the sensor. CSV and Parquet have the columns of `casper.qsr.traces.reading` with the same three
beside, in the rows of the partner; who has a heading is an agent.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from casper.engine.movements.watching import Recording
from casper.engine.perception.world import AgentState, ObjectState, WorldState, json_object, world_state_from_json
from casper.kb.errors import CasperError, DomainError, TraceError
from casper.kb.text.files import read_utf8
from casper.qsr.traces.reading import from_rows
from casper.qsr.traces.trace import Trace

Row = Mapping[str, Any]
Moment = tuple[WorldState, str | None]


def read_labelled(files: Sequence[Path], partner: str) -> list[Recording]:
    """The recordings of some files; trials are numbered through.

    Raises:
        DomainError: a file that cannot be read, or in which nothing is labelled. WorldStateError, TraceError: a mistake
            in it. The sentence has file and line.
    """
    found: list[Recording] = []
    trials: dict[tuple[str, str], int] = {}
    for file in files:
        kept: dict[tuple[str, str], list[Moment]] = {}
        for trial, level, moment in _moments(file, partner):
            kept.setdefault((trial, level), []).append(moment)
        if not any(label for moments in kept.values() for _, label in moments):
            raise DomainError(f'{file} has no labels: say what was done under "movement", with {partner} in view')
        for (trial, level), moments in kept.items():
            number = trials.setdefault((str(file), trial), len(trials))
            labels = [(state.t, label) for state, label in moments]
            found.append(Recording(number, [state for state, _ in moments], labels, level))
    return found


def _moments(file: Path, partner: str) -> Iterator[tuple[str, str, Moment]]:
    if file.suffix == ".csv":
        yield from _of_rows(list(_csv(file)), partner, str(file))
    elif file.suffix == ".parquet":
        yield from _of_rows(_parquet(file), partner, str(file))
    else:
        yield from _of_lines(file)


def _of_lines(file: Path) -> Iterator[tuple[str, str, Moment]]:
    try:
        lines = read_utf8(file).splitlines()
    except OSError as mistake:
        raise DomainError(f"{file} cannot be read ({mistake.strerror or mistake})") from None
    for number, line in enumerate(lines, 1):
        if not line.strip():
            continue
        try:
            data = json_object(line)
            label = _label(data.get("movement"))
            yield str(data.get("trial", "")), str(data.get("level", "")), (world_state_from_json(data), label)
        except CasperError as mistake:
            raise type(mistake)(f"{file}:{number}: {mistake.sentence}") from None


def _label(given: Any) -> str | None:
    if given is None or given == "" or given != given:
        return None
    if not isinstance(given, str):
        raise DomainError(f"{given!r:.40} is no movement")
    return given


# --- tables --------------------------------------------------------------------------------------------------------


def _csv(file: Path) -> Iterator[tuple[str, Row]]:
    try:
        with file.open(newline="", encoding="utf-8-sig") as text:
            table = csv.DictReader(text)
            for row in table:
                yield f"{file}:{table.line_num}", row
    except (OSError, UnicodeDecodeError, csv.Error) as mistake:
        raise TraceError(f"{file} cannot be read as CSV: {mistake}") from None


def _parquet(file: Path) -> list[tuple[str, Row]]:
    try:
        import pyarrow.parquet as parquet
    except ImportError:
        raise TraceError("to read Parquet, install casper-hri[tables]") from None
    try:
        rows = parquet.read_table(file).to_pylist()
    except (OSError, ValueError) as mistake:
        raise TraceError(f"{file} cannot be read as Parquet: {str(mistake).splitlines()[0]}") from None
    return [(f"{file}, row {number}", row) for number, row in enumerate(rows, 1)]


def _of_rows(rows: Sequence[tuple[str, Row]], partner: str, file: str) -> Iterator[tuple[str, str, Moment]]:
    groups: dict[tuple[str, str], list[tuple[str, Row]]] = {}
    for place, row in rows:
        groups.setdefault((str(row.get("trial") or ""), str(row.get("level") or "")), []).append((place, row))
    for (trial, level), found in groups.items():
        trace = from_rows((row for _, row in found), (place for place, _ in found))
        labels = {float(row["t"]): _label(row.get("movement")) for _, row in found if row.get("name") == partner}
        for state in states_of(trace, partner, file):
            yield trial, level, (state, labels.get(state.t))


def states_of(trace: Trace, partner: str, file: str = "the trace") -> Iterator[WorldState]:
    """The world states of a trace: who has a heading (radians) is an agent, all else are things.

    Raises:
        TraceError: the partner has no heading.
    """
    index = trace.index(partner)
    if trace.heading is None or not any(not math.isnan(h) for h in trace.heading[index].tolist()):
        raise TraceError(f"{file}: {partner} has no heading, so there is no way to tell where {partner} looks")
    for at, t in enumerate(trace.t.tolist()):
        agents, objects = {}, {}
        for i, name in enumerate(trace.names):
            if trace.present is not None and not trace.present[i, at]:
                continue
            where = [float(axis[i, at]) for axis in trace.where]
            heading = float(trace.heading[i, at])
            if not math.isnan(heading):
                held = -1 if trace.held is None else int(trace.held[i, at])
                agents[name] = AgentState(where[0], where[1], heading, trace.names[held] if held >= 0 else None)
            else:
                z = where[2] if len(where) == 3 and not math.isnan(where[2]) else None
                objects[name] = ObjectState(where[0], where[1], z)
        yield WorldState(t, agents, objects)
