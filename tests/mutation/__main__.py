"""Do the tests notice? Small faults are planted in the code, one at a time, and the tests are run against each.

    python tests/mutation kb plans engine --count 30 --seed 7 --jobs 2

It is a part of the thorough tests, not of ``python tests``: thirty mutants take some minutes. Of each package (or
folder, or file) ``count`` mutants are drawn by the seed: a comparison, an operator, a number, True or False is changed,
a condition negated, a ``not``, a statement or a result taken away. Each is planted in a copy of the tree, where the
tests of the file's room run first, then those of its package (not with ``--quick``). One line a mutant says whether it
was noticed (and by which test), survived, or the tests ran out of time, which is noticing, too. A survivor is a fact
that no test states, or code that nothing needs, or a change that changes nothing.

The exit code is 0 when every mutant was noticed, 1 when one survived, 2 when nothing can be said.

It is our own because cosmic-ray plants its mutants in the tree one works in, and mutmut leaves out what stands outside
functions, follows the links of src/casper, and breaks tests that start other programs.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from queue import SimpleQueue

from mutations import Mutant, sample
from trial import FailingTests, Trial

ROOT = Path(__file__).resolve().parent.parent.parent


def main() -> int:
    """Draw the mutants, try each, print what became of it; the exit code."""
    options = _options()
    drawn = {p: sample(options.root, p, options.count, options.seed, options.leave) for p in options.places}
    empty = [place for place, mutants in drawn.items() if not mutants]
    if empty:
        print(f"there is nothing to change in {', '.join(empty)}", file=sys.stderr)
        return 2
    with tempfile.TemporaryDirectory(prefix="mutants") as folder:
        trials = [Trial(options.root, Path(folder, str(number)), options.quick) for number in range(options.jobs)]
        try:
            for trial in trials:
                trial.prepare(mutant.path for mutants in drawn.values() for mutant in mutants)
        except FailingTests as mistake:
            print(mistake, file=sys.stderr)
            return 2
        tallies = [_tried(place, mutants, trials) for place, mutants in drawn.items()]
    return 1 if any(tally["survived"] for tally in tallies) else 0


def _tried(place: str, mutants: list[Mutant], trials: list[Trial]) -> Counter[str]:
    free: SimpleQueue[Trial] = SimpleQueue()
    for trial in trials:
        free.put(trial)

    def verdict(mutant: Mutant) -> str:
        trial = free.get()
        try:
            word, by = trial.verdict(mutant)
        finally:
            free.put(trial)
        print(f"{word:8}  {mutant}" + (f"  [{by}]" if by else ""), flush=True)
        return word

    with ThreadPoolExecutor(len(trials)) as pool:
        tally = Counter(pool.map(verdict, mutants))
    noticed = tally["noticed"] + tally["timeout"]
    print(f"{place}: {noticed} of {len(mutants)} noticed ({tally['timeout']} by running out of time)", flush=True)
    return tally


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python tests/mutation", description=(__doc__ or "").splitlines()[0])
    parser.add_argument("places", nargs="+", help="packages, folders or files, from the project's root")
    parser.add_argument("--count", type=int, default=30, help="mutants of each place (default 30)")
    parser.add_argument("--seed", type=int, default=0, help="which mutants are drawn (default 0)")
    parser.add_argument("--jobs", type=int, default=1, help="how many are tried at once (default 1)")
    parser.add_argument("--quick", action="store_true", help="run the tests of the room only, not the package's")
    parser.add_argument("--leave", action="append", default=[], help="a folder or file to leave out")
    parser.add_argument("--root", type=lambda name: Path(name).resolve(), default=ROOT, help="another project's folder")
    return parser.parse_args()


sys.exit(main())
