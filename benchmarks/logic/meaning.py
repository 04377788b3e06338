"""What is promised of meaning: the tests that compare with SWI-Prolog, run on as many examples as promised.

The tests stay where they are, in ``tests/kb``; each promise names those that hold it.
"""

import os
import re
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from .bounds import Bound
from .figures import OURS, Amounts, Figure, Found, Sizes, Skipped

TITLE = "Meaning"
TIMED = (
    "Tests of `tests/kb` that hold a promise, and how many of them passed; those against SWI-Prolog on as many random"
    " programs or terms as promised."
)
PASSED, TESTS = f"{OURS}: passed", f"{OURS}: tests"
ROOT = Path(__file__).resolve().parents[2]


@dataclass(frozen=True, slots=True)
class Held:
    """Files or tests as pytest names them, and whether they look at more examples in the thorough profile."""

    names: tuple[str, ...]
    thorough: bool = False


HELD = {
    "10,000 random programs with negation in circles mean what SWI-Prolog says": Held(
        ("bottom_up/test_well_founded.py::test_random_circles_of_negation_mean_what_swi_prolog_says",), True
    ),
    "5,000 random programs with aggregates and arithmetic mean what SWI-Prolog says": Held(
        ("bottom_up/test_aggregates.py::test_random_aggregates_lists_and_sums_mean_what_swi_prolog_says",), True
    ),
    "10,000 random terms are read and printed as SWI-Prolog does": Held(("terms/test_as_swi_prolog.py",), True),
    "the built-ins answer as SWI-Prolog's": Held(("top_down/test_builtins.py",)),
    "reasons, repairs, overlays and upkeep through every construct": Held(
        (
            "reasons",
            "bottom_up/test_upkeep.py",
            "bottom_up/test_facts_come_and_go.py",
            "bottom_up/test_large_changes.py",
            "bottom_up/test_fixpoint_on_columns.py",
            "bottom_up/test_counts_in_step.py",
            "bottom_up/test_aggregates.py",
            "relations/test_layers.py",
        )
    ),
    "an ontology in five syntaxes imports, answers and explains; its twin names the axioms that clash": Held(
        ("ontologies/test_five_syntaxes.py",)
    ),
    "bad input is told with its place and what to do": Held(
        ("test_bad_programs.py", "ontologies/test_damaged_files.py")
    ),
}


def measure(sizes: Sizes) -> Found:
    """How many tests of each promise pass; a skipped test, or none at all, holds nothing."""
    for promise, tests in HELD.items():
        passed, others = run(tests, thorough=sizes.thorough)
        if passed == others == 0:
            yield Skipped(promise, OURS, "no test was found")
        else:
            yield Figure(promise, PASSED, passed, unit="")
            yield Figure(promise, TESTS, passed + others, unit="")


def run(tests: Held, *, thorough: bool) -> tuple[int, int]:
    """How many tests passed, and how many failed, were skipped or could not run."""
    profile = {"HYPOTHESIS_PROFILE": "thorough"} if thorough and tests.thorough else {}
    names = [str(ROOT / "tests" / "kb" / name) for name in tests.names]
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *names]
    done = subprocess.run(command, cwd=ROOT, env={**os.environ, **profile}, capture_output=True, text=True)
    counted = {
        word: int(number) for number, word in re.findall(r"(\d+) (passed|failed|skipped|errors?)\b", done.stdout)
    }
    passed = counted.pop("passed", 0)
    return passed, sum(counted.values()) or int(done.returncode not in (0, 5))


def promises(amounts: Amounts, sizes: Sizes) -> Iterator[Bound]:
    """All of them passed."""
    for promise in HELD:
        yield Bound(promise, amounts.get((promise, PASSED)), amounts.get((promise, TESTS), 1), "tests", at_least=True)
