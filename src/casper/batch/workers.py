"""What is sent to a worker, and what it does: a domain once, then chunks of rows."""

from __future__ import annotations

import pickle
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from hashlib import sha256
from typing import Any

from casper.batch.rows import Row
from casper.batch.tasks import TASKS, Result, worked
from casper.engine.domain.domain import Domain

_CHUNKS = 20  # of each worker: enough to keep all busy to the end


@dataclass(frozen=True, slots=True)
class Job:
    """The task, the options, and the domain as it was when the run began, whatever its files become."""

    task: str
    options: Mapping[str, Any]
    domain: bytes

    @property
    def digest(self) -> str:
        """Names the domain."""
        return sha256(self.domain).hexdigest()


def job_of(task: str, domain: Domain, options: Mapping[str, Any]) -> Job:
    """The job of working on a domain's rows."""
    return Job(task, dict(options), pickle.dumps(domain))


def work_on(job: Job, rows: Sequence[Row]) -> list[Result]:
    """The results of some rows, in their order. Runs in a worker."""
    domain = _arrived(job.domain)
    return [worked(TASKS[job.task], domain, row, job.options) for row in rows]


@lru_cache(maxsize=2)
def _arrived(domain: bytes) -> Domain:
    """The domain, compiled once in each worker. It was pickled by us, in the same run."""
    arrived: Domain = pickle.loads(domain)
    return arrived


def chunks_of(rows: Sequence[Row], workers: int, largest: int) -> Iterator[Sequence[Row]]:
    """The rows in chunks, so many for each worker, of so many rows at most."""
    size = min(largest, max(1, -(-len(rows) // (workers * _CHUNKS))))
    return (rows[at : at + size] for at in range(0, len(rows), size))
