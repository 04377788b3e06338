"""How far a run is, and the time left: a bar on standard error."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager


def quiet(number: int) -> None:
    """Nothing is shown."""


@contextmanager
def bar(whole: int, done: int, what: str = "rows") -> Iterator[Callable[[int], None]]:
    """A bar with the time left; the function moves it on."""
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (TextColumn("{task.description}", markup=False), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    shown = Progress(*columns, console=Console(stderr=True))
    with shown:
        task = shown.add_task(what, total=whole, completed=done)
        yield lambda number: shown.advance(task, number)
