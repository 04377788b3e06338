"""Where chunks are worked on: here, in processes of this machine, or on an existing Dask cluster."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext
from typing import Any, TypeAlias

from casper.batch.rows import Row
from casper.batch.tasks import Result
from casper.kb.errors import CasperError

Chunks: TypeAlias = Iterable[Sequence[Row]]
Work: TypeAlias = Callable[[Sequence[Row]], list[Result]]
_PATIENCE = 10  # seconds to reach a cluster


def check_jobs(jobs: int) -> None:
    """Refuse a number of processes that is none.

    Raises:
        CasperError: it is no whole number from 1.
    """
    if isinstance(jobs, bool) or not isinstance(jobs, int) or jobs < 1:
        raise CasperError(f"the number of jobs is a whole number from 1, not {jobs}")


def results(work: Work, chunks: Chunks, jobs: int, cluster: str | None) -> Iterator[list[Result]]:
    """The results of each chunk, as they come.

    Raises:
        CasperError: joblib or Dask is not installed, the cluster cannot be reached, or a worker died; what was given
            until then stands.
    """
    if jobs == 1 and cluster is None:
        yield from map(work, chunks)
        return
    joblib = _joblib()
    with _backend(joblib, cluster):
        run = joblib.Parallel(n_jobs=-1 if cluster else jobs, return_as="generator_unordered", batch_size=1)
        try:
            yield from run(joblib.delayed(work)(chunk) for chunk in chunks)
        except Exception as mistake:
            if isinstance(mistake, CasperError) or type(mistake).__name__ not in _DEATHS:
                raise
            raise CasperError(f"a worker died ({_first_line(mistake)}); run it again to go on where it was") from None


_DEATHS = ("TerminatedWorkerError", "BrokenProcessPool", "KilledWorker", "CommClosedError", "CancelledError")


def _joblib() -> Any:
    try:
        import joblib
    except ImportError:
        raise CasperError("several jobs need joblib: pip install 'casper-hri[batch]'") from None
    return joblib


def _backend(joblib: Any, cluster: str | None) -> AbstractContextManager[Any]:
    if cluster is None:
        return nullcontext()
    try:
        from distributed import Client
    except ImportError:
        raise CasperError("a cluster needs Dask: pip install 'casper-hri[batch]'") from None
    try:
        client: Any = Client(cluster, timeout=_PATIENCE, set_as_default=True)  # type: ignore[no-untyped-call]
    except (OSError, ValueError) as mistake:
        raise CasperError(f"the cluster {cluster} cannot be reached ({_first_line(mistake)})") from None
    if not client.scheduler_info()["workers"]:
        client.close()
        raise CasperError(f"the cluster {cluster} has no workers; start some, with: dask worker {cluster}")
    return _Connected(joblib, client)


class _Connected(AbstractContextManager["_Connected"]):
    """joblib's Dask backend on a cluster, as long as it lasts."""

    def __init__(self, joblib: Any, client: Any) -> None:
        self._client, self._config = client, joblib.parallel_config(backend="dask")

    def __enter__(self) -> _Connected:
        self._config.__enter__()
        return self

    def __exit__(self, *how: Any) -> None:
        self._config.__exit__(*how)
        self._client.close()


def _first_line(mistake: BaseException) -> str:
    return (str(mistake).strip() or type(mistake).__name__).splitlines()[0]
