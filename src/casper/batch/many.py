"""Many rows: `explain_many`, `verify_many`, `watch_many`, and the run that is behind them."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import nullcontext
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from casper.batch.backends import check_jobs, results
from casper.batch.journal import Journal, about
from casper.batch.progress import bar, quiet
from casper.batch.rows import Rows
from casper.batch.tables import check_table, rows_of, write_table
from casper.batch.tasks import TASKS, Result
from casper.batch.workers import chunks_of, job_of, work_on
from casper.engine.domain.digest import digest
from casper.engine.domain.domain import Domain

if TYPE_CHECKING:
    from collections.abc import Callable

CLUSTER_WORKERS = 8  # chunks are cut as if a cluster had so many


def explain_many(
    domain: Domain | str | Path,
    rows: Rows,
    *,
    jobs: int = 1,
    cluster: str | None = None,
    out: str | Path | None = None,
    progress: bool = False,
    **options: Any,
) -> list[Result]:
    """What rows of actions speak for: for each row ``outcome``, ``confidence``, ``posterior``, ``frontier`` …

    Args:
        domain: a domain, or its name or folder.
        rows: a table's file with a column ``actions``, or Python values: lists of actions, or mappings with them.
        jobs: how many processes work on it.
        cluster: the address of a Dask scheduler (``tcp://…``) to work on instead.
        out: a table's file (``.csv``, ``.jsonl``, ``.parquet``) for the results. A run that ended before it was
            written is gone on with: what was done is kept beside it, in a journal.
        progress: show a bar with the time left, on standard error.
        options: those of `Domain.reading`.

    Returns:
        A dictionary for each row, in their order: ``row`` (from 1), what else the row had, the results, ``mistake``.

    Raises:
        CasperError: a table, an option, a cluster or a file that cannot be used, or a worker that died.
    """
    return run("explain", domain, rows, options, jobs=jobs, cluster=cluster, out=out, progress=progress)


def verify_many(
    domain: Domain | str | Path,
    rows: Rows,
    *,
    jobs: int = 1,
    cluster: str | None = None,
    out: str | Path | None = None,
    progress: bool = False,
) -> list[Result]:
    """Verdicts on statements: ``valid``, ``completed``, ``reasons``; a column ``statement`` (as `explain_many`)."""
    return run("verify", domain, rows, {}, jobs=jobs, cluster=cluster, out=out, progress=progress)


def watch_many(
    domain: Domain | str | Path,
    recordings: Rows,
    *,
    jobs: int = 1,
    cluster: str | None = None,
    out: str | Path | None = None,
    progress: bool = False,
    **options: Any,
) -> list[Result]:
    """Recordings of world states, read to their end: what the mind predicted, when, and what the robot would do.

    A recording is a file of world states, one JSON object a line; ``recordings`` are their names, or a table with a
    column ``recording``. Options are those of `Mind` (otherwise as `explain_many`).
    """
    return run("watch", domain, recordings, options, jobs=jobs, cluster=cluster, out=out, progress=progress)


def run(
    name: str,
    domain: Domain | str | Path,
    rows: Rows,
    options: Mapping[str, Any],
    *,
    jobs: int = 1,
    cluster: str | None = None,
    out: str | Path | None = None,
    progress: bool = False,
) -> list[Result]:
    """A task on all rows (arguments and mistakes: `explain_many`)."""
    check_jobs(jobs)
    file = None if out is None else Path(out)
    if file is not None:
        check_table(file)
    loaded = domain if isinstance(domain, Domain) else Domain.load(domain)
    TRIED[name](loaded, options)
    todo = rows_of(rows, TASKS[name].key)
    job = job_of(name, loaded, options)
    journal = None if file is None else Journal(_journal_of(file), about(job, todo, digest(loaded)))
    done = {} if journal is None else journal.done
    left = [row for row in todo if row.number not in done]
    finished = False
    try:
        chunks = chunks_of(left, CLUSTER_WORKERS if cluster else jobs, TASKS[name].together)
        with bar(len(todo), len(done)) if progress else nullcontext(quiet) as step:
            for some in results(partial(work_on, job), chunks, jobs, cluster):
                if journal is None:
                    done.update((result["row"], result) for result in some)
                else:
                    journal.add(some)
                step(len(some))
        found = [done[row.number] for row in todo]
        if file is not None:
            write_table(file, found)
        finished = True
    finally:
        if journal is not None:
            journal.close(finished)
    return found


def _try_reading(domain: Domain, options: Mapping[str, Any]) -> None:
    domain.reading(**options)


def _try_mind(domain: Domain, options: Mapping[str, Any]) -> None:
    from casper.engine.mind import Mind

    Mind(domain, **options)


TRIED: dict[str, Callable[[Domain, Mapping[str, Any]], None]] = {
    "explain": _try_reading,  # a mistake in the options is told once, not for every row
    "verify": lambda domain, options: None,
    "watch": _try_mind,
    "trial": lambda domain, options: None,
}


def _journal_of(file: Path) -> Path:
    return file.with_name(f"{file.name}.journal")
