"""How far something is that takes a while: on standard error, from the third second on, where a person looks.

Nothing is shown with ``--quiet``, nor where standard error is no terminal.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Timer
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from rich.progress import Progress

SILENT_SECONDS = 2.0  # what takes no longer needs no bar
Step: TypeAlias = Callable[[float], None]


@contextmanager
def progress(what: str, total: float | None = None, quiet: bool = False) -> Iterator[Step]:
    """A bar, or where nobody knows the ``total`` a moving one, with the time; the function says how far it is."""
    if quiet or not _is_watched():
        yield lambda done: None
        return
    shown = _bar(total)
    task = shown.add_task(what, total=total)
    timer = Timer(SILENT_SECONDS, shown.start)
    timer.daemon = True
    timer.start()
    try:
        yield lambda done: shown.update(task, completed=done)
    finally:
        timer.cancel()
        timer.join()
        shown.stop()


def _is_watched() -> bool:
    return sys.stderr.isatty()


def _bar(total: float | None) -> Progress:
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

    left = TimeElapsedColumn() if total is None else TimeRemainingColumn()
    out = Console(stderr=True, highlight=False, emoji=False)
    columns = (TextColumn("{task.description}", markup=False), BarColumn(), left)
    return Progress(*columns, console=out, transient=True, redirect_stdout=False, redirect_stderr=False)
