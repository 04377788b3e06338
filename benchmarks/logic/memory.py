"""Memory of the large base: what it holds once the caller's own rows are gone, a derived fact."""

import gc
import resource
import tracemalloc
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path

from .ontology import as_facts, generated
from .peers import compiled, loaded


@dataclass(frozen=True, slots=True)
class Memory:
    """Bytes the base holds, as Python counts them and as the process grew, with its numbers of facts."""

    traced: int
    resident: int
    given: int
    stored: int

    @property
    def derived(self) -> int:
        """The facts that were not given."""
        return self.stored - self.given

    def __str__(self) -> str:
        lines = [f"{self.given:,} given facts, {self.derived:,} derived ones"]
        for name, held in (("tracemalloc", self.traced), ("resident set", self.resident)):
            each, all_ = held / max(self.derived, 1), held / max(self.stored, 1)
            lines.append(
                f"{name}: {held / 2**20:.1f} MiB, {each:,.0f} bytes a derived fact, {all_:,.0f} a fact"
            )
        return "; ".join(lines)


def measured(share: float) -> Memory:
    """The memory of the ontology task's base, measured in fresh processes."""
    with ProcessPoolExecutor(1, get_context("spawn")) as fresh:
        traced, given, stored = fresh.submit(_held, share, True).result()
    with ProcessPoolExecutor(1, get_context("spawn")) as fresh:
        resident, _, _ = fresh.submit(_held, share, False).result()
    return Memory(traced, resident, given, stored)


def _held(share: float, traced: bool) -> tuple[int, int, int]:
    """(bytes, given facts, all facts) of a base, after everything else was let go."""
    warm = as_facts(generated(0.01))
    compiled(loaded(warm), warm)  # the imports and caches are not the base's
    gc.collect()
    if traced:
        tracemalloc.start()
    before = tracemalloc.get_traced_memory()[0] if traced else _resident()
    program = as_facts(generated(share))
    kb = loaded(program)
    stored = compiled(kb, program)
    given = sum(len(program.facts[name]) for name, _ in program.counted)
    del program
    gc.collect()
    after = tracemalloc.get_traced_memory()[0] if traced else _resident()
    assert kb is not None
    return after - before, given, stored


def _resident() -> int:
    """Bytes of this process in memory now; where the system does not say, the most there ever were."""
    now = Path("/proc/self/statm")
    if now.exists():
        return int(now.read_text().split()[1]) * resource.getpagesize()
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
