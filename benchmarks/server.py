"""Requests a second of ``casper serve``, over a pipe, and that none is lost: python benchmarks/server.py [SECONDS].

Two ways of asking: one at a time (the next request is sent when the answer has come), and a thousand ahead.
"""

from __future__ import annotations

import json
import subprocess
import sys
import time
from collections.abc import Iterator
from itertools import count, islice

MIX = (
    ("verify", ["wash(tiago, plate, sink)"]),
    ("ask", ["agent(tiago)"]),
    ("why_not", ["eat(tiago, meal, plate)"]),
    ("query", ["eat(A, meal, D)"]),
    ("observe", ["pick_and_place(meal, hobs)"]),
    ("posterior", []),
    ("plan_for", ["tiago"]),
    ("undo", []),
    ("assert", ["human(eve)"]),
    ("retract", ["human(eve)"]),
)


def requests() -> Iterator[bytes]:
    for number in count():
        method, params = MIX[number % len(MIX)]
        line = {"jsonrpc": "2.0", "id": number, "method": method, "params": params}
        yield json.dumps(line).encode() + b"\n"


def measured(seconds: float, ahead: int) -> tuple[int, float]:
    """How many requests were answered, each in its turn and without a mistake, and in what time."""
    server = subprocess.Popen(
        [sys.executable, "-m", "casper", "serve", "kitchen"], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    )
    assert server.stdin is not None and server.stdout is not None
    lines, answered = requests(), 0
    server.stdin.write(next(lines))
    server.stdin.flush()
    server.stdout.readline()  # loaded
    expected, start = 1, time.monotonic()
    while time.monotonic() - start < seconds:
        server.stdin.write(b"".join(islice(lines, ahead)))
        server.stdin.flush()
        for _ in range(ahead):
            answer = json.loads(server.stdout.readline())
            assert answer["id"] == expected and "error" not in answer, answer
            expected += 1
            answered += 1
    took = time.monotonic() - start
    server.stdin.close()
    assert server.stdout.read() == b"" and server.wait() == 0
    return answered, took


def main(seconds: float) -> None:
    kinds = ", ".join(method for method, _ in MIX)
    print(f"casper serve kitchen, {seconds:g} s each, a mix of {kinds}")
    for name, ahead in (("one at a time", 1), ("a thousand ahead", 1000)):
        answered, took = measured(seconds, ahead)
        rate = answered / took
        print(f"  {name:<18} {rate:8,.0f} requests a second; {answered:,} sent and answered, 0 lost")


if __name__ == "__main__":
    main(float(sys.argv[1]) if len(sys.argv) > 1 else 60.0)
