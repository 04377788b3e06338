"""Lines of JSON to world states and reports; a line that is neither becomes a sentence."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from casper.engine.live import Message, message_from_json
from casper.engine.live.decoding import plain_world_state
from casper.engine.perception.world import json_object
from casper.kb.errors import ReadError, WorldStateError
from casper.streams.items import Given, Item, Line, Note
from casper.streams.sources.lines import check_line

KEPT = ("recording", "told", "end")
"""Types of lines that recordings have beside what a mind takes in; whoever watches passes them over."""


def messages(lines: Iterable[Line | Note]) -> Iterator[Item]:
    """What lines hold."""
    for line in lines:
        if isinstance(line, Note):
            yield line
            continue
        try:
            check_line(line.text)
            message: Message | None = plain_world_state(line.text)
            if message is None:
                data = json_object(line.text)
                if "agents" not in data and data.get("type") in KEPT:
                    continue
                message = message_from_json(data)
        except (WorldStateError, ReadError) as mistake:
            yield Note(_left_out(line, mistake.sentence))
            continue
        yield Given(message, line.number, line.file)


def _left_out(line: Line, why: str) -> str:
    if line.is_whole:
        return f"{line.where} is left out: {why}"
    return f"{line.where} is left out: it is cut off, and so is what should follow ({why})"
