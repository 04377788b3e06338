"""JSON-RPC 2.0 on lines: what is a request, what is a mistake, and what is said of it."""

import json
from io import BytesIO

import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper.engine.domain.domain import Domain
from casper.server.lines import bounded_lines
from casper.server.protocol import line_of, message_of
from casper.server.serving import Server

KITCHEN = Domain.load("kitchen")


def said(*lines: bytes | str, **options) -> list:
    """What a fresh server answers to some lines."""
    source = b"".join((line.encode() if isinstance(line, str) else line) + b"\n" for line in lines)
    sink = BytesIO()
    Server(KITCHEN, **options).serve(BytesIO(source), sink)
    return [json.loads(line) for line in sink.getvalue().splitlines()]


def call(method: str, *params, id=1, **named) -> str:
    return json.dumps({"jsonrpc": "2.0", "id": id, "method": method, "params": list(params) or named})


def test_a_request_is_answered_under_its_id() -> None:
    asked = call("ask", "wash(tiago, plate, sink)", id="seven")
    assert said(asked) == [{"jsonrpc": "2.0", "id": "seven", "result": True}]


def test_a_notification_is_worked_on_and_not_answered() -> None:
    note = '{"jsonrpc":"2.0","method":"observe","params":["pick_and_place(meal, hobs)"]}'
    (answer,) = said(note, call("posterior"))
    assert answer["result"]["lunch"] == 1.0


def test_the_requests_of_a_batch_are_answered_in_one_array_without_the_notifications() -> None:
    note = '{"jsonrpc":"2.0","method":"undo"}'
    batch = f"[{call('observe', 'eat', id=1)}, {note}, {call('posterior', id=2)}, 5]"
    ((first, second, third),) = said(batch)
    assert [first["id"], second["id"], third["id"]] == [1, 2, None]
    assert set(second["result"].values()) == {0.0} and third["error"]["code"] == -32600


def test_a_batch_of_notifications_is_answered_with_nothing() -> None:
    assert said('[{"jsonrpc":"2.0","method":"check"}]') == []


@pytest.mark.parametrize(
    "line, code, word",
    [
        ('{"jsonrpc": "2.0", "id": 1, "meth', -32700, "no JSON"),
        (b"\xff\xfe", -32700, "UTF-8"),
        ('{"jsonrpc": "2.0", "id": NaN, "method": "ask"}', -32700, "NaN"),
        ("[" * 100_000, -32700, "nested too deep"),
        ("[]", -32600, "empty batch"),
        ('"ask"', -32600, "object"),
        ('{"id": 1, "method": "ask"}', -32600, "jsonrpc"),
        ('{"jsonrpc": "2.0", "id": [1], "method": "ask"}', -32600, "id"),
        ('{"jsonrpc": "2.0", "id": true, "method": "ask"}', -32600, "id"),
        ('{"jsonrpc": "2.0", "id": 1, "method": 3}', -32600, "string"),
        ('{"jsonrpc": "2.0", "id": 1, "method": "ask", "params": "x"}', -32600, "params"),
        (call("aks", "rain"), -32601, "there are ask, query"),
        (call("ask"), -32602, "statement is missing"),
        (call("ask", 5), -32602, "statement is a string"),
        (call("query", "p(X)", True), -32602, "limit is a whole number"),
        (call("ask", "a", "b"), -32602, "it takes statement"),
        (call("ask", statment="a"), -32602, "'statment'"),
        (call("observe", {"eat": "often"}), -32602, "an object of numbers"),
        (call("ask", "wahs(tiago)"), -32000, "did you mean wash?"),
        (call("frontier", reading="eve"), -32000, "open it first"),
        (call("open", noise=7.0), -32000, "factor above 0"),
    ],
)
def test_a_mistake_is_told_in_a_sentence_and_the_next_request_is_answered(line, code: int, word: str) -> None:
    wrong, right = said(line, call("truth", "wash(tiago, plate, sink)"))
    assert wrong["error"]["code"] == code and word in wrong["error"]["message"]
    assert right["result"] == "true"


def test_a_mistake_in_a_text_tells_its_place() -> None:
    (answer,) = said(call("ask", "wash("))
    assert answer["error"]["data"]["column"] == 6 and "^" in answer["error"]["data"]["excerpt"]


def test_a_line_that_is_too_long_is_skipped_and_told() -> None:
    wrong, right = said(call("ask", "x" * 1000), call("posterior"), longest_line=200)
    assert "longer than 200 bytes" in wrong["error"]["message"] and "result" in right


def test_the_last_line_may_lack_its_end() -> None:
    sink = BytesIO()
    Server(KITCHEN).serve(BytesIO(call("undo").encode()), sink)
    assert json.loads(sink.getvalue())["error"]["message"] == "there is no observation to take back"


@given(st.lists(st.binary(max_size=30), max_size=8), st.integers(1, 40))
def test_lines_within_the_bound_are_given_whole_and_the_others_counted(parts: list[bytes], most: int) -> None:
    texts = [part.replace(b"\n", b"") for part in parts]
    found = list(bounded_lines(BytesIO(b"\n".join(texts)), most))
    expected = [(t.strip() or b"") if len(t) <= most else None for t in texts]
    assert found == [t for t in expected if t is None or t]


@given(st.recursive(st.none() | st.booleans() | st.integers() | st.text(), lambda x: st.lists(x) | st.dictionaries(st.text(), x)))
def test_any_json_is_a_message_that_can_be_answered(value) -> None:
    answers = Server(KITCHEN).answers(message_of(json.dumps(value).encode()))
    assert all(json.loads(line_of(answer)) == answer for answer in answers)


@given(st.binary())
def test_any_bytes_are_a_message_that_can_be_answered(line: bytes) -> None:
    for answer in Server(KITCHEN).answers(message_of(line)):
        assert "error" in answer
