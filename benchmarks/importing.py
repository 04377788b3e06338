"""How long ``import casper`` takes, and loading the kitchen: python benchmarks/importing.py [TIMES].

Each time in a process of its own. By the processor, the start of Python itself left out; the quickest counts, for the
others had to wait for the disk or for whatever else ran.
"""

from __future__ import annotations

import subprocess
import sys

WHAT = {"import casper": 100, "from casper import Domain; Domain.load('kitchen')": None}  # promised milliseconds
TIMED = "import time; begin = time.process_time(); {}; print((time.process_time() - begin) * 1000)"


def quickest(code: str, times: int) -> float:
    """Milliseconds."""
    command = [sys.executable, "-c", TIMED.format(code)]
    return min(float(subprocess.run(command, capture_output=True, text=True, check=True).stdout) for _ in range(times))


def main(times: int) -> None:
    for code, promised in WHAT.items():
        found = quickest(code, times)
        kept = "" if promised is None else f"   promised {promised}: {'kept' if found < promised else 'NOT KEPT'}"
        print(f"{code:<50} {found:6.0f} ms{kept}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 10)
