"""``casper serve`` as other programs see it: a process with a pipe to either side."""

import json
import os
import shutil
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent.parent
ENDLESS = "n(0). n(s(X)) :- n(X). far(X) :- n(X), X = never."


class Served:
    """A running server, spoken to line by line."""

    def __init__(self, domain: str, *options: str) -> None:
        command = [sys.executable, "-m", "casper", "serve", domain, *options]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)

    def send(self, *lines: str | bytes) -> None:
        for line in lines:
            self.process.stdin.write((line.encode() if isinstance(line, str) else line) + b"\n")
        self.process.stdin.flush()

    def next(self) -> dict:
        return json.loads(self.process.stdout.readline())

    def end(self) -> list[dict]:
        rest, _ = self.process.communicate(timeout=60)
        return [json.loads(line) for line in rest.splitlines()]


def call(method: str, id: int, *params) -> str:
    return json.dumps({"jsonrpc": "2.0", "id": id, "method": method, "params": list(params)})


@pytest.fixture
def endless(tmp_path: Path) -> str:
    (tmp_path / "ontology.pl").write_text(ENDLESS, encoding="utf-8")
    return str(tmp_path)


def test_every_request_is_answered_in_order_and_the_end_of_the_input_ends_it() -> None:
    served = Served("kitchen")
    served.send(*(call("verify", number, "wash(tiago, plate, sink)") for number in range(2000)))
    assert [answer["id"] for answer in served.end()] == list(range(2000))
    assert served.process.returncode == 0


def test_a_truncated_line_a_line_of_ten_megabytes_and_an_unknown_method_are_survived() -> None:
    served = Served("kitchen", "--line", "1000000")
    served.send('{"jsonrpc": "2.0", "id": 1, "met', b"x" * 10_000_000, call("wish", 3), call("ask", 4, "agent(tiago)"))
    codes = [answer.get("error", {}).get("code") for answer in served.end()]
    assert codes == [-32700, -32600, -32601, None]


def test_a_line_of_ten_megabytes_that_is_allowed_is_read() -> None:
    served = Served("kitchen")
    served.send(call("ask", 1, "agent(" + "x" * 10_000_000 + ")"), call("ask", 2, "agent(tiago)"))
    assert [answer["result"] for answer in served.end()] == [False, True]


def test_a_running_request_can_be_cancelled_and_so_can_one_that_waits(endless: str) -> None:
    served = Served(endless)
    served.send(call("query", 1, "far(X)"), call("query", 2, "far(X)"), call("ask", 3, "n(0)"))
    served.send(call("cancel", 4, 2), call("cancel", 5, 1), call("cancel", 6, 99))
    answers = {answer["id"]: answer for answer in served.end()}
    assert answers[1]["error"]["code"] in (-32003, -32002) and answers[2]["error"]["code"] == -32003
    assert answers[3]["result"] is True
    assert answers[4]["result"] is True and answers[6]["result"] is False


def test_a_question_that_takes_too_long_is_stopped_and_unknown(endless: str) -> None:
    served = Served(endless, "--limit", "0.05")
    served.send(call("query", 1, "far(X)"), call("ask", 2, "n(s(0))"))
    first, second = served.end()
    assert first["error"]["code"] in (-32004, -32002) and second["result"] is True


def test_what_is_cancelled_changes_no_later_answer() -> None:
    served = Served("kitchen")
    for number in range(0, 300, 3):
        served.send(call("query", number, "valid(S)"), call("cancel", number + 1, number), call("query", number + 2, "valid(S)"))
    answers = {answer["id"]: answer for answer in served.end()}
    whole = {json.dumps(answers[number]["result"]) for number in range(2, 300, 3)}
    assert len(whole) == 1


def test_a_reader_that_goes_away_ends_the_server_without_a_traceback() -> None:
    command = [sys.executable, "-m", "casper", "serve", "kitchen"]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    process.stdout.close()
    for number in range(100):
        try:
            process.stdin.write(call("verify", number, "wash(tiago, plate, sink)").encode() + b"\n")
            process.stdin.flush()
        except BrokenPipeError:
            break
    with suppress(BrokenPipeError):
        process.stdin.close()
    assert b"Traceback" not in process.stderr.read()
    process.stderr.close()
    process.wait(timeout=60)


def test_without_a_domain_it_says_what_to_do() -> None:
    done = subprocess.run([sys.executable, "-m", "casper", "serve"], capture_output=True, text=True)
    assert done.returncode == 2 and "casper serve DOMAIN" in done.stderr


@pytest.mark.skipif(shutil.which("node") is None, reason="the JavaScript client needs node")
def test_the_client_in_javascript_asks_observes_and_is_told_of_mistakes(tmp_path: Path) -> None:
    command = tmp_path / "casper"
    command.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m casper "$@"\n', encoding="utf-8")
    command.chmod(0o755)
    client = ["node", str(ROOT / "examples/client.mjs"), "kitchen"]
    done = subprocess.run(client, capture_output=True, text=True, env={**os.environ, "CASPER": str(command)}, timeout=60)
    assert done.returncode == 0, done.stderr
    assert "the goal is lunch" in done.stdout and "then wash(plate, sink)" in done.stdout
    assert "did you mean wash?" in done.stdout
