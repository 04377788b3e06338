"""Runs experiments: their trials together, each one's data, figures and part of the page."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from casper.batch.backends import check_jobs
from casper.batch.trials import name_of, run_trials
from casper.engine.domain.domain import Domain
from casper.engine.settings import check_seed
from casper.experiments.experiment import Asked, Data, Experiment, Trial
from casper.experiments.files import check_folder, draw, read_data, write_data
from casper.experiments.page import write_page
from casper.experiments.registry import named
from casper.kb.errors import CasperError
from casper.sim_adapter.room.scene import BODY

JOURNAL = "trials.jsonl"
PAGE = "paper.md"


@dataclass(frozen=True, slots=True)
class Where:
    """Where trials are run, and what is written where.

    ``fresh`` forgets trials that were kept; ``redraw`` runs nothing and draws what is there; ``page`` is renewed beside
    the folder's own; ``progress`` shows a bar.
    """

    out: Path
    jobs: int = 1
    cluster: str | None = None
    fresh: bool = False
    redraw: bool = False
    page: Path | None = None
    progress: bool = False


def run_experiments(
    names: Sequence[str], where: Where, trials: int | None = None, seed: int = 0, body: str = BODY
) -> Iterator[tuple[Experiment, Data, list[Path]]]:
    """Run experiments, or draw them anew: of each its data and the files that were written, one after the other.

    Trials of all of them are run together, and kept as they come: a run that was interrupted goes on where it was, and
    further trials are added to those that are there.

    Raises:
        CasperError: an unknown experiment or body of the robot, a number or a seed that is none, a folder, page or
            cluster that cannot be used, a library that is missing, kept trials of another version, or a worker that
            died.
    """
    chosen = named(names)
    asked = _asked(trials, seed, body)
    check_jobs(where.jobs)
    _check_libraries(chosen, asked, where.redraw)
    check_folder(where.out)
    if where.page is not None:
        check_folder(where.page.parent)
    runs = None if where.redraw else _Trials(asked, where, chosen)
    for experiment in chosen:
        files: list[Path] = []
        if runs is not None:
            files += write_data(where.out, experiment.work(asked, runs))
        files += draw(where.out, experiment)
        yield experiment, read_data(where.out, experiment.name), files
    for page in dict.fromkeys((where.out / PAGE, where.page)):
        if page is not None:
            write_page(page, chosen, where.out)


def _asked(trials: int | None, seed: int, body: str) -> Asked:
    if trials is not None and trials < 1:
        raise CasperError(f"the number of trials is a whole number from 1, not {trials}")
    check_seed(seed)
    return Asked(Domain.load("kitchen"), trials, seed, body)


def _check_libraries(chosen: Sequence[Experiment], asked: Asked, redraw: bool) -> None:
    needed = {"matplotlib": "plot"}
    for experiment in () if redraw else chosen:
        needed |= {**experiment.needs, **({"mujoco": "sim"} if experiment.trials(asked) else {})}
    for module, extra in needed.items():
        if find_spec(module) is None:
            raise CasperError(f"this needs {module}, which is not installed: pip install 'casper-hri[{extra}]'")
    if "mujoco" in needed:
        from casper.sim_adapter.physics.bodies.table import body_of

        body_of(asked.body)


class _Trials:
    """Runs the trials of all chosen experiments when the first one asks, and hands out what became of them."""

    def __init__(self, asked: Asked, where: Where, chosen: Sequence[Experiment]) -> None:
        self._asked, self._where = asked, where
        self._all = [trial for experiment in chosen for trial in experiment.trials(asked)]
        self._found: dict[str, dict[str, Any]] = {}
        if where.fresh:
            (where.out / JOURNAL).unlink(missing_ok=True)

    def __call__(self, trials: Sequence[Trial]) -> list[dict[str, Any]]:
        if any(name_of(trial) not in self._found for trial in trials):
            every = list({name_of(trial): trial for trial in (*self._all, *trials)}.values())
            where = self._where
            how: dict[str, Any] = {"jobs": where.jobs, "cluster": where.cluster, "progress": where.progress}
            found = run_trials(self._asked.domain, every, journal=where.out / JOURNAL, **how)
            self._found = dict(zip(map(name_of, every), found))
        return [self._found[name_of(trial)] for trial in trials]
