"""Many simulated trials: kept as they come, by what they are, so that a further run takes those that are there."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from contextlib import nullcontext
from functools import cache, partial
from hashlib import sha256
from pathlib import Path
from typing import Any, TypeAlias

from casper.batch.backends import check_jobs, results
from casper.batch.journal import Journal
from casper.batch.many import CLUSTER_WORKERS
from casper.batch.progress import bar, quiet
from casper.batch.rows import Row
from casper.batch.tasks import TRIAL, Result
from casper.batch.workers import Job, chunks_of, job_of, work_on
from casper.engine.domain.digest import digest
from casper.engine.domain.domain import Domain
from casper.kb.errors import CasperError

FORMAT = 1


def run_trials(
    domain: Domain | str | Path,
    trials: Sequence[Mapping[str, Any]],
    *,
    jobs: int = 1,
    cluster: str | None = None,
    journal: str | Path | None = None,
    progress: bool = False,
) -> list[Result]:
    """What became of simulated trials, in their order, the same wherever they were run.

    Args:
        domain: a domain, or its name or folder.
        trials: for each the fields of `TrialSettings` that are not its defaults, and perhaps ``settings``, values of
            the domain's settings: ``{"goal": "lunch", "seed": 3, "settings": {"sensor.noise": 0.06}}``.
        jobs, cluster, progress: as `explain_many`.
        journal: a file in which results are kept as they come, one JSON object a line. Those that are there already are
            not run again, whichever trials are asked for now.

    Returns:
        A dictionary for each trial: ``trial`` (its settings), what became of it (`casper.batch.judging.FIGURES`), and
        ``mistake``: None, or why there is nothing else.

    Raises:
        CasperError: a cluster or a journal that cannot be used, a journal of another domain or version of casper, a
            worker that has another version or died. What was finished until then is in the journal.
    """
    check_jobs(jobs)
    loaded = domain if isinstance(domain, Domain) else Domain.load(domain)
    wanted = list(dict.fromkeys(map(name_of, trials)))
    kept = None if journal is None else _journal(Path(journal), loaded)
    done: dict[str, Result] = {} if kept is None else kept.done
    left = [Row(at, {TRIAL.key: json.loads(name)}) for at, name in enumerate(wanted, 1) if name not in done]
    work = partial(_work, code(), work_on, job_of(TRIAL.name, loaded, {}))
    try:
        chunks = chunks_of(left, CLUSTER_WORKERS if cluster else jobs, TRIAL.together)
        shown = bar(len(wanted), len(wanted) - len(left), "trials") if progress and left else nullcontext(quiet)
        with shown as step:
            for some in results(work, chunks, jobs, cluster) if left else ():
                some = [{"trial": json.loads(wanted[found.pop("row") - 1])} | _without(found) for found in some]
                if kept is None:
                    done.update((_key(result), result) for result in some)
                else:
                    kept.add(some)
                step(len(some))
    finally:
        if kept is not None:
            kept.close(finished=False)
    return [done[name] for name in map(name_of, trials)]


Work: TypeAlias = Callable[[Job, Sequence[Row]], list[Result]]


def _work(program: str, work: Work, job: Job, rows: Sequence[Row]) -> list[Result]:
    """Runs in a worker, which must have the same program: otherwise the table would depend on where it was made."""
    if code() != program:
        raise CasperError("a worker has another version of casper; install the same one there and run it again")
    return work(job, rows)


def _without(found: Result) -> Result:
    return {name: value for name, value in found.items() if name != TRIAL.key}


def name_of(trial: Mapping[str, Any]) -> str:
    """What tells a trial from all others: its settings as text."""
    return json.dumps(dict(trial), sort_keys=True, ensure_ascii=False)


def _key(result: Result) -> str:
    return name_of(result["trial"])


def _journal(file: Path, domain: Domain) -> Journal:
    header = {"casper trials": FORMAT, "domain": digest(domain), "code": code()}
    advice = "choose another file or folder, or begin anew: casper experiment --fresh forgets it"
    return Journal(file, header, _key, "another domain, or another version of casper", advice)


@cache
def code() -> str:
    """Names the program: a digest of its sources, for a trial is what the program makes of it."""
    import casper

    found, folder = sha256(), Path(casper.__file__).parent
    for part in ("kb", "plans", "engine", "sim_adapter", "qsr", "batch"):
        for file in sorted((folder / part).rglob("*.py" if part != "batch" else "judging.py")):
            found.update(file.relative_to(folder).as_posix().encode() + b"\0" + file.read_bytes())
    return found.hexdigest()
