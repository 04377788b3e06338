"""Fresh processes: how much memory something holds, and whether something stops in little of it."""

import gc
import resource
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import Any, TypeVar

from ..figures import OURS, Figure, Sizes, Skipped, now

T = TypeVar("T")
STATUS = Path("/proc/self/status")


def fresh(function: Callable[..., T], *args: Any, limit: float | None = None) -> T:
    """What a function returns in a process of its own.

    Raises:
        TimeoutError: it takes more than ``limit`` seconds; the process is killed.
        BrokenProcessPool: its process crashed. Whatever the function raises.
    """
    pool = ProcessPoolExecutor(1, get_context("spawn"))
    try:
        return pool.submit(function, *args).result(timeout=limit)
    except TimeoutError:
        for process in list(pool._processes.values()):
            process.kill()
        raise TimeoutError(f"it did not finish in {limit:.0f} s") from None
    finally:
        pool.shutdown(wait=False, cancel_futures=True)


def grown(made: Callable[..., T], args: tuple[Any, ...], work: Callable[[T], object]) -> int:
    """Bytes by which a fresh process has grown after something was done to what was made."""
    return fresh(_grown, made, args, work)


def _grown(made: Callable[..., T], args: tuple[Any, ...], work: Callable[[T], object]) -> int:
    held = made(*args)
    gc.collect()
    before = resident()
    work(held)
    return max(0, resident() - before)


def resident() -> int:
    """Bytes of this process in memory now; where the system does not say, the most there ever were."""
    now = Path("/proc/self/statm")
    if now.exists():
        return int(now.read_text().split()[1]) * resource.getpagesize()
    return most()


def most() -> int:
    """The most bytes of this process that ever were in memory."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


def limited(task: str, work: Callable[[], object], sizes: Sizes) -> Figure | Skipped:
    """The seconds of some work in a process that gets no more memory than a limit; or how it came to an end."""
    try:
        seconds = fresh(_limited, work, sizes.memory)
    except Exception as mistake:
        return Skipped(
            task, OURS, f"within {sizes.memory / 2**30:g} GiB it ended with {type(mistake).__name__}: {mistake}"
        )
    return Figure(task, OURS, seconds)


def _limited(work: Callable[[], object], memory: int) -> float:
    resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    began = now()
    work()
    return now() - began
