"""The page: of each experiment the paper's numbers, ours and the reasons, between marks: parts can be renewed."""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Iterator, Sequence
from pathlib import Path

from casper.experiments.experiment import Data, Experiment
from casper.experiments.files import read_data
from casper.kb.errors import CasperError

TITLE = "# The paper's experiments\n\nWritten by `casper experiment`: the paper's numbers, ours, and why they differ.\n"


def block(experiment: Experiment, data: Data, figures: str) -> str:
    """An experiment's part of a page, with its marks; ``figures`` is the folder of its figures, as it is linked to."""
    start = f"<!-- experiment {experiment.name} -->"
    return "\n".join([start, *_paragraphs(experiment, data, figures), _end(experiment.name)])


def _end(name: str) -> str:
    return f"<!-- experiment {name}: end -->"


def _paragraphs(experiment: Experiment, data: Data, figures: str) -> Iterator[str]:
    where = f", {experiment.paper} of the paper" if experiment.paper else ""
    yield f"### {experiment.shows[0].upper()}{experiment.shows[1:]}\n"
    about = ", ".join(f"{name} {value}" for name, value in data.about.items())
    yield f"`casper experiment {experiment.name}`{where} ({about}).\n"
    for paragraph in experiment.says(data):
        yield f"{paragraph}\n"
    for name in experiment.figures:
        yield f"![{experiment.shows}: {name}]({figures}{name}.svg)\n"


def renewed(text: str, name: str, part: str) -> str:
    """A page with one experiment's part in place of what was between its marks, or at the end."""
    marked = re.compile(f"<!-- experiment {re.escape(name)} -->.*?{re.escape(_end(name))}", re.DOTALL)
    if marked.search(text):
        return marked.sub(lambda found: part, text, count=1)
    return f"{text.rstrip()}\n\n{part}\n" if text.strip() else f"{TITLE}\n{part}\n"


def write_page(page: Path, experiments: Sequence[Experiment], folder: Path) -> None:
    """Renew the parts of some experiments in a page; what else stands there stays. Their figures go beside it.

    A page in the folder of the data links to the figures there; any other gets copies of figures and data in a folder
    of its own name.

    Raises:
        CasperError: data or a page that cannot be read, or files that cannot be written.
    """
    beside = "" if page.resolve().parent == folder.resolve() else f"{page.stem}/"
    try:
        text = page.read_text(encoding="utf-8") if page.exists() else ""
        for experiment in experiments:
            text = renewed(text, experiment.name, block(experiment, read_data(folder, experiment.name), beside))
            _copy(page, experiment, folder, beside)
        part = page.with_name(f".{page.name}.part")
        part.write_text(text, encoding="utf-8")
        os.replace(part, page)
    except OSError as mistake:
        raise CasperError(f"cannot write the page {page} ({mistake.strerror or mistake})") from None


def _copy(page: Path, experiment: Experiment, folder: Path, beside: str) -> None:
    if not beside:
        return
    (page.parent / beside).mkdir(exist_ok=True)
    for name in (f"{experiment.name}.json", *(f"{figure}.svg" for figure in experiment.figures)):
        shutil.copyfile(folder / name, page.parent / beside / name)
