"""Does it mean what SWI-Prolog says? Random programs and terms, as many as wanted, in one process.

    python tests/agreement --seed 1

It is a part of the thorough tests: of 10,000 programs with negation in circles, 8,000 with aggregates, lists and
arithmetic, and 10,000 terms, one line each says how many mean exactly the same; whatever does not is printed. Ordinary
tests ask the same of a few. The exit code is 0 when nothing disagrees, 1 when something does, 2 without SWI-Prolog.
"""

from __future__ import annotations

import argparse
import shutil
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tests" / "helpers")]

import circles  # noqa: E402
import sums  # noqa: E402
import written  # noqa: E402

KINDS = {
    "circles": (circles.compare, 10_000, "programs with negation in circles"),
    "sums": (sums.compare, 8_000, "programs with aggregates, lists and arithmetic"),
    "terms": (written.compare, 10_000, "terms read and written"),
}


def main() -> int:
    """Compare what was asked for, print what came of it; the exit code."""
    parser = argparse.ArgumentParser(prog="python tests/agreement", description=(__doc__ or "").splitlines()[0])
    parser.add_argument("kinds", nargs="*", metavar="KIND", help=f"of {', '.join(KINDS)} (all)")
    parser.add_argument("--seed", type=int, default=20, help="which are drawn (default 20)")
    parser.add_argument("--count", type=int, help="how many of each (default 10,000, 8,000 and 10,000)")
    options = parser.parse_args()
    if unknown := [kind for kind in options.kinds if kind not in KINDS]:
        parser.error(f"{unknown[0]} is none of {', '.join(KINDS)}")
    if shutil.which("swipl") is None:
        print("SWI-Prolog (swipl) is not installed, so there is nothing to compare with", file=sys.stderr)
        return 2
    return 1 if sum(_compared(kind, options) for kind in options.kinds or KINDS) else 0


def _compared(kind: str, options: argparse.Namespace) -> int:
    compare, many, what = KINDS[kind]
    began = time.process_time()
    with tempfile.TemporaryDirectory() as folder:
        tally = compare(options.count or many, options.seed, Path(folder))
    for text in tally.disagreements:
        print(f"--- {kind} disagree:\n{text}\n---")
    remarks = [f"{tally.equal:,} exactly alike", f"{len(tally.disagreements)} disagree"]
    remarks += [f"{tally.left:,} end with an error in SWI-Prolog"] if tally.left else []
    remarks += [f"something undefined in {tally.undefined:,}"] if tally.undefined else []
    seconds = time.process_time() - began
    print(f"{tally.asked:,} {what} (seed {options.seed}): {'; '.join(remarks)}; {seconds:.0f} s of our time", flush=True)
    return len(tally.disagreements)


sys.exit(main())
