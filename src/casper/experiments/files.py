"""Files of an experiment: data as JSON and CSV, figures drawn from the JSON alone."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Iterator
from pathlib import Path

from casper.batch.tables import write_table
from casper.experiments.experiment import Data, Experiment
from casper.experiments.figures.style import save
from casper.kb.errors import CasperError


def check_folder(folder: Path) -> None:
    """Make a folder, if it is not there, and see that files can be written to it.

    Raises:
        CasperError: they cannot; the sentence says why.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as mistake:
        why = mistake.strerror or str(mistake)
        raise CasperError(f"cannot write to {folder} ({why}); choose another folder with --out") from None


def write_data(folder: Path, data: Data) -> Iterator[Path]:
    """``NAME.json`` with all of it, ``NAME.csv`` with the tidy table; each is whole or not there at all.

    Raises:
        CasperError: a file cannot be written.
    """
    file = folder / f"{data.name}.json"
    text = "{\n" + ",\n".join(f'"{name}": {_lines(value)}' for name, value in data.to_json().items()) + "\n}\n"
    beside = file.with_name(f".{file.name}.part")
    try:
        beside.write_text(text, encoding="utf-8")
        os.replace(beside, file)
    except OSError as mistake:
        raise CasperError(f"cannot write {file} ({mistake.strerror or mistake})") from None
    yield file
    table = folder / f"{data.name}.csv"
    write_table(table, data.rows)
    yield table


def _lines(value: object) -> str:
    """JSON with each row of a list, and each part of a mapping, on a line of its own."""
    parts = [(None, one) for one in value] if isinstance(value, list) else []
    parts = list(value.items()) if isinstance(value, dict) else parts
    if not parts:
        return json.dumps(value, ensure_ascii=False)
    names = ["" if key is None else f"{json.dumps(key)}: " for key, _ in parts]
    texts = [name + json.dumps(one, ensure_ascii=False) for name, (_, one) in zip(names, parts)]
    opens, closes = "[]" if isinstance(value, list) else "{}"
    return f"{opens}\n " + ",\n ".join(texts) + f"\n{closes}"


def read_data(folder: Path, name: str) -> Data:
    """What `write_data` wrote.

    Raises:
        CasperError: there is no such file, or it holds something else.
    """
    file = folder / f"{name}.json"
    try:
        return Data.from_json(json.loads(file.read_text(encoding="utf-8")))
    except OSError as mistake:
        why = mistake.strerror or mistake
        raise CasperError(f"cannot read {file} ({why}); without --redraw the experiment is run") from None
    except (ValueError, KeyError, TypeError, AttributeError):
        raise CasperError(f"{file} holds no data of an experiment; without --redraw the experiment is run") from None


def draw(folder: Path, experiment: Experiment) -> Iterator[Path]:
    """The figures as SVG and PNG, made of the data file; the same file gives the same figures.

    Raises:
        CasperError: as `read_data`, matplotlib is not installed, or a file cannot be written.
    """
    for name, figure in experiment.figures.items():
        yield from save(figure, read_data(folder, experiment.name), folder / name)
