"""Requests a second of ``casper serve kitchen``, and that none is lost: python benchmarks/server.py [SECONDS].

Two mixes. *Questions* change nothing, as a planner asks that tries out its actions: each statement is asked for its
truth, judged, proved and refused. *Everything* is the round of a robot: it judges, asks and observes, looks at shares
and at its part of the plan, takes the observation back, and adds and removes a fact: then all is worked out anew.

Two ways of asking: one at a time (the next request is sent when the answer has come), and a thousand ahead. The rate by
the clock is that of this machine with whatever else runs on it. The rate of the processor counts the seconds that the
server itself worked (on Linux), without its start.
"""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from itertools import count, islice
from pathlib import Path
from typing import TypeAlias

Mix: TypeAlias = Sequence[tuple[str, list[str]]]
ASKED = "wash(tiago, plate, sink)", "eat(tiago, meal, plate)", "pick_and_place(human, biscuits, plate)", "agent(tiago)"
WAYS_TO_ASK = "ask", "truth", "verify", "why", "why_not"
QUESTIONS: Mix = [(method, [statement]) for statement in ASKED for method in WAYS_TO_ASK]
EVERYTHING: Mix = [
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
]
MIXES = {"questions": QUESTIONS, "everything": EVERYTHING}
WAYS = {"one at a time": 1, "a thousand ahead": 1000}


def requests(mix: Mix) -> Iterator[bytes]:
    """Lines without end."""
    for number in count():
        method, params = mix[number % len(mix)]
        line = {"jsonrpc": "2.0", "id": number, "method": method, "params": params}
        yield json.dumps(line).encode() + b"\n"


def worked(process: int) -> float:
    """Seconds of the processor that a process has used; nan where the system does not tell."""
    try:
        fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return math.nan
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def measured(mix: Mix, seconds: float, ahead: int) -> tuple[int, float, float]:
    """How many requests were answered, in their turn and without a mistake; seconds of the clock and of the server."""
    command = [sys.executable, "-m", "casper", "serve", "kitchen"]
    server = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert server.stdin is not None and server.stdout is not None
    lines, expected = requests(mix), 0

    def exchange(many: int) -> None:
        nonlocal expected
        server.stdin.write(b"".join(islice(lines, many)))  # type: ignore[union-attr]
        server.stdin.flush()  # type: ignore[union-attr]
        for _ in range(many):
            answer = json.loads(server.stdout.readline())  # type: ignore[union-attr]
            assert answer["id"] == expected and "error" not in answer, answer
            expected += 1

    exchange(len(mix))  # loaded, and everything asked once
    start, begin = time.monotonic(), worked(server.pid)
    while time.monotonic() - start < seconds:
        exchange(ahead)
    took, used = time.monotonic() - start, worked(server.pid) - begin
    server.stdin.close()
    assert server.stdout.read() == b"" and server.wait() == 0
    return expected - len(mix), took, used


def main(seconds: float) -> None:
    print(f"casper serve kitchen, {seconds:g} s each")
    for name, mix in MIXES.items():
        print(f"  {name}: {', '.join(dict.fromkeys(method for method, _ in mix))}")
        for way, ahead in WAYS.items():
            answered, took, used = measured(mix, seconds, ahead)
            print(
                f"    {way:<17} {answered / took:7,.0f} a second by the clock, {answered / used:7,.0f} a second "
                f"of the processor; {answered:,} sent and answered, 0 lost"
            )


if __name__ == "__main__":
    main(float(sys.argv[1]) if len(sys.argv) > 1 else 60.0)
