"""JSON-RPC 2.0 as it stands on a line: requests are read from text, answers and mistakes written as objects.

Source: the specification at jsonrpc.org, 2013. Codes from -32000 down are ours (`CODES`).
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NoReturn, TypeAlias

Id: TypeAlias = str | int | float | None
Params: TypeAlias = Mapping[str, Any] | Sequence[Any]
Answer: TypeAlias = dict[str, Any]

CODES = {
    "parse": -32700,
    "request": -32600,
    "method": -32601,
    "params": -32602,
    "internal": -32603,
    "mistake": -32000,  # a `CasperError`: the sentence says what to mend
    "undefined": -32001,  # neither true nor false
    "unknown": -32002,  # a search stopped at its budget
    "cancelled": -32003,
    "limit": -32004,  # longer than a request may take
}


class ProtocolError(Exception):
    """A request that cannot be answered as it stands: which kind (a key of `CODES`), and a sentence."""

    def __init__(self, kind: str, sentence: str, **data: Any) -> None:
        super().__init__(sentence)
        self.kind, self.sentence, self.data = kind, sentence, data


@dataclass(frozen=True, slots=True)
class Request:
    """What is wanted; ``answers`` is False for a notification. ``mistake`` says why it cannot be worked on."""

    id: Id = None
    method: str = ""
    params: Params = field(default_factory=dict)
    answers: bool = True
    mistake: ProtocolError | None = None


@dataclass(frozen=True, slots=True)
class Message:
    """The requests of a line; those of a batch are answered in one array."""

    requests: tuple[Request, ...]
    is_batch: bool = False


def message_of(line: bytes) -> Message:
    """What a line asks for; a line that is no JSON is a message with one mistake in it."""
    try:
        data = json.loads(line.decode("utf-8"), parse_constant=_no_constant)
    except RecursionError:
        return _wrong("parse", "the line is JSON that is nested too deep")
    except UnicodeDecodeError as mistake:
        return _wrong("parse", f"the line is no UTF-8: byte {mistake.start + 1} is wrong")
    except json.JSONDecodeError as mistake:
        return _wrong("parse", f"the line is no JSON: {mistake.msg} at character {mistake.pos + 1}")
    except ValueError as mistake:
        return _wrong("parse", f"the line is no JSON: {mistake}")
    if not isinstance(data, list):
        return Message((request_of(data),))
    if not data:
        return _wrong("request", "an empty batch asks for nothing")
    return Message(tuple(request_of(one) for one in data), is_batch=True)


def too_long(most: int) -> Message:
    """What is made of a line longer than so many bytes."""
    return _wrong("request", f"the line is longer than {most} bytes; send less at once, or start with a larger --line")


def request_of(data: Any) -> Request:
    """One request from its JSON value."""
    if not isinstance(data, dict):
        return _mistaken(None, "a request is an object with jsonrpc, method and perhaps params and id")
    number = data.get("id")
    if isinstance(number, bool) or not (number is None or isinstance(number, (str, int, float))):
        return _mistaken(None, "an id is a string, a number or null")
    if data.get("jsonrpc") != "2.0":
        return _mistaken(number, 'a request says "jsonrpc": "2.0"')
    method, params = data.get("method"), data.get("params", {})
    if not isinstance(method, str):
        return _mistaken(number, "a request names its method with a string")
    if not isinstance(params, (dict, list)):
        return _mistaken(number, "params are an object or an array")
    return Request(number, method, params, answers="id" in data)


def result(number: Id, value: Any) -> Answer:
    """The answer to a request."""
    return {"jsonrpc": "2.0", "id": number, "result": value}


def failure(number: Id, mistake: ProtocolError) -> Answer:
    """The answer to a request that could not be answered."""
    error: dict[str, Any] = {"code": CODES[mistake.kind], "message": mistake.sentence}
    if mistake.data:
        error["data"] = mistake.data
    return {"jsonrpc": "2.0", "id": number, "error": error}


def line_of(answer: Answer | list[Answer]) -> bytes:
    """An answer as a line."""
    return json.dumps(answer, ensure_ascii=False, separators=(",", ":")).encode("utf-8", "replace") + b"\n"


def _wrong(kind: str, sentence: str) -> Message:
    return Message((Request(mistake=ProtocolError(kind, sentence)),))


def _mistaken(number: Id, sentence: str) -> Request:
    return Request(number, mistake=ProtocolError("request", sentence))


def _no_constant(name: str) -> NoReturn:
    raise ValueError(f"{name} is no number of JSON")
